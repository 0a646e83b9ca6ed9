// Figures of the live page on this computer, as in the table of the README:
//
//     cargo build --release && npm run --prefix host-sim/tests/web measure -- [--seconds 600] [--readme]
//
// The delay from a pointer event to its drawn pose, the rate and time of drawings, the size of the page; and the number of late
// ticks of the solver while two pages are open, one of which drags, and a third client reads nothing. With `--picture
// page.png`, takes a picture of the page instead.

import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { cpus, release, type } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { parseArgs } from "node:util";

const workspace = fileURLToPath(new URL("../../../", import.meta.url));
process.env.STICTION ??= join(process.env.CARGO_TARGET_DIR ?? join(workspace, "target"), "release", "stiction");
const { Bench, Program, stalled, startBrowser } = await import("./live.js");

const { values: options } = parseArgs({
  options: { seconds: { type: "string", default: "600" }, readme: { type: "boolean", default: false }, picture: { type: "string" } },
});

/** Duration of the mouse's motion for the first figures (s), and number of moves per second. */
const SECONDS = 20;
const MOVES = 125;

/** Returns median and 99 %. @param {readonly number[]} samples @returns {[string, string]} */
function spread(samples) {
  const sorted = [...samples].sort((a, b) => a - b);
  const at = (/** @type {number} */ part) => sorted[Math.min(sorted.length - 1, Math.floor(part * sorted.length))];
  return [at(0.5).toFixed(1), at(0.99).toFixed(1)];
}

/**
 * Drags the body over the floor.
 * @param {import("./live.js").Live} live @param {number} seconds @param {number} rate moves of the mouse a second
 */
async function drag(live, seconds, rate) {
  await live.grab();
  const begin = performance.now();
  const { x, y } = /** @type {Spot} */ (live.pointer);
  for (let k = 0; performance.now() < begin + 1000 * seconds; k++) {
    const part = (k / rate) * Math.PI;
    await live.page.mouse.move(x + 60 * Math.sin(part), y + 45 * (1 - Math.cos(part)));
    const rest = begin + (1000 * k) / rate - performance.now();
    if (rest > 0) await new Promise((done) => setTimeout(done, rest));
  }
  await live.page.mouse.up();
}

/** Returns the time that the system took from this computer for others (s), if it is reported. */
function stolen() {
  try {
    const [all] = readFileSync("/proc/stat", "utf8").split("\n");
    return Number(all.split(/\s+/)[8]) / 100;
  } catch {
    return 0;
  }
}

const browser = await startBrowser();

/** Measures one page that drags. */
async function drawing() {
  const bench = new Bench(browser, await Program.start());
  const live = await bench.open();
  const first = await live.page.evaluate(() => ({ drawn: window.stiction.framesDrawn, at: performance.now() }));
  await drag(live, SECONDS, MOVES);
  const last = await live.page.evaluate(() => ({
    drawn: window.stiction.framesDrawn,
    at: performance.now(),
    latencies: window.stiction.latencies,
    drawTimes: window.stiction.drawTimes,
  }));
  const [sent, plain] = await live.page.evaluate(() => {
    const files = /** @type {PerformanceResourceTiming[]} */ ([
      ...performance.getEntriesByType("navigation"),
      ...performance.getEntriesByType("resource"),
    ]);
    const sum = (/** @type {(file: PerformanceResourceTiming) => number} */ size) =>
      files.reduce((total, file) => total + size(file), 0);
    return [sum(({ encodedBodySize }) => encodedBodySize), sum(({ decodedBodySize }) => decodedBodySize)];
  });
  await bench.close();
  const [late, latest] = spread(last.latencies);
  const [script, longest] = spread(last.drawTimes);
  return [
    ["from a pointer event to the drawn pose, median / 99 %", `${late} ms / ${latest} ms`],
    ["frames drawn a second while dragging", ((1000 * (last.drawn - first.drawn)) / (last.at - first.at)).toFixed(0)],
    ["script time of a drawn frame, median / 99 %", `${script} ms / ${longest} ms`],
    ["weight of the page as it is sent, by gzip / unpacked", `${(sent / 1000).toFixed(1)} kB / ${(plain / 1000).toFixed(1)} kB`],
  ];
}

/** Measures two pages, one of which drags, and a client that reads nothing. */
async function ticking() {
  const seconds = Number(options.seconds);
  const bench = new Bench(browser, await Program.start());
  const live = await bench.open();
  await bench.open();
  let measuring = true;
  let socket = await stalled(bench.program);
  const connectAgain = () => {
    if (measuring) stalled(bench.program).then((next) => (socket = next).once("close", connectAgain));
  };
  socket.once("close", connectAgain);
  const before = await live.frame();
  const taken = stolen();
  await drag(live, seconds, 30);
  const took = stolen() - taken;
  const { counts } = await live.frame();
  measuring = false;
  socket.destroy();
  await bench.close();
  const ticks = counts.ticks - before.counts.ticks;
  const missed = counts.missed - before.counts.missed;
  const share = ((100 * missed) / ticks).toFixed(2);
  return [
    [
      `ticks of 1 ms that began more than 1 ms late, in ${(ticks / 60_000).toFixed(1)} minutes with two pages and a client ` +
        "that reads nothing",
      `${missed} of ${ticks} (${share} %)`,
    ],
    ["time that a hypervisor took meanwhile", `${took.toFixed(1)} s of ${(seconds * cpus().length).toFixed(0)} s`],
  ];
}

/** Takes a picture of the page while the body slips. @param {string} file */
async function picture(file) {
  const bench = new Bench(browser, await Program.start());
  const live = await bench.open();
  await live.grab();
  const { x, y } = /** @type {Spot} */ (live.pointer);
  for (const [dx, dy] of [[0, 110], [120, 110], [-70, 110], [60, 106]]) {
    await live.page.mouse.move(x + dx, y + dy, { steps: 60 });
  }
  await live.page.screenshot({ path: file });
  await live.page.mouse.up();
  await bench.close();
}

if (options.picture) {
  await picture(options.picture);
  await browser.close();
  process.exit();
}

const rows = [...(await drawing()), ...(await ticking())];
const machine = `${cpus().length} × ${cpus()[0].model.trim()}, ${type()} ${release()}, Chromium ${browser.version()} without a GPU`;
await browser.close();

const table = [
  `On ${machine}:`,
  "",
  "| what | figure |",
  "|---|---|",
  ...rows.map(([what, figure]) => `| ${what} | ${figure} |`),
].join("\n");
console.log(table);

if (options.readme) {
  const file = join(workspace, "host-sim/README.md");
  const [begin, end] = ["<!-- view: begin -->", "<!-- view: end -->"];
  const text = readFileSync(file, "utf8");
  const [from, to] = [text.indexOf(begin) + begin.length, text.indexOf(end)];
  if (from < begin.length || to < from) throw new Error(`README.md has no section between ${begin} and ${end}`);
  writeFileSync(`${file}.part`, `${text.slice(0, from)}\n${table}\n${text.slice(to)}`);
  renameSync(`${file}.part`, file);
}
