// The diagram of contact states: the four of the paper and two more. The current one is highlighted, transitions flash and are
// counted.

import { reducedMotion, setText, svg, whole } from "./dom.js";

/**
 * Position of a state, and a small picture of it: surfaces and body as SVG paths in a box of 36 by 24.
 * @typedef {{x: number, y: number, ground: string, body: string, dots: Vec[]}} Place
 */
const STATES = /** @type {Record<StateName, Place>} */ ({
  "non-contact": { x: 54, y: 34, ground: "M3 22H33", body: "M9 10 24 5 27 12 12 17Z", dots: [] },
  "corner": { x: 306, y: 34, ground: "M5 2V22H33", body: "M5 22 10 8 25 4 20 18Z", dots: [[5, 22]] },
  "single-vertex": { x: 180, y: 124, ground: "M3 22H33", body: "M13 22 6 8 20 3 27 17Z", dots: [[13, 22]] },
  "edge": { x: 54, y: 214, ground: "M3 22H33", body: "M8 22V10H28V22Z", dots: [[8, 22], [28, 22]] },
  "two-vertex": { x: 306, y: 214, ground: "M5 2V22H33", body: "M5 12 18 3 28 9 15 22Z", dots: [[5, 12], [15, 22]] },
  "locked": { x: 180, y: 258, ground: "M7 2V22H33", body: "M7 22V9H27V22Z", dots: [[7, 9], [7, 22], [27, 22]] },
});

/** The two that are not in the paper. */
const BEYOND = ["corner", "locked"];
/** Half the size of a state's box. */
const HALF_WIDTH = 49;
const HALF_HEIGHT = 27;
/** Half the distance between the lanes of the two directions. */
const GAP = 5;
/** Transitions drawn from the beginning; others are added when they happen. @type {[StateName, StateName][]} */
const LINKS = [
  ["non-contact", "single-vertex"], ["non-contact", "edge"], ["single-vertex", "edge"], ["single-vertex", "two-vertex"],
  ["single-vertex", "corner"], ["two-vertex", "locked"], ["edge", "locked"],
];
/** Paths around the box in the middle: start, control point and end. @type {{[pair: string]: string[]}} */
const DETOURS = {
  "non-contact>two-vertex": ["106 38", "280 52", "296 184"], "two-vertex>non-contact": ["286 184", "270 62", "106 48"],
  "corner>edge": ["254 38", "80 52", "64 184"], "edge>corner": ["74 184", "90 62", "254 48"],
};
/** Duration of a flash, and least time between two of them (ms). */
const FLASH = 450;

/** One direction of a link. @typedef {{path: SVGElement, label: SVGElement, count: number, flashed: number}} Lane */

export class Diagram {
  /** @param {HTMLElement} parent */
  constructor(parent) {
    this.links = svg("g", { class: "links" });
    this.labels = svg("g", { class: "counts" });
    const box = { viewBox: "0 0 8 8", refX: 7, refY: 4, markerWidth: 6, markerHeight: 6, orient: "auto" };
    const head = svg("marker", { id: "head", ...box }, svg("path", { d: "M0 0 8 4 0 8Z", class: "head" }));
    this.root = svg("svg", { viewBox: "0 0 360 290", role: "img", "aria-label": "Contact states" },
      svg("defs", {}, head), this.links);
    /** @type {Map<string, SVGElement>} */
    this.nodes = new Map(Object.entries(STATES).map(([name, state]) => [name, node(name, state)]));
    this.root.append(...this.nodes.values(), this.labels);
    /** @type {Map<string, Lane>} */
    this.lanes = new Map();
    for (const [from, to] of LINKS) {
      this.lane(from, to);
      this.lane(to, from);
    }
    /** @type {string} */
    this.current = "";
    parent.append(this.root);
  }

  /** Returns the lane of a transition; adds a missing one. @param {string} from @param {string} to */
  lane(from, to) {
    const key = `${from}>${to}`;
    const known = this.lanes.get(key);
    if (known) return known;
    const { d, x, y, anchor } = route(from, to);
    const path = svg("path", { d, class: "link", "marker-end": "url(#head)" });
    const label = svg("text", { x, y, "text-anchor": anchor, "data-pair": key });
    const meaning = `from ${from} to ${to}: ticks that ended in the one after a tick that ended in the other; what comes and `
      + "goes within a tick is among the events alone";
    this.links.append(path);
    this.labels.append(svg("g", {}, svg("title", {}, meaning), label));
    /** @type {Lane} */
    const lane = { path, label, count: 0, flashed: -Infinity };
    this.lanes.set(key, lane);
    return lane;
  }

  /** Shows a frame's state and the transitions so far. @param {FrameMessage} message */
  show({ frame, counts }) {
    if (frame.state !== this.current) {
      this.nodes.get(this.current)?.classList.remove("now");
      this.nodes.get(frame.state)?.classList.add("now");
      this.current = frame.state;
      this.root.setAttribute("aria-label", `Contact states; now ${frame.state}`);
    }
    for (const key in counts.transitions) this.count(key, counts.transitions[key]);
    for (const [key, lane] of this.lanes) if (lane.count > 0 && !(key in counts.transitions)) this.set(lane, 0);
  }

  /** Sets the count of one transition. @param {string} key @param {number} count */
  count(key, count) {
    const [from, to] = key.split(">");
    if (!(from in STATES) || !(to in STATES) || from === to) return;
    const lane = this.lane(from, to);
    if (count === lane.count) return;
    if (count > lane.count) flash(lane);
    this.set(lane, count);
  }

  /** @param {Lane} lane @param {number} count */
  set(lane, count) {
    lane.count = count;
    setText(lane.label, count === 0 ? "" : whole(count));
    lane.path.classList.toggle("used", count > 0);
  }
}

/** Returns a state's box. @param {string} name @param {Place} state */
function node(name, { x, y, ground, body, dots }) {
  const picture = svg("g", { transform: `translate(${x - 18} ${y - 24})`, class: "picture" },
    svg("path", { d: body, class: "shape" }), svg("path", { d: ground, class: "ground" }),
    ...dots.map(([cx, cy]) => svg("circle", { cx, cy, r: 2.2 })));
  const [width, height] = [2 * HALF_WIDTH, 2 * HALF_HEIGHT];
  const box = svg("rect", { x: x - HALF_WIDTH, y: y - HALF_HEIGHT, width, height, rx: 9 });
  return svg("g", { class: BEYOND.includes(name) ? "node beyond" : "node" }, box, picture,
    svg("text", { x, y: y + 19, "text-anchor": "middle" }, name));
}

/**
 * Returns the path of a transition: a line parallel to that of the other direction, from border to border, and the position of
 * its count.
 * @param {string} from @param {string} to
 */
function route(from, to) {
  const detour = DETOURS[`${from}>${to}`];
  if (detour) {
    const [begin, bend, end] = detour;
    const [x, y] = begin.split(" ").map(Number);
    const aside = x < 180 ? 22 : -22;
    return { d: `M${begin}Q${bend} ${end}`, x: x + aside, y: to > from ? y - 4 : y + 14, anchor: "middle" };
  }
  const a = STATES[/** @type {StateName} */ (from)], b = STATES[/** @type {StateName} */ (to)];
  const length = Math.hypot(b.x - a.x, b.y - a.y);
  const ux = (b.x - a.x) / length, uy = (b.y - a.y) / length;
  const ox = -uy * GAP, oy = ux * GAP;
  const start = leave(ux, uy, ox, oy), end = length - leave(-ux, -uy, ox, oy);
  const x0 = a.x + start * ux + ox, y0 = a.y + start * uy + oy;
  const x1 = a.x + end * ux + ox, y1 = a.y + end * uy + oy;
  const x = (x0 + x1) / 2 + 1.6 * ox, y = (y0 + y1) / 2 + 2.2 * oy + 4;
  const anchor = ox > 1 ? "start" : ox < -1 ? "end" : "middle";
  const d = `M${x0.toFixed(1)} ${y0.toFixed(1)}L${x1.toFixed(1)} ${y1.toFixed(1)}`;
  return { d, x: x.toFixed(1), y: y.toFixed(1), anchor };
}

/**
 * Returns the distance from the middle of a box to its border, along a line offset from the middle.
 * @param {number} ux @param {number} uy @param {number} ox @param {number} oy
 */
function leave(ux, uy, ox, oy) {
  const across = (HALF_WIDTH + 3 - ox * Math.sign(ux)) / Math.abs(ux || 1e-9);
  return Math.min(across, (HALF_HEIGHT + 3 - oy * Math.sign(uy)) / Math.abs(uy || 1e-9));
}

/** Highlights a lane for a moment. @param {Lane} lane */
function flash(lane) {
  const now = performance.now();
  if (now - lane.flashed < FLASH) return;
  lane.flashed = now;
  if (reducedMotion()) {
    lane.path.classList.add("lit");
    setTimeout(() => lane.path.classList.remove("lit"), FLASH);
    return;
  }
  lane.path.animate([{ stroke: "var(--accent)", strokeWidth: "5px" }, {}], { duration: FLASH, easing: "ease-out" });
}
