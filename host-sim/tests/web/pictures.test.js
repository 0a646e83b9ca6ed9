// The drawing is correct: rounding is drawn as no force, counters agree with the trace, the charts show the same moment, and no
// value, however long, moves or covers anything.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { layoutFaults } from "./layout.js";
import { liveTest, newFolder, runProgram } from "./live.js";
import { openSaid, restingFrame } from "./said.js";
import { recordsOf, transitionsOf } from "./trace.js";

/** @typedef {import("./live.js").Live} Live */

/** Keeps the texts of the newest drawing of the scene, and their boxes (CSS px), in `window.written`. @param {Live} live */
const keepTexts = (live) =>
  live.page.evaluate(() => {
    const { prototype } = CanvasRenderingContext2D;
    const { fillText, fillRect } = prototype;
    /** @type {{text: string, left: number, top: number, right: number, bottom: number}[]} */
    let now = [];
    prototype.fillRect = function (x, y, width, height) {
      // A drawing begins with its background.
      if (this.canvas.id === "stage" && x === 0 && y === 0) Object.assign(window, { written: (now = []) });
      fillRect.call(this, x, y, width, height);
    };
    prototype.fillText = function (text, x, y) {
      if (this.canvas.id === "stage") {
        const { width } = this.measureText(text), from = this.textAlign === "center" ? x - width / 2 : x;
        const corners = [[from, y - 6], [from + width, y - 6], [from, y + 6], [from + width, y + 6]].map(([px, py]) =>
          this.getTransform().transformPoint({ x: px, y: py }));
        const canvas = this.canvas.getBoundingClientRect(), ratio = window.devicePixelRatio;
        const xs = corners.map((corner) => canvas.left + corner.x / ratio), ys = corners.map((corner) => canvas.top + corner.y / ratio);
        now.push({ text, left: Math.min(...xs), top: Math.min(...ys), right: Math.max(...xs), bottom: Math.max(...ys) });
      }
      fillText.call(this, text, x, y);
    };
  });

/** Returns what a page shows of forces and slips. @param {Live} live */
async function shownOf(live) {
  const texts = await live.page.evaluate(() => /** @type {any} */ (window).written.map((/** @type {any} */ { text }) => text));
  const [normal, friction, slip] = [
    await live.painted("normal"),
    await live.painted("friction"),
    await live.painted("slip"),
  ];
  return {
    values: texts.filter((/** @type {string} */ text) => /^[NT] /.test(text)),
    scale: texts.find((/** @type {string} */ text) => /N$/.test(text)),
    isDrawn: { normal: normal > 20, friction: friction > 20, slip: slip > 20 },
    words: [await live.text("#now-n"), await live.text("#now-t"), await live.text("#wrench")],
  };
}

/**
 * Returns the resting box with a force in both contacts, and a slip.
 * @param {number} force N @param {number} length m @param {Pose} wrench
 */
function pressed(force, length, wrench) {
  const message = restingFrame();
  for (const contact of message.frame.contacts) Object.assign(contact, { normal: force, friction: -0.5 * force, sliding: 1 });
  message.frame.wrench = wrench;
  message.strip = [[0, force, -0.5 * force]];
  if (length > 0) message.slips = [{ n: 1, t: 0, point: [0, 0], direction: [0, 1], length }];
  return message;
}

liveTest("what is below 1e-6 of the scene's force and length is neither drawn nor mentioned", async (bench) => {
  const { live, said } = await openSaid(bench);
  await keepTexts(live);
  // The box has L = 0.1166 m and k_h L = 58.3 N.
  const least = { force: 58.3e-6, length: 0.1166e-6 };
  const none = { normal: false, friction: false, slip: false };
  for (const part of [1e-6, 0.1, 0.9]) {
    await said.frame(pressed(part * least.force, part * least.length, [0, -part * least.force, 0]));
    const shown = await shownOf(live);
    assert.deepEqual(shown.values, []);
    assert.equal(shown.scale, undefined);
    assert.deepEqual(shown.isDrawn, none);
    assert.deepEqual(shown.words, ["N 0", "T 0", "0.00 N, 0.0 mN·m"]);
  }
  // The received message is not changed for its readers.
  assert.equal((await live.frame()).frame.contacts[0].normal, 0.9 * least.force);

  // At twice the threshold it is shown, and so is friction, which is half of the reaction, slightly above the threshold.
  await said.frame(pressed(2.2 * least.force, 2 * least.length, [0, 0, 0]));
  const above = await shownOf(live);
  assert.deepEqual(above.isDrawn, { normal: true, friction: true, slip: true });
  assert.deepEqual(above.values, ["N 1.28e−4", "T −6.4e−5", "N 1.28e−4", "T −6.4e−5"]);
  assert.match(above.scale, /µN$/);

  // If the hand pulls with a thousand times k_h L, its rounding is a thousand times as large.
  await said.frame(pressed(0.9e3 * least.force, 0, [0, -58.3e3, 0]));
  assert.deepEqual((await shownOf(live)).values, []);
  await said.frame(pressed(2.2e3 * least.force, 0, [0, -58.3e3, 0]));
  assert.equal((await shownOf(live)).values.length, 4);

  // A scene with a thousandth of the stiffness has a thousandth of the threshold.
  said.state({ title: "soft box" }, { stiffness_translation: 0.5, stiffness_rotation: 5e-4 });
  await said.frame(pressed(0.5 * least.force, 0.5 * least.length, [0, 0, 0]));
  const soft = await shownOf(live);
  assert.equal(soft.values.length, 4);
  assert.equal(soft.words[0], "N 0.0291");
  assert.equal(await live.text("#unit-force"), "mN");
});

liveTest("no button covers a value or a name", async (bench) => {
  const { live, said } = await openSaid(bench, { viewport: { width: 360, height: 740 } });
  await keepTexts(live);
  /** @type {Surface} */
  const wall = { name: "a wall behind the buttons", normal: [-1, 0], offset: -0.03, static: 0.5, dynamic: 0.3, memory: null };
  said.state({ title: "box at a wall", surfaces: [wall] });
  await said.frame(pressed(20, 0, [0, 0, 0]));
  const buttons = await Promise.all((await live.page.locator(".tools > div").all()).map((group) => group.boundingBox()));
  const [origin, unit] = [await live.pixel(0, 0), await live.pixel(1, 1)];
  let near = 0;
  for (const group of buttons) {
    assert.ok(group);
    for (const part of [0, 0.25, 0.5, 0.75, 1]) {
      const message = pressed(20, 0, [0, 0, 0]);
      const y = (group.y + part * group.height - origin.y) / (unit.y - origin.y);
      // Beside the buttons: what is under them has no room for its values.
      const x = (group.x - 30 - origin.x) / (unit.x - origin.x);
      message.frame.contacts.forEach((contact, i) => {
        Object.assign(contact, { surface: wall.name, point: [x - 0.01 * i, y] });
      });
      await said.frame(message);
      const texts = await live.page.evaluate(() => /** @type {any} */ (window).written);
      // A value without room near its contact is left out.
      const values = texts.filter((/** @type {any} */ { text }) => /^[NT] /.test(text)).length;
      assert.ok(values <= 4, `${values} values`);
      for (const { text, left, top, right, bottom } of texts) {
        // What is this near (px) was written with regard to the buttons.
        const beside = 60;
        near += Number(right > group.x - beside && top < group.y + group.height + beside && group.y - beside < bottom);
        for (const other of buttons) {
          const covers = other && left < other.x + other.width && other.x < right && top < other.y + other.height && other.y < bottom;
          assert.ok(!covers, `“${text}” is behind the buttons at ${other?.y} px`);
        }
      }
    }
  }
  assert.ok(near > 0, `${near}`);
});

liveTest("no hint covers the name of the floor", async (bench) => {
  for (const [width, height] of [[1280, 800], [1920, 1080]]) {
    const { live, said } = await openSaid(bench, { viewport: { width, height } });
    await keepTexts(live);
    await said.frame(restingFrame());
    const hints = await live.page.locator(".foot").boundingBox();
    const texts = await live.page.evaluate(() => /** @type {any} */ (window).written);
    const floor = texts.find((/** @type {any} */ { text }) => text === "floor");
    assert.ok(hints && floor && hints.width > 300);
    assert.ok(floor.right <= hints.x || floor.bottom <= hints.y, `the floor's name ends at ${floor.right}, ${floor.bottom} px`);
    await live.page.close();
  }
});

/** Returns the positions of all elements that must not move (px). @param {Live} live */
const places = (live) =>
  live.page.evaluate(() =>
    [...document.querySelectorAll("dt, th, h2, h3, figcaption b, .chart, .key, #events li, #diagram, canvas, button, select")]
      .filter((element) => element.checkVisibility())
      .map((element) => {
        const { left, top } = element.getBoundingClientRect();
        return `${element.id || element.textContent?.replace(/[\d\s]+$/, "")}: ${left.toFixed(1)}, ${top.toFixed(1)}`;
      }),
  );

/** Returns values that a scene may have, from the smallest to the largest. @param {number} size */
function extreme(size) {
  const message = pressed(size, size, [-size, -size, -size]);
  const many = Math.min(9_999_999, Math.ceil(Math.abs(size)));
  message.frame.hand = [-size, size, -size];
  message.frame.pose = [size, -size, -size];
  message.frame.status = "iteration-limit";
  message.frame.state = "single-vertex";
  message.holding = null;
  message.ghost = null;
  message.counts = {
    ticks: many, missed: many, slips: many,
    transitions: { "edge>single-vertex": many, "single-vertex>edge": many, "non-contact>single-vertex": many },
    events: Object.fromEntries(["touch", "lift", "tip", "land", "snap", "grasp", "release"].map((name) => [name, many])),
  };
  const time = Math.min(1000, Math.max(1e-9, Math.abs(size)));
  message.step = { median: time, worst: time };
  message.reference = {
    pose: [0, 0, 0], state: "locked", error: [size, -size], worst: [size, size], differ: many, since: many,
  };
  return message;
}

liveTest("values from 1e-9 to 1e6 fit, and move nothing", async (bench) => {
  for (const [width, height] of [[360, 740], [1280, 800], [1920, 1080]]) {
    const { live, said } = await openSaid(bench, { viewport: { width, height } });
    await said.frame(extreme(0.01));
    const before = await places(live);
    assert.ok(before.length > 50);
    for (const size of [1e-9, 1234.5678, 1e6, -1e6]) {
      await said.frame(extreme(size));
      assert.doesNotMatch(await live.page.innerText("body"), /NaN|Infinity|undefined|null/, `${size}`);
      assert.deepEqual(await places(live), before, `${size} at ${width} px`);
    }
    assert.deepEqual(await layoutFaults(live), [], `at ${width} px`);
    // A body of a thousand kilometres, and one of a micrometre.
    for (const size of [1e6, 1e-6]) {
      const [a, b] = [0.5 * size, 0.3 * size];
      said.state({
        title: `box of ${size} m`, body: [[-a, -b], [a, -b], [a, b], [-a, b]], grasp: [0, 0], reach: 0,
        start: [0, b, 0], home: [0, b, 0],
      });
      await said.frame(extreme(size));
      assert.deepEqual(await layoutFaults(live), [], `a box of ${size} m at ${width} px`);
      assert.match(await live.text("#body-pose"), size > 1 ? /^1\.00, −1\.00 Mm/ : /^1\.00, −1\.00 µm/);
    }
    await live.page.close();
  }
});

/**
 * Returns a hand that presses the box and throws it back and forth and over, with several slips and tips per tick.
 * @param {number} k number of the tick
 */
function thrown(k) {
  const x = k > 300 ? 0.03 * Math.sin(0.7 * (k - 300)) : 0;
  const phi = k > 600 ? 1.2 * Math.sin(0.9 * (k - 600)) : 0;
  const y = k > 600 ? 0.048 : 0.05 - 0.012 * Math.min(1, k / 200);
  return [k / 1000, x, y, phi].map((value) => value.toFixed(6)).join(",");
}

liveTest("every counter is that of the trace, and slips have one count", async (bench) => {
  const live = await bench.open();
  await live.scene("box-flat");
  const folder = newFolder();
  const file = join(folder, "thrown.csv");
  writeFileSync(file, `t,x,y,phi\n${Array.from({ length: 1200 }, (_, k) => thrown(k)).join("\n")}\n`);
  await live.page.setInputFiles("#file", file);
  await live.until(() => window.stiction.state?.replay?.what === "thrown.csv" && window.stiction.frame?.position === 1.199);
  await live.settled();
  const trace = await runProgram(["run", "box-flat", "--hand", file, "--out", "trace.jsonl", "--quiet"], folder);
  assert.equal(trace, "");
  const records = recordsOf(readFileSync(join(folder, "trace.jsonl"), "utf8"));
  assert.equal(records.length, 1200);

  const slips = records.reduce((sum, record) => sum + record.slips, 0);
  /** @type {{[name: string]: number}} */
  const events = {};
  for (const name of records.flatMap((record) => record.events)) events[name] = (events[name] ?? 0) + 1;
  const transitions = transitionsOf(records);
  // These differ for this path.
  assert.ok(slips > 2 * events.slip && events.tip > 2 * transitions["edge>single-vertex"]);

  const number = (/** @type {string} */ text) => Number(text.replace(/\s/g, "").match(/\d+/)?.[0]);
  await live.until((wanted) => document.querySelector("#now-slip")?.textContent?.replace(/\s/g, "").endsWith(`,${wanted}inall`), slips);
  const chips = await live.page.locator("#events li").all();
  for (const chip of chips) {
    const text = await chip.innerText();
    const name = text.split(" ")[0];
    assert.equal(number(text), name === "slip" ? slips : (events[name] ?? 0), name);
    assert.match((await chip.getAttribute("title")) ?? "", new RegExp(`^${name}: .{10,}`));
  }
  assert.equal(chips.length, 11);
  const arrows = await live.page.evaluate(() =>
    [...document.querySelectorAll("[data-pair]")].map((label) => ({
      pair: label.getAttribute("data-pair") ?? "",
      count: Number(label.textContent?.replace(/\s/g, "") || 0),
      title: label.parentElement?.querySelector("title")?.textContent ?? "",
    })),
  );
  assert.deepEqual(Object.fromEntries(arrows.filter(({ count }) => count > 0).map(({ pair, count }) => [pair, count])), transitions);
  for (const { title } of arrows) assert.match(title, /within a tick/);
});

liveTest("the charts show one span of time, and under the pointer one moment", async (bench) => {
  const live = await bench.open();
  live.received.keep = true;
  await live.scene("corner-stick-slip");
  await live.page.selectOption("#replay", "scene");
  /** Returns the ranges of all charts at the same time. */
  const spans = () =>
    live.page.evaluate(() =>
      /** @type {any} */ (uPlot).sync("stiction-time").plots.map(({ scales }) => `${scales.x.min} to ${scales.x.max}`),
    );
  for (let k = 0; k < 5; k++) {
    const all = await spans();
    assert.equal(all.length, 3);
    assert.equal(new Set(all).size, 1, String(all));
    await live.fresh();
  }
  await live.until(() => (window.stiction.frame?.position ?? 0) > 2.5);
  await live.pause();
  const strip = live.received.messages.flatMap((message) => message.strip ?? []);
  const moments = () => live.page.locator(".moment:visible").allInnerTexts();
  for (const id of ["chart-forces", "chart-slips", "chart-steps"]) {
    const area = await live.page.locator(`#${id} .u-over`).boundingBox();
    assert.ok(area);
    const [from, to] = (await spans())[0].split(" to ").map(Number);
    const wanted = from + 0.25 * (to - from);
    await live.page.mouse.move(area.x + 0.25 * area.width, area.y + area.height / 2);
    await live.until(() => document.querySelectorAll(".moment:not([hidden])").length === 3);
    const all = await moments();
    assert.equal(new Set(all).size, 1, `${id}: ${all}`);
    const moment = parseFloat(all[0]);
    assert.ok(Math.abs(moment - wanted) < 0.05 * (to - from), `${all[0]} instead of ${wanted} s`);
    const lines = await live.page.evaluate(() =>
      [...document.querySelectorAll(".u-cursor-x")].map((line) => line.getBoundingClientRect().left -
        /** @type {Element} */ (line.parentElement).getBoundingClientRect().left),
    );
    assert.equal(lines.length, 3);
    assert.ok(Math.max(...lines) - Math.min(...lines) < 1.5, String(lines));
    /** Returns the last record up to a time after the moment. @param {number} later s */
    const at = (later) => strip.filter(([t]) => t <= moment + later).at(-1);
    const [, normal, friction] = at(5e-4);
    for (const [label, value] of /** @type {[string, number][]} */ ([["#now-n", normal], ["#now-t", friction]])) {
      const shown = Number((await live.text(label)).replace("−", "-").match(/-?[\d.]+/)?.[0]);
      const [low, high] = [-0.002, 0.002].map((later) => at(later)[label === "#now-n" ? 1 : 2]);
      const room = 0.006 * Math.abs(value) + Math.abs(high - low);
      assert.ok(Math.abs(shown - value) <= room, `${label}: ${shown} at ${moment} s instead of ${value}`);
    }
    await live.reads("#now-worst", /^worst [\d.]+ /);
  }
  // With the pointer outside the charts: the newest again.
  await live.page.mouse.move(600, 100);
  await live.until(() => document.querySelectorAll(".moment:not([hidden])").length === 0);
  const last = strip.at(-1)[1];
  await live.until((value) => Math.abs(parseFloat((document.querySelector("#now-n")?.textContent ?? "").slice(2)) - value) < 0.006 * value, last);
});
