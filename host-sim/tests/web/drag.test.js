// The box is dragged with the mouse: the hand stays with the pointer. The drag is recorded, downloaded and replayed: the page,
// `stiction run` with the same path, and the replay show the same.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { liveTest, newFolder, runProgram } from "./live.js";
import { recordsOf, transitionsOf } from "./trace.js";

/** Number of slips after which a drag ends. */
const SLIPS = 6;
/** Depth of the box below the height at which its edge touches (m). */
const DEPTH = 0.01;
/** Largest distance of the drawn hand from the pointer (px). */
const TOGETHER = 2;

/** Returns the transitions that the diagram shows. @param {import("./live.js").Live} live */
function transitionsShown(live) {
  return live.page.evaluate(() =>
    Object.fromEntries(
      [...document.querySelectorAll("[data-pair]")]
        .filter((label) => label.textContent !== "")
        .map((label) => [label.getAttribute("data-pair"), Number(label.textContent?.replace(/\s/g, ""))]),
    ),
  );
}

/** Collects every state that the page shows. @param {import("./live.js").Live} live */
function watchStates(live) {
  return live.page.evaluate(() => {
    const name = /** @type {Element} */ (document.querySelector("#state-name"));
    const seen = [name.textContent];
    Object.assign(window, { seen });
    new MutationObserver(() => seen.push(name.textContent)).observe(name, {
      childList: true,
      characterData: true,
      subtree: true,
    });
  });
}

/** Returns true if the items of a list occur in another one, in the same order. @param {unknown[]} part @param {unknown[]} all */
function isSubsequence(part, all) {
  let next = 0;
  for (const item of all) if (item === part[next]) next++;
  return next === part.length;
}

/** Formats a pose as the page does. @param {Pose} pose */
function poseText([x, y, angle]) {
  const text = (/** @type {number} */ value) => (Math.abs(value) < 0.005 ? 0 : value).toFixed(2).replace("-", "−");
  return `${text(1e3 * x)}, ${text(1e3 * y)} mm, ${text((180 * angle) / Math.PI)}°`;
}

/**
 * Records a drag down to the floor and along it until it has stuck and slipped.
 * @param {import("./live.js").Live} live
 */
async function recordDrag(live) {
  const { page } = live;
  await page.click("#record");
  await live.until(() => window.stiction.state?.recording !== null);
  await live.fresh();
  await watchStates(live);
  live.received.keep = true;
  await live.grab();
  const { hand, contacts } = (await live.frame()).frame;
  assert.deepEqual(contacts, []);
  const { body, grasp } = (await live.state()).scene;
  // Height of the hand at which the lower edge touches the floor.
  const touching = (grasp?.[1] ?? 0) - Math.min(...body.map(([, y]) => y));
  await live.handTo(hand[0], touching - DEPTH);
  await live.until(() => window.stiction.frame?.frame.state === "edge");
  assert.equal((await live.frame()).counts.slips, 0);
  for (let k = 0; (await live.frame()).counts.slips < SLIPS; k++) {
    assert.ok(k < 1000, "it does not slip");
    await live.drag(3, 0);
    await live.fresh();
  }
  await page.mouse.up();
  await live.until(() => window.stiction.frame?.holding === null);
  await live.fresh();
  await page.click("#record");
  await live.until(() => window.stiction.state?.recording === null && window.stiction.state.recorded);
  live.received.keep = false;
}

/**
 * Returns the frames of the newest run among messages: their time only increases.
 * @param {any[]} messages @returns {TraceFrame[]}
 */
function newestRun(messages) {
  const frames = messages.filter(({ type }) => type === "frame").map(({ frame }) => frame);
  let first = frames.length - 1;
  while (first > 0 && frames[first - 1].t <= frames[first].t) first--;
  return frames.slice(first);
}

/** Returns the number of slips in the chart's title. @param {import("./live.js").Live} live */
const slipsShown = async (live) => Number((await live.reads("#now-slip", /in all/)).match(/(\d+) in all/)?.[1]);

for (const [number, evolution] of [
  ["f32", "path"],
  ["f64", "path"],
  ["fixed", "frame"],
]) {
  liveTest(`a drag with ${number}, ${evolution} is what run makes of its recording`, async (bench) => {
    const live = await bench.open();
    const { page } = live;
    await page.selectOption("#number", number);
    await page.selectOption("#evolution", evolution);
    await live.until(
      ([n, e]) => window.stiction.state?.number === n && window.stiction.state.evolution === e,
      [number, evolution],
    );
    await recordDrag(live);

    const folder = newFolder();
    const names = ["trace.jsonl", "scene.toml", "hand.csv"];
    const files = Object.fromEntries(await Promise.all(names.map(async (name) => [name, ""])));
    for (const name of names) {
      files[name] = await live.download(name);
      writeFileSync(join(folder, name === "trace.jsonl" ? "downloaded.jsonl" : name), files[name]);
    }
    await runProgram(
      [
        "run",
        "scene.toml",
        "--hand",
        "hand.csv",
        "--number",
        number,
        "--evolution",
        evolution,
        "--out",
        "trace.jsonl",
        "--quiet",
      ],
      folder,
    );
    assert.ok(readFileSync(join(folder, "trace.jsonl")).equals(readFileSync(join(folder, "downloaded.jsonl"))));

    const records = recordsOf(files["trace.jsonl"]);
    assert.equal((await live.state()).recorded?.frames, records.length);
    // Every frame that the page received is the record of its time.
    const byTime = new Map(records.map((record) => [record.t, record]));
    const got = newestRun(live.received.messages).filter(({ t }) => byTime.has(t));
    assert.ok(got.length > 20, `${got.length} frames`);
    for (const frame of got) assert.deepEqual(frame, byTime.get(frame.t));

    const slips = records.reduce((sum, record) => sum + record.slips, 0);
    assert.ok(slips >= SLIPS);
    assert.equal(await slipsShown(live), slips);
    assert.deepEqual(await transitionsShown(live), transitionsOf(records));
    const passed = records.map(({ state }) => state).filter((state, k, all) => state !== all[k - 1]);
    const shown = await page.evaluate(() => /** @type {any} */ (window).seen);
    assert.ok(isSubsequence(shown, passed), `${shown} in ${passed}`);
    assert.equal(shown.at(-1), passed.at(-1));
    // It rests where it was released, and stays at rest.
    const last = /** @type {TraceFrame} */ (records.at(-1));
    assert.equal(last.held, false);
    await live.until((text) => document.querySelector("#body-pose")?.textContent === text, poseText(last.pose));
  });
}

liveTest("a recording, its download and its replay are the same", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await recordDrag(live);
  const trace = recordsOf(await live.download("trace.jsonl"));
  const byTime = new Map(trace.map((record) => [record.t, record]));
  const last = /** @type {TraceFrame} */ (trace.at(-1));

  live.received.messages = [];
  live.received.keep = true;
  await page.selectOption("#replay", "recording");
  await live.until((end) => window.stiction.state?.replay && (window.stiction.frame?.position ?? 0) >= end, last.t);
  live.received.keep = false;
  const run = newestRun(live.received.messages.filter(({ position }) => position !== null)).filter(({ t }) =>
    byTime.has(t),
  );
  assert.ok(run.length > 20, `${run.length} frames`);
  for (const frame of run) assert.deepEqual(frame, byTime.get(frame.t));
  assert.equal(
    await slipsShown(live),
    trace.reduce((sum, { slips }) => sum + slips, 0),
  );
  assert.deepEqual(await transitionsShown(live), transitionsOf(trace));

  // The scrubber seeks any time, forward and back, running or paused, and shows its record.
  await page.click("#pause");
  await live.until(() => window.stiction.state?.paused);
  const box = await page.locator("#scrubber").boundingBox();
  assert.ok(box);
  for (const part of [0.5, 0.85, 0.2, 0.6]) {
    const before = (await live.frame()).position;
    await page.mouse.click(box.x + part * box.width, box.y + box.height / 2);
    const wanted = (Number(await page.inputValue("#scrubber")) / 1000) * last.t;
    assert.ok(Math.abs(wanted - part * last.t) < 0.05 * last.t, `${wanted} s for ${part} of ${last.t} s`);
    await live.until((old) => window.stiction.frame?.position !== old, before);
    const { frame, position } = await live.frame();
    assert.ok(Math.abs(Number(position) - wanted) < 0.002, `${position} s instead of ${wanted} s`);
    assert.equal(frame.t, position);
    assert.deepEqual(frame, byTime.get(frame.t));
    await live.reads("#state-name", new RegExp(`^${frame.state}$`));
    await live.until((text) => document.querySelector("#body-pose")?.textContent === text, poseText(frame.pose));
    const seconds = (/** @type {number} */ value) => (Math.abs(value) < 0.05 ? 0 : value).toFixed(1);
    await live.reads("#place", new RegExp(`^${seconds(frame.t)} of ${seconds(last.t)} s$`));
  }
  // Live again: body and hand stay where they are.
  const there = (await live.frame()).frame;
  await page.selectOption("#replay", "live");
  await live.until(() => window.stiction.state?.replay === null);
  await page.click("#pause");
  await live.until(
    (t) => !window.stiction.state?.paused && window.stiction.frame && window.stiction.frame.frame.t > t,
    there.t,
  );
  assert.deepEqual((await live.frame()).frame.hand, there.hand);
});

/**
 * Measures with every drawing the distance of the hand from the line between two points along which the pointer moves (px).
 * @param {import("./live.js").Live} live @param {Spot} from @param {Spot} to
 */
function watchLine(live, from, to) {
  return live.page.evaluate(
    ([a, b]) => {
      const page = /** @type {any} */ (window);
      page.line = [a, b];
      if (page.farthest !== undefined) return;
      page.farthest = 0;
      const look = () => {
        const [p, q] = /** @type {Spot[]} */ (page.line);
        const hand = window.stiction.frame?.frame.hand ?? [NaN, NaN];
        const at = window.stiction.pixelOf(hand[0], hand[1]);
        const [ex, ey] = [q.x - p.x, q.y - p.y];
        const part = ((at.x - p.x) * ex + (at.y - p.y) * ey) / (ex * ex + ey * ey);
        const along = Math.min(1, Math.max(0, part));
        page.farthest = Math.max(page.farthest, Math.hypot(at.x - p.x - along * ex, at.y - p.y - along * ey));
        requestAnimationFrame(look);
      };
      requestAnimationFrame(look);
    },
    [from, to],
  );
}

liveTest("the hand is drawn at the pointer, however fast and far it is dragged", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const begin = (await live.frame()).frame.hand;
  await live.grab();
  const origin = await live.pixel(0, 0);
  const box = await page.locator("#stage").boundingBox();
  assert.ok(box && live.pointer);
  const start = live.pointer;
  const [left, right, top, bottom] = [box.x + 3, box.x + box.width - 3, box.y + 3, box.y + box.height - 3];
  // To the corners crosswise, out of the window on the right, and back; in as many moves as a slow mouse makes, or in two.
  const places = [
    { x: left, y: bottom },
    { x: right, y: top },
    { x: left, y: top },
    { x: right, y: bottom },
    { x: right + 150, y: (top + bottom) / 2 },
    { x: left, y: (top + bottom) / 2 },
    start,
  ];
  for (const steps of [2, 12]) {
    for (const place of places) {
      await watchLine(live, live.pointer, place);
      live.pointer = place;
      await page.mouse.move(place.x, place.y, { steps });
      // The frame with the last sample of the pointer, and the hand there.
      const apart = await live.until(
        ([x, y, near]) => {
          const [hx, hy] = window.stiction.frame?.frame.hand ?? [NaN, NaN];
          const hand = window.stiction.pixelOf(hx, hy);
          const distance = Math.hypot(hand.x - x, hand.y - y);
          return distance <= near && { distance };
        },
        [place.x, place.y, TOGETHER],
      );
      assert.ok(apart);
      await live.fresh();
      const [hx, hy] = (await live.frame()).frame.hand;
      const hand = await live.pixel(hx, hy);
      assert.ok(Math.hypot(hand.x - place.x, hand.y - place.y) <= TOGETHER, `${hand.x}, ${hand.y} at ${place.x}, ${place.y}`);
    }
  }
  const farthest = await page.evaluate(() => /** @type {any} */ (window).farthest);
  assert.ok(farthest <= TOGETHER, `${farthest} px off the line on the way`);
  assert.deepEqual(await live.pixel(0, 0), origin, "the window moved");
  // After a displacement of some 15 windows it is where it began: no error has accumulated.
  const { hand } = (await live.frame()).frame;
  const pixel = await live.metresPerPixel();
  assert.ok(Math.hypot(hand[0] - begin[0], hand[1] - begin[1]) < pixel, String(hand));
  // A zoom during a drag is about the pointer.
  await page.keyboard.press("+");
  await live.drawn();
  assert.ok((await live.metresPerPixel()) < 0.9 * pixel);
  const zoomed = await live.pixel(hand[0], hand[1]);
  assert.ok(Math.hypot(zoomed.x - start.x, zoomed.y - start.y) <= TOGETHER);
  await page.mouse.up();
});
