// Texts in the drawing: next to what they name, and not on lines or on one another, in all scenes and in windows of four sizes.

import assert from "node:assert/strict";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/** Windows (px). */
const WINDOWS = [
  { width: 1280, height: 800 },
  { width: 1440, height: 900 },
  { width: 1920, height: 1080 },
  { width: 390, height: 844 },
];
/** Largest distance of a text from what it names, and least distance of two texts (px): that of two words. */
const FARTHEST = 40;
const APART = 4;
/** Parts of a path at which a scene is looked at. */
const PLACES = [0.12, 0.35, 0.6, 0.85];

/** Records the texts and straight lines of each drawing of the stage as `drawn`, in CSS pixels. @param {Live} live */
const record = (live) =>
  live.page.evaluate(() => {
    const { prototype } = CanvasRenderingContext2D;
    const { fillText, fillRect, beginPath, moveTo, lineTo, closePath, stroke } = prototype;
    /** @typedef {{text: string, box: number[]}} Text */
    /** @typedef {{ends: number[], half: number, width: number, color: string}} Line */
    /** @type {{texts: Text[], lines: Line[]}} */
    let drawn = { texts: [], lines: [] };
    /** @type {number[][]} */
    let path = [];
    Object.defineProperty(window, "drawn", { get: () => drawn });
    const placed = (/** @type {CanvasRenderingContext2D} */ ctx, /** @type {number} */ x, /** @type {number} */ y) => {
      const { x: px, y: py } = ctx.getTransform().transformPoint(new DOMPoint(x, y));
      return [px / devicePixelRatio, py / devicePixelRatio];
    };
    prototype.fillRect = function (x, y, w, h) {
      // A drawing begins with its background.
      if (this.canvas.id === "stage" && x === 0 && y === 0) drawn = { texts: [], lines: [] };
      fillRect.call(this, x, y, w, h);
    };
    prototype.beginPath = function () {
      path = [];
      beginPath.call(this);
    };
    prototype.moveTo = function (x, y) {
      path.push([NaN, NaN], [x, y]);
      moveTo.call(this, x, y);
    };
    prototype.lineTo = function (x, y) {
      path.push([x, y]);
      lineTo.call(this, x, y);
    };
    prototype.closePath = function () {
      path.push(path[0]);
      closePath.call(this);
    };
    prototype.stroke = function (/** @type {any[]} */ ...shapes) {
      Reflect.apply(stroke, this, shapes);
      if (this.canvas.id !== "stage" || shapes.length > 0) return;
      for (let k = 1; k < path.length; k++) {
        const ends = [...placed(this, path[k - 1][0], path[k - 1][1]), ...placed(this, path[k][0], path[k][1])];
        const half = (this.lineWidth / 2) * this.getTransform().a / devicePixelRatio;
        if (!ends.some(Number.isNaN)) drawn.lines.push({ ends, half, width: this.lineWidth, color: String(this.strokeStyle) });
      }
    };
    prototype.fillText = function (text, x, y) {
      fillText.call(this, text, x, y);
      if (this.canvas.id !== "stage") return;
      const { width } = this.measureText(text);
      const left = x - { left: 0, right: width, center: width / 2, start: 0, end: width }[this.textAlign];
      // The height of the capital letters: round letters and halos may come nearer to a line.
      const [one, other] = [placed(this, left, y - 4.5), placed(this, left + width, y + 4.5)];
      drawn.texts.push({ text, box: [Math.min(one[0], other[0]), Math.min(one[1], other[1]), Math.max(one[0], other[0]), Math.max(one[1], other[1])] });
    };
  });

/** Returns what is wrong with the texts of the newest drawing, and the largest distance of a text from what it names. @param {Live} live */
const look = (live) =>
  live.page.evaluate(([farthest, apart]) => {
    /** @type {{texts: {text: string, box: number[]}[], lines: {ends: number[], half: number, width: number, color: string}[]}} */
    const { texts, lines } = /** @type {any} */ (window).drawn;
    const { scene } = /** @type {StateMessage} */ (window.stiction.state);
    const color = (/** @type {string} */ role) => {
      const probe = document.body.appendChild(document.createElement("i"));
      probe.style.color = `var(--${role})`;
      const { fillStyle } = Object.assign(/** @type {any} */ (new OffscreenCanvas(1, 1).getContext("2d")), { fillStyle: getComputedStyle(probe).color });
      probe.remove();
      return fillStyle;
    };
    const [normal, friction, grid, trail, body] = ["normal", "friction", "grid", "trail-hand", "body"].map(color);
    const stage = /** @type {Element} */ (document.querySelector("#stage")).getBoundingClientRect();
    const gap = (/** @type {number[]} */ a, /** @type {number[]} */ b) =>
      Math.hypot(Math.max(0, b[0] - a[2], a[0] - b[2]), Math.max(0, b[1] - a[3], a[1] - b[3]));
    const boxOf = (/** @type {number[]} */ [x1, y1, x2, y2]) => [Math.min(x1, x2), Math.min(y1, y2), Math.max(x1, x2), Math.max(y1, y2)];
    const touches = (/** @type {number[]} */ box, /** @type {{ends: number[], half: number}} */ { ends: [x1, y1, x2, y2], half }) => {
      const steps = Math.ceil(Math.hypot(x2 - x1, y2 - y1)) + 1;
      if (steps > 4000) return false;
      for (let k = 0; k <= steps; k++) {
        const x = x1 + ((x2 - x1) * k) / steps, y = y1 + ((y2 - y1) * k) / steps;
        if (gap(box, [x, y, x, y]) < half) return true;
      }
      return false;
    };
    /** @type {string[]} */
    const faults = [];
    let worst = 0;
    const isName = (/** @type {string} */ text) => scene.obstacles?.some(({ name }) => text === name);
    const labels = texts.filter(({ text }) => /^[NT] /.test(text) || isName(text));
    for (const { text, box } of labels) {
      const obstacle = scene.obstacles?.find(({ name }) => name === text);
      const named = obstacle ? obstacle.vertices.map(([x, y]) => window.stiction.pixelOf(x, y)).map(({ x, y }) => [x - stage.left, y - stage.top]) : [];
      const inside = named.map(([x, y]) => [Math.min(stage.width, Math.max(0, x)), Math.min(stage.height, Math.max(0, y))]);
      const distance = obstacle
        ? gap(box, [Math.min(...inside.map(([x]) => x)), Math.min(...inside.map(([, y]) => y)), Math.max(...inside.map(([x]) => x)), Math.max(...inside.map(([, y]) => y))])
        : Math.min(...[
          ...lines.filter((line) => line.color === (text[0] === "N" ? normal : friction)).map(({ ends }) => boxOf(ends)),
          ...(window.stiction.frame?.frame.contacts ?? []).map(({ point: [px, py] }) => window.stiction.pixelOf(px, py))
            .map(({ x, y }) => [x - stage.left, y - stage.top, x - stage.left, y - stage.top]),
        ].map((part) => gap(box, part)));
      const other = obstacle && scene.obstacles?.find(({ vertices: corners }) => corners.length > 2 && obstacle.vertices !== corners
        && corners.map(([x, y]) => window.stiction.pixelOf(x, y)).every(({ x, y }, k, all) => {
          const next = all[(k + 1) % all.length];
          const [px, py] = [stage.left + (box[0] + box[2]) / 2, stage.top + (box[1] + box[3]) / 2];
          return (next.x - x) * (py - y) < (next.y - y) * (px - x);
        }));
      if (other) faults.push(`“${text}” is in “${other.name}”`);
      worst = Math.max(worst, distance);
      if (distance > farthest) faults.push(`“${text}” is ${distance.toFixed(0)} px from what it names`);
      // Not the grid, not the trails and the cross of the body, which is thinner than its outline.
      const crossed = lines.find((line) => ![grid, trail].includes(line.color) && (line.width > 2 || line.color !== body) && touches(box, line));
      if (crossed) faults.push(`“${text}” at ${box.map(Math.round)} is on a line of ${crossed.color}, ${crossed.ends.map(Math.round)}`);
      for (const other of texts) {
        if (other.box !== box && gap(box, other.box) < apart) faults.push(`“${text}” is on “${other.text}”`);
      }
      for (const button of document.querySelectorAll(".tools button, .foot > *")) {
        const { left, top, right, bottom, width } = button.getBoundingClientRect();
        const place = [left - stage.left, top - stage.top, right - stage.left, bottom - stage.top];
        if (width > 0 && gap(box, place) === 0) faults.push(`“${text}” is under “${button.textContent?.trim()}”`);
      }
    }
    const normals = labels.filter(({ text }) => text.startsWith("N ")).length;
    return { faults, worst, normals, count: labels.length, contacts: window.stiction.frame?.frame.contacts.length ?? 0 };
  }, [FARTHEST, APART]);

for (const viewport of WINDOWS) {
  liveTest(`at ${viewport.width} px every text is next to what it names, and on nothing`, async (bench) => {
    const live = await bench.openFirst({ viewport });
    const { page } = live;
    await record(live);
    // With the details the drawing is small.
    if (viewport.width === 1440) await page.click("#details-open");
    await page.click("#scenes-open");
    const scenes = await page.locator(".card input").evaluateAll((inputs) => inputs.map((input) => /** @type {HTMLInputElement} */ (input).value));
    /** @type {string[]} */
    const faults = [];
    let [worst, count, contacts] = [0, 0, 0];
    /** Contacts of a block in the crook of a hook, between its two arms, and their values of N. */
    const crook = { contacts: 0, values: 0 };
    for (const scene of scenes) {
      await live.scene(scene);
      await page.evaluate(() => {
        const list = /** @type {HTMLSelectElement} */ (document.querySelector("#replay"));
        list.value = "scene";
        list.dispatchEvent(new Event("change"));
      });
      await live.until(() => window.stiction.state?.replay);
      for (const place of PLACES) {
        await page.evaluate((part) => {
          const scrubber = /** @type {HTMLInputElement} */ (document.querySelector("#scrubber"));
          scrubber.value = String(1000 * part);
          scrubber.dispatchEvent(new Event("input"));
          scrubber.dispatchEvent(new Event("change"));
        }, place);
        await live.until((part) => {
          const { state, frame } = window.stiction;
          return state?.replay && Math.abs((frame?.position ?? 0) / state.replay.seconds - part) < 0.08;
        }, place);
        await live.drawn();
        const seen = await look(live);
        faults.push(...seen.faults.map((fault) => `${scene}, ${place}: ${fault}`));
        worst = Math.max(worst, seen.worst);
        count += seen.count;
        contacts += seen.contacts;
        if (scene === "hook" && seen.contacts === 3) {
          crook.contacts += 3;
          crook.values += seen.normals;
        }
      }
    }
    assert.deepEqual(faults, [], `${faults.length} faults, ${worst.toFixed(0)} px at most`);
    // Some values have no room, but in a drawing of the usual size those of a block that is held from two sides have.
    assert.ok(count > contacts, `${count} texts at ${contacts} contacts`);
    if (viewport.width !== 1440) assert.ok(crook.contacts > 0 && crook.values === crook.contacts, `${crook.values} values of N at ${crook.contacts} contacts of the hook`);
  }, []);
}
