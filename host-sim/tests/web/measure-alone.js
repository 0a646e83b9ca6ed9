// Figures of the page without a server on this computer, as in the table of the README of host-sim/wasm:
//
//     cargo run --release -p stiction-page -- --out target/page --npm target/npm
//     npm run --prefix host-sim/tests/web measure-alone -- [--seconds 60] [--readme]
//
// The time of its first frame, the number of its late ticks while the mouse drags, its size, and the time of a step in the npm
// package.

import { readFileSync, renameSync, writeFileSync } from "node:fs";
import { cpus, release, type } from "node:os";
import { join } from "node:path";
import { fileURLToPath, pathToFileURL } from "node:url";
import { parseArgs } from "node:util";
import { brotliCompressSync, gzipSync } from "node:zlib";
import { filesOfFirstDrawing, folder, Host, npm, oneFile } from "./alone.js";
import { Live, startBrowser } from "./live.js";

const { values: options } = parseArgs({
  options: { seconds: { type: "string", default: "60" }, readme: { type: "boolean", default: false } },
});
/** Number of pages opened for the time of the first frame. */
const OPENED = 5;
/** Scenes, and number of runs of each of their paths. */
const SCENES = ["box-flat", "ladder", "peg-in-hole"];

const browser = await startBrowser();

/** Returns a page, and the time of its first frame (ms after its request). @param {string} address */
async function opened(address) {
  const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
  const page = await context.newPage();
  await page.addInitScript(() => {
    const look = () => {
      if (window.stiction?.framesDrawn > 0) /** @type {any} */ (window).firstFrame = performance.now();
      else requestAnimationFrame(look);
    };
    requestAnimationFrame(look);
  });
  await page.goto(address);
  const first = await (await page.waitForFunction("window.firstFrame")).jsonValue();
  return { live: new Live(page, new URL(address).origin), first: Number(first) };
}

/** Returns the median time until the first frame (ms). @param {string} address */
async function firstFrame(address) {
  const times = [];
  for (let k = 0; k < OPENED; k++) {
    const { live, first } = await opened(address);
    times.push(first);
    await live.page.context().close();
  }
  return times.sort((a, b) => a - b)[OPENED >> 1];
}

/** Returns the number of ticks, and of late ones, while the mouse drags. @param {string} address @param {string} scene */
async function ticking(address, scene) {
  const { live } = await opened(address);
  await live.scene(scene);
  await live.grab();
  const before = (await live.frame()).counts;
  const { x, y } = /** @type {Spot} */ (live.pointer);
  const begin = performance.now();
  for (let k = 0; performance.now() < begin + 1000 * Number(options.seconds); k++) {
    await live.page.mouse.move(x + 60 * Math.sin(k / 10), y + 45 * (1 - Math.cos(k / 10)));
    await new Promise((done) => setTimeout(done, begin + (1000 * k) / 30 - performance.now()));
  }
  const after = (await live.frame()).counts;
  await live.page.context().close();
  const [ticks, late] = [after.ticks - before.ticks, after.missed - before.missed];
  return `${late} of ${ticks} (${((100 * late) / ticks).toFixed(2)} %)`;
}

/** Returns the compressed size of files (kB). @param {string[]} names @param {(bytes: Buffer) => Buffer} pack */
const weight = (names, pack) =>
  (names.reduce((sum, name) => sum + pack(readFileSync(join(folder, name))).length, 0) / 1000).toFixed(0);

/** Returns the files that a page requests until its first frame. @param {string} address */
async function files(address) {
  const { live } = await opened(address);
  const names = await filesOfFirstDrawing(live);
  await live.page.context().close();
  return names;
}

/** Returns the time of a sample in `run`, median of scenes, for a number type (µs). @param {"f32" | "f64" | "fixed"} number */
async function step(number) {
  const { Solver, scenePath } = await import(pathToFileURL(join(npm, "node.js")).href);
  const times = SCENES.map((scene) => {
    const rows = scenePath(scene, 1000);
    new Solver(scene, { number }).run(rows);
    const begin = performance.now();
    new Solver(scene, { number }).run(rows);
    return (1000 * (performance.now() - begin)) / (rows.length / 5);
  });
  return `${SCENES.map((scene, k) => `${scene} ${times[k].toFixed(1)} µs`).join(", ")}`;
}

const host = await Host.start();
const first = await files(host.origin);
const rows = [
  ["first frame, median of 5: from a web host, in one file", `${(await firstFrame(host.origin)).toFixed(0)} ms, ${(await firstFrame(oneFile)).toFixed(0)} ms`],
  [`ticks more than 2 ms late in ${options.seconds} s of dragging: box-flat`, await ticking(host.origin, "box-flat")],
  [`the same among obstacles: step`, await ticking(host.origin, "step")],
  ["weight until the first frame: Brotli, gzip", `${weight(first, brotliCompressSync)} kB, ${weight(first, (bytes) => gzipSync(bytes, { level: 9 }))} kB`],
  ["`stiction.html`: gzip", `${weight(["stiction.html"], (bytes) => gzipSync(bytes, { level: 9 }))} kB`],
  ["a sample in `run`, f32, Node.js", await step("f32")],
  ["a sample in `run`, f64", await step("f64")],
  ["a sample in `run`, fixed", await step("fixed")],
];
const machine = `${cpus().length} × ${cpus()[0].model.trim()}, ${type()} ${release()}, Chromium ${browser.version()} without a GPU, Node.js ${process.version}`;
await host.kill();
await browser.close();

const table = [`On ${machine}:`, "", "| what | figure |", "|---|---|", ...rows.map(([what, figure]) => `| ${what} | ${figure} |`)].join("\n");
console.log(table);
if (options.readme) {
  const file = fileURLToPath(new URL("../../wasm/README.md", import.meta.url));
  const [begin, end] = ["<!-- figures: begin -->", "<!-- figures: end -->"];
  const text = readFileSync(file, "utf8");
  const [from, to] = [text.indexOf(begin) + begin.length, text.indexOf(end)];
  if (from < begin.length || to < from) throw new Error(`README.md has no section between ${begin} and ${end}`);
  writeFileSync(`${file}.part`, `${text.slice(0, from)}\n${table}\n${text.slice(to)}`);
  renameSync(`${file}.part`, file);
}
