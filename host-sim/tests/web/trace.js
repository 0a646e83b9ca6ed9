// Contents of a trace, for tests.

/** Returns the records of a trace. @param {string} text @returns {TraceFrame[]} */
export const recordsOf = (text) =>
  text
    .trim()
    .split("\n")
    .map((line) => JSON.parse(line))
    .filter((record) => "t" in record);

/** Returns how often each state follows another one. @param {TraceFrame[]} records */
export function transitionsOf(records) {
  /** @type {{[pair: string]: number}} */
  const counts = {};
  for (let k = 1; k < records.length; k++) {
    const pair = `${records[k - 1].state}>${records[k].state}`;
    if (records[k - 1].state !== records[k].state) counts[pair] = (counts[pair] ?? 0) + 1;
  }
  return counts;
}
