// A peg in its hole, live: the jamming diagram with the current load and its trail, and F_z over depth compared with Whitney's
// formulas for small angles. Loaded by pages whose scene has a peg and a hole.

import { byId, digits, fixed, setText } from "./dom.js";
import { drawDot } from "./object.js";
import { colors, onTheme } from "./theme.js";

/** Number of points of the trail and of the curves. */
const TRAIL = 400;
const CURVE = 1500;
/** Pause between two drawings (ms). */
const PAUSE = 100;
/** Margins for the labels of the axes: left and bottom (px). */
const LEFT = 40;
const BELOW = 32;

/**
 * Two axes on a canvas.
 * @typedef {{ctx: Ink, px: (x: number) => number, py: (y: number) => number, width: number, height: number}} Axes
 */

const PANEL = `
  <h2 id="h-insertion">Peg in its hole <small id="verdict">–</small></h2>
  <canvas id="jamming" class="plot" role="img" aria-label="Jamming diagram"></canvas>
  <p class="keys"><span><i class="key two"></i>two points slide in</span>
    <span><i class="key wall"></i>one wall slides in</span></p>
  <canvas id="force-depth" class="plot" role="img" aria-label="Insertion force over depth"></canvas>
  <p class="keys"><span><i class="key m"></i>Fz</span> <span><i class="key d"></i>small angles: one point</span>
    <span><i class="key both"></i>two points</span></p>
  <dl class="pairs">
    <div><dt>depth</dt><dd id="peg-depth">–</dd></div>
    <div><dt>load Fx, Fz</dt><dd id="peg-load">–</dd></div>
    <div><dt>margin</dt><dd id="peg-margin">–</dd></div>
  </dl>`;

class InsertionPanel {
  /** Loads in the diagram; null: a gap. @type {(Vec | null)[]} */
  trail = [];
  /** l (mm), F_z and the two formulas. @type {{l: number, values: (number | null)[]}[]} */
  curve = [];
  time = -Infinity;
  deepest = 0;
  /** @type {Insertion | null} */
  now = null;
  /** There are data that are not drawn yet. */
  stale = true;
  drawn = 0;

  constructor() {
    this.root = document.createElement("section");
    this.root.id = "insertion";
    this.root.setAttribute("aria-labelledby", "h-insertion");
    this.root.innerHTML = PANEL;
    byId("trade").closest("section")?.before(this.root);
    const style = document.createElement("link");
    style.rel = "stylesheet";
    style.href = "insertion.css";
    document.head.append(style);
    this.jamming = byId("jamming", HTMLCanvasElement);
    this.forces = byId("force-depth", HTMLCanvasElement);
    /** @type {Peg | null} */
    this.peg = null;
    onTheme(() => { this.stale = true; });
  }

  /** Clears everything. */
  clear() {
    this.trail = [];
    this.curve = [];
    this.time = -Infinity;
    this.deepest = 0;
    this.now = null;
    this.stale = true;
  }

  /** Takes a scene with or without a peg. @param {Scene} scene */
  setScene({ peg }) {
    if (JSON.stringify(peg ?? null) !== JSON.stringify(this.peg)) this.clear();
    this.peg = peg ?? null;
    this.root.hidden = this.peg === null;
  }

  /** Takes a frame. @param {FrameMessage} message */
  take({ frame, small_angles: formulas }) {
    if (!this.peg) return;
    if (frame.t < this.time) this.clear();
    if (frame.t === this.time) return;
    this.time = frame.t;
    const now = frame.insertion ?? null;
    if (!now && !this.now) return;
    this.now = now;
    this.stale = true;
    push(this.trail, now && now.margin !== null && now.fz !== 0 ? this.load(now) : null, TRAIL);
    if (!now) return;
    this.deepest = Math.max(this.deepest, now.depth);
    const values = [now.fz, formulas?.one_point ?? null, formulas?.two_points ?? null];
    push(this.curve, { l: 1e3 * now.depth, values }, CURVE);
  }

  /** Returns the position of a load in the diagram. @param {Insertion} insertion @returns {Vec} */
  load({ fx, fz, m }) {
    return [fx / fz, m / ((this.peg?.radius ?? 1) * fz)];
  }

  /** Draws new data, ten times per second. Returns true if it must be called again to show the newest. */
  draw() {
    const { peg, now } = this;
    if (!peg || !this.stale) return false;
    if (performance.now() - this.drawn < PAUSE) return true;
    this.drawn = performance.now();
    this.stale = false;
    this.drawJamming(peg);
    this.drawForces();
    const verdict = byId("verdict");
    setText(verdict, now?.verdict ?? "not in the hole");
    verdict.dataset.bad = String(now?.verdict === "jammed" || now?.verdict === "wedged");
    setText(byId("peg-depth"), now ? `${fixed(1e3 * now.depth, 3)} mm of ${fixed(1e3 * peg.length, 1)} mm` : "–");
    setText(byId("peg-load"), now ? `${digits(now.fx)} N, ${digits(now.fz)} N` : "–");
    setText(byId("peg-margin"), now && now.margin !== null ? digits(now.margin) : "–");
    this.jamming.setAttribute("aria-label", `Jamming diagram; now ${now?.verdict ?? "not in the hole"}`);
    return false;
  }

  /** @param {Peg} peg */
  drawJamming({ friction, radius }) {
    const lambda = this.deepest / (2 * radius * friction);
    const across = friction > 0 ? 1.3 / friction : 1;
    const up = 1.4 * (2 * (Number.isFinite(lambda) ? lambda : 0) + 1);
    const axes = axesOn(this.jamming, [-across, across], [-up, up], ["Fx / Fz", "M / (r Fz)"]);
    if (!axes) return;
    const { px, py } = axes;
    if (this.now && this.now.lambda !== null) {
      const top = 2 * this.now.lambda + 1;
      /** @type {Vec[]} */
      const corners = [[1 / friction, -1], [-1 / friction, top], [-1 / friction, 1], [1 / friction, -top]];
      corners.forEach((corner, side) => {
        const [color, dash] = side % 2 === 0 ? [colors.friction, []] : [colors.slip, [6, 3]];
        line(axes, [corner, corners[(side + 1) % 4]], color, 2, dash);
      });
    }
    line(axes, this.trail, colors["trail-body"], 1.6);
    const last = this.trail.at(-1);
    if (!last) return;
    const x = Math.min(axes.width - 4, Math.max(LEFT + 4, px(last[0])));
    const y = Math.min(axes.height - BELOW - 4, Math.max(6, py(last[1])));
    drawDot(axes.ctx, x, y, 5, colors.body, colors.paper, 1.5);
  }

  drawForces() {
    const forces = this.curve.map(({ values }) => values[0] ?? 0);
    const low = Math.min(0, ...forces), high = Math.max(0, ...forces);
    const room = 0.12 * (high - low) || 1;
    const end = 1.05e3 * this.deepest || 1;
    const axes = axesOn(this.forces, [0, end], [low - room, high + room], ["depth l (mm)", "Fz (N)"]);
    if (!axes) return;
    /** @param {number} k @returns {(Vec | null)[]} */
    const of = (k) => this.curve.map(({ l, values }) => {
      const value = values[k];
      return value === null || value > high + room ? null : [l, value];
    });
    line(axes, [[0, 0], [end, 0]], colors.muted, 1);
    line(axes, of(1), colors["limit-dynamic"], 2, [1.8, 2.6]);
    line(axes, of(2), colors.normal, 2.4, [6, 3]);
    line(axes, of(0), colors.body, 1.8);
  }
}

/** The panel, above that of the trade. */
export const panel = new InsertionPanel();

/** Appends to a list of limited length. @template T @param {T[]} list @param {T} item @param {number} most */
function push(list, item, most) {
  list.push(item);
  if (list.length > most) list.splice(0, list.length - most);
}

/**
 * Clears a canvas and draws two axes with their ends and names; returns null if it is not visible.
 * @param {HTMLCanvasElement} canvas @param {Vec} xs @param {Vec} ys @param {[string, string]} names
 * @returns {Axes | null}
 */
function axesOn(canvas, xs, ys, [xName, yName]) {
  const { clientWidth: width, clientHeight: height } = canvas;
  if (width === 0 || height === 0) return null;
  const ratio = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(height * ratio);
  const ctx = /** @type {Ink} */ (canvas.getContext("2d"));
  ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
  const right = width - 6, bottom = height - BELOW, top = 6;
  const px = (/** @type {number} */ x) => LEFT + ((right - LEFT) * (x - xs[0])) / (xs[1] - xs[0]);
  const py = (/** @type {number} */ y) => bottom - ((bottom - top) * (y - ys[0])) / (ys[1] - ys[0]);
  ctx.font = "12px system-ui, sans-serif";
  ctx.fillStyle = colors.muted;
  ctx.strokeStyle = colors.grid;
  ctx.lineWidth = 1;
  for (const [axis, ticks] of [ticksOf(xs), ticksOf(ys)].entries()) {
    for (const value of ticks) {
      const at = Math.round((axis === 0 ? px : py)(value)) + 0.5;
      ctx.beginPath();
      ctx.moveTo(axis === 0 ? at : LEFT, axis === 0 ? top : at);
      ctx.lineTo(axis === 0 ? at : right, axis === 0 ? bottom : at);
      ctx.stroke();
      ctx.textAlign = axis === 0 ? "center" : "right";
      ctx.textBaseline = axis === 0 ? "top" : "middle";
      const text = String(Number(value.toPrecision(3))).replace("-", "−");
      ctx.fillText(text, axis === 0 ? at : LEFT - 4, axis === 0 ? bottom + 3 : at);
    }
  }
  ctx.textAlign = "right";
  ctx.textBaseline = "alphabetic";
  ctx.fillText(xName, right, height - 3);
  ctx.textAlign = "left";
  ctx.textBaseline = "top";
  ctx.fillText(yName, LEFT + 4, top);
  return { ctx, px, py, width, height };
}

/** Returns about five round values on an axis. @param {Vec} range */
function ticksOf([low, high]) {
  const rough = (high - low) / 5;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = ([1, 2, 5].find((lead) => lead * power >= rough) ?? 10) * power;
  const ticks = [];
  for (let k = Math.ceil(low / step); k * step <= high; k++) ticks.push(k * step);
  return ticks;
}

/**
 * Draws a line through points, interrupted at gaps, clipped to the axes.
 * @param {Axes} axes @param {(Vec | null)[]} points @param {string} color @param {number} width @param {number[]} dash
 */
function line({ ctx, px, py, width: right, height }, points, color, width, dash = []) {
  ctx.save();
  ctx.beginPath();
  ctx.rect(LEFT, 0, right - LEFT, height - BELOW);
  ctx.clip();
  ctx.beginPath();
  let open = false;
  for (const point of points) {
    if (!point) open = false;
    else if (open) ctx.lineTo(px(point[0]), py(point[1]));
    else {
      ctx.moveTo(px(point[0]), py(point[1]));
      open = true;
    }
  }
  ctx.setLineDash(dash);
  ctx.strokeStyle = color;
  ctx.lineWidth = width;
  ctx.stroke();
  ctx.restore();
}
