// The newest values of a series, without garbage collection.

export class Samples {
  /** @param {number} capacity */
  constructor(capacity) {
    this.values = new Float64Array(capacity);
    this.count = 0;
  }

  /** @param {number} value */
  push(value) {
    this.values[this.count++ % this.values.length] = value;
  }

  /** Returns a copy of the stored values, oldest first. @returns {number[]} */
  list() {
    const { values, count } = this;
    if (count <= values.length) return Array.from(values.subarray(0, count));
    const next = count % values.length;
    return [...values.subarray(next), ...values.subarray(0, next)];
  }
}
