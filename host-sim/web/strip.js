// A table that grows at one end and drops rows at the other; its columns are passed to the charts without copying.

export class Strip {
  /** @param {number} columns the first one is the time @param {number} capacity least number of rows in memory */
  constructor(columns, capacity) {
    this.columns = Array.from({ length: columns }, () => new Float64Array(2 * capacity));
    this.capacity = capacity;
    this.length = 0;
  }

  /** Appends a row. @param {number[]} row */
  push(...row) {
    if (this.length === 2 * this.capacity) {
      for (const column of this.columns) column.copyWithin(0, this.capacity);
      this.length = this.capacity;
    }
    for (let i = 0; i < row.length; i++) this.columns[i][this.length] = row[i];
    this.length++;
  }

  /** Clears all rows. */
  clear() {
    this.length = 0;
  }

  /** Returns the newest value of a column, or NaN. @param {number} column */
  last(column) {
    return this.length ? this.columns[column][this.length - 1] : NaN;
  }

  /** Returns a value. @param {number} column @param {number} row */
  at(column, row) {
    return this.columns[column][row];
  }

  /** Returns the first row not before a time. @param {number} time */
  find(time) {
    let low = 0, high = this.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (this.columns[0][middle] < time) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /**
   * Returns the value of a column at a time: that of the last row not after it, or NaN.
   * @param {number} time @param {number} column
   */
  before(time, column) {
    const next = this.find(time);
    const row = next < this.length && this.at(0, next) === time ? next : next - 1;
    return row >= 0 ? this.at(column, row) : NaN;
  }

  /**
   * Returns the first value of the row nearest to a time, or NaN if none is within `most`.
   * @param {number} time @param {number} most
   */
  nearest(time, most) {
    const row = this.find(time);
    const [best] = [row - 1, row].filter((k) => k >= 0 && k < this.length)
      .sort((a, b) => Math.abs(this.at(0, a) - time) - Math.abs(this.at(0, b) - time));
    return best !== undefined && Math.abs(this.at(0, best) - time) <= most ? this.at(1, best) : NaN;
  }

  /** Returns the columns from a time on, and one row before it; not copied. @param {number} time */
  since(time) {
    const first = Math.max(0, this.find(time) - 1);
    return this.columns.map((column) => column.subarray(first, this.length));
  }

  /**
   * Returns the smallest and the largest value of columns 1 to `columns` - 1, and of 0, from a time on.
   * @param {number} time @param {number} columns @returns {Vec}
   */
  extent(time, columns) {
    let low = 0, high = 0;
    const first = this.find(time);
    for (let c = 1; c < columns; c++) {
      const column = this.columns[c];
      for (let i = first; i < this.length; i++) {
        if (column[i] < low) low = column[i];
        if (column[i] > high) high = column[i];
      }
    }
    return [low, high];
  }
}
