// Figures of the page on this computer: how late a drawn pose is after its pointer event, how often and how quickly it
// draws, and what it weighs. node measure.js

import { Bench, Program, startBrowser } from "./live.js";

/** The mouse moves so long (s), so many times a second. */
const SECONDS = 10;
const MOVES = 125;

/** Median and 99 %. @param {readonly number[]} samples */
function spread(samples) {
  const sorted = [...samples].sort((a, b) => a - b);
  const at = (/** @type {number} */ part) =>
    sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))].toFixed(1);
  return `${at(0.5)} ms, 99 %: ${at(0.99)} ms (${sorted.length} samples)`;
}

const browser = await startBrowser();
const bench = new Bench(browser, await Program.start());
const live = await bench.open();
await live.grab();
const first = await live.page.evaluate(() => ({ drawn: window.stiction.framesDrawn, at: performance.now() }));
const begin = performance.now();
const { x, y } = /** @type {Spot} */ (live.pointer);
for (let k = 0; performance.now() < begin + 1000 * SECONDS; k++) {
  const part = (k / MOVES) * 2 * Math.PI * 0.5;
  await live.page.mouse.move(x + 60 * Math.sin(part), y + 90 * (1 - Math.cos(part)) * 0.5);
  const rest = begin + (1000 * k) / MOVES - performance.now();
  if (rest > 0) await new Promise((done) => setTimeout(done, rest));
}
const last = await live.page.evaluate(() => ({
  drawn: window.stiction.framesDrawn,
  at: performance.now(),
  latencies: window.stiction.latencies,
  drawTimes: window.stiction.drawTimes,
  counts: window.stiction.frame?.counts,
}));
await live.page.mouse.up();
const weight = await live.page.evaluate(() =>
  /** @type {PerformanceResourceTiming[]} */ ([
    ...performance.getEntriesByType("navigation"),
    ...performance.getEntriesByType("resource"),
  ]).reduce((sum, { encodedBodySize }) => sum + encodedBodySize, 0),
);
await bench.close();
await browser.close();

console.log(`pointer event to drawn pose: ${spread(last.latencies)}`);
console.log(
  `drawn while dragging: ${((1000 * (last.drawn - first.drawn)) / (last.at - first.at)).toFixed(1)} frames a second`,
);
console.log(`script time of a drawn frame: ${spread(last.drawTimes)}`);
console.log(`the page weighs ${weight} bytes`);
console.log(`${last.counts?.ticks} ticks, ${last.counts?.missed} of them late; ${last.counts?.slips} slips`);
