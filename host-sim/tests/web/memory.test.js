// The memory of a long session does not grow without bound, neither in the page nor in the program: dragging, recording,
// replaying and viewing are repeated. STICTION_SOAK: duration in seconds.

import assert from "node:assert/strict";
import { liveTest } from "./live.js";

const SECONDS = Number(process.env.STICTION_SOAK ?? 20);
/** The first part of the session, in which memory may grow: caches, code, ring buffers that fill. */
const WARM = 0.2;
/** Least number of rounds, in total and before it is warm. */
const ROUNDS = 4;
const FIRST = 2;
/** Idle memory in the heaps of the browser and of the program (bytes). */
const SLACK = { page: 1.5e6, program: 2.5e6 };
/** Fraction of the bytes of received messages that the page may keep since then. */
const HELD = 0.02;
/** Memory that the program may keep per tick (bytes); a record of the trace has some 300. */
const PER_TICK = 10;

/** Runs one round. @param {import("./live.js").Live} live @param {number} round */
async function round(live, round) {
  const { page } = live;
  await page.click(`.card:has(input[value="${["box-flat", "corner-stick-slip"][round % 2]}"])`);
  await live.fresh();
  await page.click("#record");
  await live.until(() => window.stiction.state?.recording !== null);
  await live.grab();
  const [x, y] = (await live.frame()).frame.hand;
  await live.handTo(x, y - 0.03);
  await live.handTo(x + 0.02, y - 0.03);
  await page.mouse.up();
  await page.click("#record");
  await live.until(() => window.stiction.state?.recording === null && window.stiction.state.recorded);
  await page.selectOption("#replay", "recording");
  await live.until(() => window.stiction.state?.replay && window.stiction.frame?.position);
  await page.focus("#scrubber");
  await page.keyboard.press("End");
  await live.until(
    () => (window.stiction.frame?.position ?? 0) > 0.95 * (window.stiction.state?.replay?.seconds ?? Infinity),
  );
  if (round % 2) await page.selectOption("#chart-surface", String((round % 4) >> 1));
  await page.click("#theme");
  await page.selectOption("#replay", "live");
  await live.until(() => window.stiction.state?.replay === null);
}

liveTest(`in ${SECONDS} s of dragging, recording and replaying memory does not grow`, async (bench) => {
  const live = await bench.open();
  const devtools = await live.page.context().newCDPSession(live.page);
  const sample = async () => {
    await devtools.send("HeapProfiler.collectGarbage");
    const { usedSize, backingStorageSize = 0 } = /** @type {any} */ (await devtools.send("Runtime.getHeapUsage"));
    const nodes = await live.page.evaluate(() => document.querySelectorAll("*").length);
    return {
      page: usedSize + backingStorageSize,
      program: bench.program.memory,
      nodes,
      bytes: live.received.bytes,
      ticks: (await live.frame()).tick,
    };
  };
  const begin = performance.now();
  const elapsed = () => (performance.now() - begin) / 1000;
  /** @type {Awaited<ReturnType<typeof sample>> | null} */
  let warm = null;
  let last = await sample();
  for (let k = 1; k <= ROUNDS || elapsed() < SECONDS; k++) {
    await round(live, k);
    last = await sample();
    if (k === FIRST || (k > FIRST && elapsed() < WARM * SECONDS)) warm = last;
    if (process.env.STICTION_SOAK)
      console.log(`${elapsed().toFixed(0)} s: page ${last.page}, program ${last.program}, ${last.nodes} nodes`);
  }
  assert.ok(warm);
  const bytes = last.bytes - warm.bytes,
    ticks = last.ticks - warm.ticks;
  const page = last.page - warm.page;
  assert.ok(page < SLACK.page + HELD * bytes, `the page grew by ${page} bytes while it got ${bytes}`);
  assert.ok(last.nodes <= warm.nodes + 50, `${last.nodes} elements after ${warm.nodes}`);
  if (last.program === null || warm.program === null) return;
  const program = last.program - warm.program;
  assert.ok(program < SLACK.program + PER_TICK * ticks, `the program grew by ${program} bytes in ${ticks} ticks`);
});
