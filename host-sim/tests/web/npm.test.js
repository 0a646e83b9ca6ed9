// The npm package: the first lines of its README run, errors are reported, and its results have the same bits as the program's.

import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { createHash } from "node:crypto";
import { existsSync, mkdirSync, readFileSync, symlinkSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath, pathToFileURL } from "node:url";
import { build } from "vite";
import { Host, missingPage, npm } from "./alone.js";
import { newFolder, startBrowser } from "./live.js";

const workspace = fileURLToPath(new URL("../../../", import.meta.url));
/** Frames of a walk. */
const FRAMES = 100_000;
const options = { skip: missingPage };

/** @returns {Promise<any>} */
const load = () => import(pathToFileURL(join(npm, "node.js")).href);

/** Returns a folder in which the package is installed. */
function installed() {
  const folder = newFolder();
  mkdirSync(join(folder, "node_modules"));
  symlinkSync(npm, join(folder, "node_modules", "stiction"));
  writeFileSync(join(folder, "package.json"), '{"type": "module"}');
  return folder;
}

/** Returns a folder in which the package is installed, with a page of this script and of this worker. @param {string} main @param {string} worker */
function pageOf(main, worker) {
  const folder = installed();
  writeFileSync(join(folder, "index.html"), '<script type="module" src="./main.js"></script>');
  writeFileSync(join(folder, "main.js"), main);
  writeFileSync(join(folder, "worker.js"), worker);
  return folder;
}

/** Returns the first lines of the README. */
function firstLines() {
  const [, lines] = readFileSync(join(npm, "README.md"), "utf8").match(/```js\n(.*?)```/s) ?? [];
  assert.ok(lines && lines.trim().split("\n").length <= 10);
  return lines;
}

test("the first ten lines of the README run, and have the right types", options, () => {
  const folder = installed();
  writeFileSync(join(folder, "first.js"), firstLines());
  const output = execFileSync(process.execPath, ["first.js"], { cwd: folder, encoding: "utf8" });
  assert.match(output, /\d+ poses, the last force: Float64Array\(3\)/);
  writeFileSync(join(folder, "first.ts"), `${firstLines()}\nexport const x: number = frame.pose[0];\n// @ts-expect-error\nnew Solver(3);\n`);
  const tsc = join(fileURLToPath(new URL(".", import.meta.url)), "node_modules/typescript/bin/tsc");
  const flags = ["--noEmit", "--strict", "--target", "es2022", "--module", "nodenext", "--moduleResolution", "nodenext"];
  writeFileSync(
    join(folder, "init.ts"),
    `import { init } from "stiction/init";
    export const slips: number = (await init()).Solver.prototype.step(0, 0, 0, true, 1).slips;
    const { scenePath } = await init(new URL("file:///a.wasm"));
    export const rows: Float64Array = scenePath("ladder", 100);\n`,
  );
  execFileSync(process.execPath, [tsc, ...flags, "--lib", "es2022,dom", "first.ts", "init.ts"], { cwd: folder, stdio: "pipe" });
});

/** Returns the steps of a page and its worker: one each. @param {string} from */
const steps = (from) => `import { Solver } from "${from}";
  const solver = new Solver("box-flat");
  solver.step(0, 0.03, 0);
  const frame = solver.step(0.004, 0.02, 0);
`;

/**
 * Shows the page of a folder, as a bundler has made it if there is such a page, and returns what a condition in it gives at last.
 * @param {import("playwright-core").Browser} browser @param {string} folder @param {string} condition
 */
async function given(browser, folder, condition) {
  const bundled = join(folder, "dist");
  const host = await Host.start(existsSync(bundled) ? bundled : folder);
  const page = await browser.newPage();
  await page.goto(host.origin);
  const value = await (await page.waitForFunction(condition)).jsonValue();
  await page.close();
  await host.kill();
  return value;
}

test("it runs in a page and in a worker, as it is and by a bundler", options, async () => {
  const { Solver } = await load();
  const solver = new Solver("box-flat");
  solver.step(0, 0.03, 0);
  const { wrench } = solver.step(0.004, 0.02, 0);

  const browser = await startBrowser();
  try {
    for (const from of ["/node_modules/stiction/web.js", "stiction"]) {
      const folder = pageOf(
        `${steps(from)}
        window.here = frame.wrench;
        const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
        worker.onmessage = ({ data }) => (window.there = data);`,
        `${steps(from)} postMessage(frame.wrench);`,
      );
      if (from === "stiction") {
        await build({ root: folder, logLevel: "error", worker: { format: "es" }, build: { target: "es2022" } });
      }
      assert.deepEqual(await given(browser, folder, "window.there && [window.here, window.there]"), [wrench, wrench], from);
    }
  } finally {
    await browser.close();
  }
});

test("what is wrong is reported, with what is allowed", options, async () => {
  const { Solver, scenePath, sceneText } = await load();
  assert.throws(() => new Solver("nowhere"), /no scene "nowhere", allowed: .*box-flat/);
  assert.throws(() => new Solver("[body]\nvertices = 3\n"), /scene\.toml.*2|vertices/s);
  assert.throws(() => new Solver("ladder", { number: "f16" }), /`number`.*f16.*allowed: f64, f32, fixed/);
  assert.throws(() => new Solver("ladder", { budget: 0 }), /`budget`.*allowed: a whole number/);
  assert.throws(() => new Solver("ladder").run(new Float64Array(4)), /4 numbers, allowed: rows of 5/);
  assert.throws(() => scenePath("ladder", -1), /`rate`/);
  assert.match(sceneText("ladder"), /\[body\]/);
});

test("an argument of another type is refused by its name", options, async () => {
  const { Solver, scenePath, sceneText } = await load();
  for (const [value, shown] of [[42, "42"], [undefined, "undefined"], [null, "null"], [{ length: 9 }, "an object"], [["a"], "an array"]]) {
    const message = { name: "Error", message: `\`scene\` is ${shown}, allowed: a string` };
    assert.throws(() => new Solver(value), message);
    assert.throws(() => scenePath(value), message);
    assert.throws(() => sceneText(value), /^Error: `name` is .*, allowed: a string$/);
  }
  const solver = new Solver("ladder");
  assert.throws(() => solver.step("0.1", 0, 0), /`x` is "0.1", allowed: a number/);
  assert.throws(() => solver.step(0, 0), /`phi` is undefined, allowed: a number/);
  assert.throws(() => solver.step(0, 0, 0, true, "now"), /`t` is "now", allowed: a number/);
  assert.throws(() => solver.step(0, 0, 0, "no"), /`held` is "no", allowed: true or false/);
  assert.throws(() => solver.run(42), /`samples` is 42, allowed: a Float64Array/);
  assert.throws(() => solver.run("0,0,0,0,1"), /`samples` is "0,0,0,0,1", allowed: a Float64Array/);
  assert.throws(() => solver.run([0, 0, 0, 0, 1n]), /`samples\[4\]` is 1n?, allowed: a number/);
  assert.throws(() => scenePath("ladder", "fast"), /`rate` is "fast", allowed: a finite number above 0/);
  // A value that no tracker means is a number, and holds the hand; an array is as good as a typed one.
  const [t, x, y, phi, held] = scenePath("ladder");
  assert.equal(solver.step(x, y, phi, 1, null).status, "ok");
  assert.equal(solver.step(NaN, y, phi, true).status, "held-last");
  assert.deepEqual(new Solver("ladder").run([t, x, y, phi, held]), new Solver("ladder").run(scenePath("ladder").subarray(0, 5)));
});

test("a solver that was freed says so, and its copy goes on", options, async () => {
  const { Solver } = await load();
  const solver = new Solver("box-flat");
  solver.step(0, 0.03, 0);
  const copy = solver.copy();
  solver.free();
  const uses = [
    () => solver.step(0, 0.03, 0), () => solver.run(new Float64Array(5)), () => solver.copy(), () => solver.number, () => solver.free(),
  ];
  for (const use of uses) assert.throws(use, /^Error: this solver was freed.*allowed: a new one/, String(use));
  assert.equal(copy.step(0, 0.03, 0).status, "ok");
});

test("unknown options are refused by name", options, async () => {
  const { Solver } = await load();
  assert.throws(() => new Solver("ladder", { nubmer: "f64" }), /unknown option `nubmer`, did you mean `number`\? \(allowed: number, evolution, budget\)/);
  assert.throws(() => new Solver("ladder", { mu: 1 }), /unknown option `mu` \(allowed/);
  assert.throws(() => new Solver("ladder", "f64"), /`options` is "f64", allowed: an object with any of number/);
  assert.throws(() => new Solver("ladder", ["f64"]), /`options` is an array/);
  assert.equal(new Solver("ladder", {}).number, "f32");
  assert.equal(new Solver("ladder", { number: undefined, budget: undefined }).number, "f32");
});

test("init loads the wasm once, and after a failure again", options, async () => {
  const folder = installed();
  writeFileSync(
    join(folder, "init.js"),
    `import { init } from "stiction/init";
    const failure = await init(new Uint8Array(8)).catch((why) => why);
    const [a, b] = await Promise.all([init(), init()]);
    const all = await import("stiction");
    console.log(JSON.stringify([failure instanceof WebAssembly.CompileError, a === b, a.Solver === all.Solver, Object.keys(a).sort()]));
    console.log(JSON.stringify(Object.keys(all).sort()), new a.Solver("ladder").number);`,
  );
  const output = execFileSync(process.execPath, ["init.js"], { cwd: folder, encoding: "utf8" });
  const names = '["Solver","sceneNames","scenePath","sceneText","stateNames","statusNames"]';
  assert.equal(output, `[true,true,true,${names}]\n${names} f32\n`);
});

test("a worker with init answers a message that is posted before the wasm is loaded", options, async () => {
  const { Solver } = await load();
  const expected = new Solver("box-flat").step(0, 0.03, 0).wrench;
  const browser = await startBrowser();
  try {
    for (const from of ["/node_modules/stiction/init.js", "stiction/init"]) {
      const folder = pageOf(
        `const worker = new Worker(new URL("./worker.js", import.meta.url), { type: "module" });
        worker.onmessage = ({ data }) => (window.answers = [...(window.answers ?? []), data]);
        for (const scene of ["box-flat", "nowhere"]) worker.postMessage(scene);`,
        `import { init } from "${from}";
        self.onmessage = async ({ data }) => {
          const { Solver } = await init();
          try {
            self.postMessage(new Solver(data).step(0, 0.03, 0).wrench);
          } catch ({ message }) {
            self.postMessage(message);
          }
        };`,
      );
      // Without top-level await, the bundler's default targets do.
      if (from === "stiction/init") await build({ root: folder, logLevel: "error", worker: { format: "es" } });
      const answers = await given(browser, folder, "window.answers?.length === 2 && window.answers");
      assert.deepEqual(answers[0], expected, from);
      assert.match(answers[1], /no scene "nowhere"/);
    }
  } finally {
    await browser.close();
  }
});

test("a step, a run and a copy come to the same, and physics holds", options, async () => {
  const { Solver, scenePath, stateNames } = await load();
  const rows = scenePath("ladder", 1000);
  const one = new Solver("ladder"), all = new Solver("ladder").run(rows);
  let copy = one;
  for (let k = 0; k < rows.length / 5; k++) {
    if (k === 10) copy = one.copy();
    const [t, x, y, phi, held] = rows.subarray(5 * k, 5 * k + 5);
    const frame = one.step(x, y, phi, held === 1, t);
    // The digits of a record are those of f32.
    assert.deepEqual(frame.pose.map(Math.fround), [...all.pose.subarray(3 * k, 3 * k + 3)]);
    assert.equal(frame.state, stateNames()[all.state[k]]);
    for (const { normal } of frame.contacts) assert.ok(normal >= 0);
    if (k >= 10) assert.deepEqual(copy === one ? frame : copy.step(x, y, phi, held === 1, t), frame);
  }
});

test("a run continues where the solver is", options, async () => {
  const { Solver, scenePath } = await load();
  const rows = scenePath("ladder", 1000);
  const whole = new Solver("ladder").run(rows);
  const solver = new Solver("ladder");
  const half = 5 * Math.floor(rows.length / 10);
  const parts = [rows.subarray(0, half), rows.subarray(half)].map((part) => solver.run(part));
  for (const name of ["t", "pose", "wrench", "state", "status", "slips"]) {
    assert.deepEqual(parts.flatMap((part) => [...part[name]]), [...whole[name]], name);
  }
});

test(`${FRAMES} frames of ten scenes have the same bits as the program's, in every number type`, options, async () => {
  const { Solver } = await load();
  const folder = newFolder();
  // The wasm is optimised, the program is not: the bits do not depend on it.
  const walks = join(process.env.CARGO_TARGET_DIR ?? join(workspace, "target"), "debug", "examples", "walks");
  const printed = execFileSync(walks, [folder, String(FRAMES)], { encoding: "utf8" });
  const runs = printed.trim().split("\n").map((line) => JSON.parse(line));
  assert.equal(runs.length, 30);
  assert.ok(runs.reduce((sum, { slips }) => sum + slips, 0) > 1000);
  for (const { scene, number, sha256 } of runs) {
    const { buffer } = new Uint8Array(readFileSync(join(folder, `${scene}.f64`)));
    const answers = new Solver(scene, { number }).run(new Float64Array(buffer));
    const hash = createHash("sha256");
    for (const name of ["t", "pose", "wrench", "state", "status", "slips", "contacts"]) {
      const { buffer: bytes, byteOffset, byteLength } = answers[name];
      hash.update(new Uint8Array(bytes, byteOffset, byteLength));
    }
    assert.equal(hash.digest("hex"), sha256, `${scene}, ${number}`);
  }
});
