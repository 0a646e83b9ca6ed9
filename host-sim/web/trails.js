// The trails of hand and object, and the places where the object slipped.

import { colors } from "./theme.js";

/** Points of a trail, and the least distance between two of them (px). */
const POINTS = 600;
const SPACING = 1.5;
/** Number of marked slips. */
const MARKS = 80;
/** Segments of a trail, each fainter and thinner than the next one. */
const PARTS = 5;
/** Opacity of the oldest segment and of the oldest mark: every colour keeps a contrast of 3:1 against its background. */
const FAINTEST = 0.8;
/** Widths of a trail (px). */
const THIN = 0.9;
const THICK = 1.8;
/**
 * Longest step on the screen that is drawn (px): the dots of a longer one, most of them out of sight, would delay the drawing.
 */
const LEAP = 10_000;
/** Length of the newest mark and of the oldest one (px). */
const LONG = 9;
const SHORT = 5;

/** A ring buffer of points. */
class Ring {
  constructor() {
    this.x = new Float64Array(POINTS);
    this.y = new Float64Array(POINTS);
    this.length = 0;
    this.next = 0;
  }

  /**
   * Adds a point if its distance from the last one is large enough.
   * @param {number} x @param {number} y @param {number} spacing
   */
  push(x, y, spacing) {
    const last = (this.next + POINTS - 1) % POINTS;
    if (this.length > 0 && Math.hypot(x - this.x[last], y - this.y[last]) < spacing) return;
    this.x[this.next] = x;
    this.y[this.next] = y;
    this.next = (this.next + 1) % POINTS;
    this.length = Math.min(POINTS, this.length + 1);
  }
}

export class Trails {
  constructor() {
    this.hand = new Ring();
    this.body = new Ring();
    /** The marked slips, oldest first. @type {Slip[]} */
    this.slips = [];
  }

  /** Takes a frame. @param {FrameMessage} message @param {number} scale pixels per metre */
  take(message, scale) {
    const { hand, pose } = message.frame;
    this.hand.push(hand[0], hand[1], SPACING / scale);
    this.body.push(pose[0], pose[1], SPACING / scale);
    const newest = this.slips.at(-1)?.n ?? -1;
    for (const slip of message.slips) if (slip.n > newest) this.slips.push(slip);
    if (this.slips.length > MARKS) this.slips.splice(0, this.slips.length - MARKS);
  }

  /** Clears everything. */
  clear() {
    this.hand = new Ring();
    this.body = new Ring();
    this.slips = [];
  }

  /** Draws the trails: the hand's dotted, the body's solid; the older, the fainter. @param {Ink} ctx @param {View} view */
  draw(ctx, view) {
    ctx.lineJoin = "round";
    ctx.setLineDash([1.5, 4]);
    drawTrail(ctx, view, this.hand, colors["trail-hand"]);
    ctx.setLineDash([]);
    drawTrail(ctx, view, this.body, colors["trail-body"]);
  }

  /**
   * Marks each slip: a small triangle below the surface that points to the place where it ended; the older, the smaller.
   * @param {Ink} ctx @param {View} view
   */
  drawSlips(ctx, view) {
    ctx.fillStyle = colors.slip;
    this.slips.forEach((slip, i) => {
      const nx = slip.direction[0], ny = -slip.direction[1];
      const x = view.px(slip.point[0]) - 4 * nx, y = view.py(slip.point[1]) - 4 * ny;
      const young = (i + 1) / this.slips.length;
      const size = SHORT + (LONG - SHORT) * young;
      ctx.globalAlpha = FAINTEST + (1 - FAINTEST) * young;
      ctx.beginPath();
      ctx.moveTo(x, y);
      ctx.lineTo(x - size * nx + 0.45 * size * ny, y - size * ny - 0.45 * size * nx);
      ctx.lineTo(x - size * nx - 0.45 * size * ny, y - size * ny + 0.45 * size * nx);
      ctx.closePath();
      ctx.fill();
    });
    ctx.globalAlpha = 1;
  }
}

/** @param {Ink} ctx @param {View} view @param {Ring} ring @param {string} color */
function drawTrail(ctx, view, ring, color) {
  ctx.strokeStyle = color;
  const first = (ring.next + POINTS - ring.length) % POINTS;
  for (let part = 0; part < PARTS; part++) {
    const from = Math.floor((part * ring.length) / PARTS);
    const to = Math.min(ring.length - 1, Math.floor(((part + 1) * ring.length) / PARTS));
    if (to <= from) continue;
    const young = part / (PARTS - 1);
    ctx.globalAlpha = FAINTEST + (1 - FAINTEST) * young;
    ctx.lineWidth = THIN + (THICK - THIN) * young;
    ctx.beginPath();
    let [lastX, lastY] = [NaN, NaN];
    for (let i = from; i <= to; i++) {
      const at = (first + i) % POINTS;
      const x = view.px(ring.x[at]), y = view.py(ring.y[at]);
      if (Math.hypot(x - lastX, y - lastY) <= LEAP) ctx.lineTo(x, y);
      else ctx.moveTo(x, y);
      [lastX, lastY] = [x, y];
    }
    ctx.stroke();
  }
  ctx.globalAlpha = 1;
}
