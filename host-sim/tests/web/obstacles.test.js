// Obstacles with corners on the page, and the meter of a peg in its hole.

import assert from "node:assert/strict";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/**
 * Replays the scene's path until the peg has two points at a depth (m), and pauses there.
 * @param {Live} live @param {number} depth
 */
async function insert(live, depth) {
  await live.scene("peg-in-hole");
  await live.page.selectOption("#replay", "scene");
  await live.until((least) => {
    const insertion = window.stiction.frame?.frame.insertion;
    return insertion?.verdict === "two-point" && insertion.depth > least;
  }, depth);
  await live.pause();
}

/** Returns the number of painted pixels of a canvas. @param {Live} live @param {string} id */
const painted = (live, id) =>
  live.page.evaluate((name) => {
    const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById(name));
    const context = canvas.getContext("2d");
    if (!context || canvas.width === 0) return 0;
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    return data.filter((value, i) => i % 4 === 3 && value > 0).length;
  }, id);

liveTest("the meter is there where a scene has a peg and a hole, and nowhere else", async (bench) => {
  const live = await bench.open();
  const panel = live.page.locator("#insertion");
  // Its code is not loaded, either.
  assert.equal(await panel.count(), 0);
  await live.scene("table-edge");
  assert.ok(await panel.isHidden());
  await insert(live, 0.008);
  assert.ok(await panel.isVisible());
  // It may have moved farther before the pause.
  const { insertion } = (await live.frame()).frame;
  assert.ok(insertion);
  await live.reads("#verdict", new RegExp(`^${insertion.verdict}$`));
  await live.reads("#peg-depth", new RegExp(`^${(1e3 * insertion.depth).toFixed(3)} mm of 47\\.0 mm$`));
  for (const id of ["jamming", "force-depth"]) assert.ok((await painted(live, id)) > 500, id);
  await live.page.click("#pause");
  await live.scene("box-flat");
  await live.until(() => document.querySelector("#insertion")?.hasAttribute("hidden"));
});

liveTest("a peg that is not in its hole has no reading", async (bench) => {
  const live = await bench.open();
  await live.scene("peg-in-hole");
  await live.reads("#verdict", /^not in the hole$/);
  await live.reads("#peg-margin", /^–$/);
});

liveTest("a corner that touches is ringed, and the chart offers the obstacles", async (bench) => {
  const live = await bench.open();
  await insert(live, 0.008);
  const names = await live.page.locator("#chart-surface option").allTextContents();
  assert.deepEqual(names, ["left", "right", "bottom"]);
  const { contacts } = (await live.frame()).frame;
  const corner = contacts.find((contact) => contact.corner !== undefined);
  assert.ok(corner);
  // The ring's colour on a circle around the corner.
  const place = await live.pixel(corner.point[0], corner.point[1]);
  const ringed = await live.page.evaluate(([x, y]) => {
    const canvas = /** @type {HTMLCanvasElement} */ (document.getElementById("stage"));
    const { left, top, width } = canvas.getBoundingClientRect();
    const ratio = canvas.width / width;
    const probe = document.body.appendChild(document.createElement("i"));
    probe.style.color = "var(--friction)";
    const want = getComputedStyle(probe).color.match(/\d+/g)?.map(Number) ?? [];
    probe.remove();
    const context = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d"));
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    let hits = 0;
    for (let angle = 0; angle < 360; angle += 5) {
      const [c, s] = [Math.cos((angle * Math.PI) / 180), Math.sin((angle * Math.PI) / 180)];
      const isRing = [8, 9, 10].some((r) => {
        const [column, row] = [x - left + r * c, y - top + r * s].map((at) => Math.floor(at * ratio));
        return want.every((value, k) => Math.abs(value - data[4 * (row * canvas.width + column) + k]) < 40);
      });
      if (isRing) hits++;
    }
    return hits;
  }, /** @type {[number, number]} */ ([place.x, place.y]));
  assert.ok(ringed > 30, `${ringed} of 72`);
});
