// Contacts: friction cones with the reaction in them, and bars of N along the normal and of T along the tangent.

import { digits } from "./dom.js";
import { boxOf, label, linesThrough } from "./labels.js";
import { drawDot } from "./object.js";
import { colors } from "./theme.js";
import { step125 } from "./ground.js";

/** Length of the bar of the largest recent force, and width of a bar (px). */
const LONGEST = 110;
const WIDTH = 7;
/** Half the width of the head of the reaction's arrow (px). */
const HEAD = 4.5;
/** Length of the cones' sides (px). */
const CONE = 92;
/** Size of the arrows of a slide, and their distance below the contact (px). */
const CHEVRON = 6;
const BELOW = 14;
/** Fraction by which the largest force decays per drawing. */
const FORGET = 0.003;

/** The scale of the bars: the largest recent force fits, in steps of 1, 2, 5, with hysteresis. */
export class ForceScale {
  constructor() {
    this.greatest = 0;
    /** Pixels per N; 0 before the first force. */
    this.perNewton = 0;
  }

  /** Takes the forces of a frame. @param {Contact[]} contacts */
  take(contacts) {
    let greatest = 0;
    for (const { normal, friction } of contacts) greatest = Math.max(greatest, normal, Math.abs(friction));
    // Without forces, a different scale would not show anything better.
    if (greatest === 0) return;
    this.greatest = Math.max(greatest, (1 - FORGET) * this.greatest);
    const now = this.greatest * this.perNewton;
    if (now > LONGEST || now < 0.3 * LONGEST) this.perNewton = step125(LONGEST / this.greatest);
  }

  /** Clears the forces of the previous scene. */
  reset() {
    this.greatest = 0;
    this.perNewton = 0;
  }
}

/** Returns the unit tangent and normal of a surface in pixels. @param {Facing} surface */
const frameOf = ({ normal }) => ({ tx: normal[1], ty: normal[0], nx: normal[0], ny: -normal[1] });

/**
 * Draws the two cones of a contact: static with a dashed border, dynamic within it with a dotted one.
 * @param {Ink} ctx @param {View} view @param {Contact} contact @param {Facing} surface
 * @param {SceneParameters} parameters @param {string | null} taken the kind that the pointer is at
 */
export function drawCones(ctx, view, contact, surface, parameters, taken) {
  const x = view.px(contact.point[0]), y = view.py(contact.point[1]);
  for (const kind of /** @type {const} */ (["static", "dynamic"])) {
    const [one, other] = coneEnds(view, contact, surface, surface[kind] ?? parameters[kind]);
    ctx.beginPath();
    ctx.moveTo(one.x, one.y);
    ctx.lineTo(x, y);
    ctx.lineTo(other.x, other.y);
    ctx.fillStyle = colors[`cone-${kind}`];
    ctx.fill();
    ctx.setLineDash(kind === "static" ? [6, 3] : [1.8, 2.6]);
    ctx.strokeStyle = colors[`limit-${kind}`];
    ctx.lineWidth = 1.3;
    ctx.stroke();
    ctx.setLineDash([]);
    for (const end of [one, other]) {
      drawDot(ctx, end.x, end.y, DOT, colors[kind === taken ? "accent" : "paper"], colors[`limit-${kind}`], 1.3);
    }
  }
}

/** Radius of the dots at the ends of a cone's sides (px): whoever drags one changes the friction. */
const DOT = 3.5;

/**
 * Returns the ends of a cone's sides (px).
 * @param {View} view @param {Contact} contact @param {Facing} surface @param {number} mu @returns {Spot[]}
 */
function coneEnds(view, contact, surface, mu) {
  const { tx, ty, nx, ny } = frameOf(surface);
  const x = view.px(contact.point[0]), y = view.py(contact.point[1]);
  const size = CONE / Math.hypot(1, mu);
  return [1, -1].map((side) => ({ x: x + size * (nx + side * mu * tx), y: y + size * (ny + side * mu * ty) }));
}

/**
 * Returns the kind of friction whose cone has the end of a side at a position, or null.
 * @param {View} view @param {Contact} contact @param {Facing} surface @param {SceneParameters} parameters @param {Spot} at
 * @param {number} slack px @returns {"static" | "dynamic" | null}
 */
export function coneAt(view, contact, surface, parameters, at, slack) {
  const isAt = (/** @type {"static" | "dynamic"} */ kind) => coneEnds(view, contact, surface, surface[kind] ?? parameters[kind])
    .some(({ x, y }) => Math.hypot(x - at.x, y - at.y) <= DOT + slack);
  return isAt("static") ? "static" : isAt("dynamic") ? "dynamic" : null;
}

/**
 * Returns the friction whose cone passes through a position, at most `most`.
 * @param {View} view @param {Vec} point of the contact @param {Facing} surface @param {Spot} at @param {number} most
 */
export function frictionAt(view, point, surface, at, most) {
  const { tx, ty, nx, ny } = frameOf(surface);
  const dx = at.x - view.px(point[0]), dy = at.y - view.py(point[1]);
  const [along, up] = [Math.abs(dx * tx + dy * ty), dx * nx + dy * ny];
  return up > along / most ? Math.round((100 * along) / up) / 100 : most;
}

/**
 * Draws the bars of a contact, the reaction as their sum, and the contact point.
 * @param {Ink} ctx @param {View} view @param {Contact} contact @param {Facing} surface @param {number} perNewton
 */
export function drawContact(ctx, view, contact, surface, perNewton) {
  const { tx, ty, nx, ny } = frameOf(surface);
  const x = view.px(contact.point[0]), y = view.py(contact.point[1]);
  const n = contact.normal * perNewton, t = contact.friction * perNewton;
  drawBar(ctx, x, y, nx * n, ny * n, colors.normal, false);
  drawBar(ctx, x, y, tx * t, ty * t, colors.friction, true);
  drawArrow(ctx, x, y, nx * n + tx * t, ny * n + ty * t);
  drawDot(ctx, x, y, 4.5, colors.reaction, colors.paper, 1.5);
}

/**
 * Marks a contact that slides with the hand: a double arrow under it, within the surface.
 * @param {Ink} ctx @param {View} view @param {Contact} contact @param {Facing} surface
 */
export function drawSliding(ctx, view, contact, surface) {
  if (!contact.sliding) return;
  const { tx, ty, nx, ny } = frameOf(surface);
  const x = view.px(contact.point[0]) - BELOW * nx, y = view.py(contact.point[1]) - BELOW * ny;
  const [ux, uy] = [contact.sliding * tx, contact.sliding * ty];
  ctx.beginPath();
  for (const at of [-CHEVRON, CHEVRON / 2]) {
    const back = at - CHEVRON;
    ctx.moveTo(x + back * ux + CHEVRON * nx, y + back * uy + CHEVRON * ny);
    ctx.lineTo(x + at * ux, y + at * uy);
    ctx.lineTo(x + back * ux - CHEVRON * nx, y + back * uy - CHEVRON * ny);
  }
  ctx.lineJoin = "round";
  ctx.strokeStyle = colors.paper;
  ctx.lineWidth = 6;
  ctx.stroke();
  ctx.strokeStyle = colors.slip;
  ctx.lineWidth = 2.6;
  ctx.stroke();
}

/**
 * Returns the lines of a contact: the sides of its cones, its bars and its reaction.
 * @param {View} view @param {Contact} contact @param {Facing} surface @param {SceneParameters} parameters
 * @param {number} perNewton @returns {import("./labels.js").Line[]}
 */
export function linesOfContact(view, contact, surface, parameters, perNewton) {
  const { tx, ty, nx, ny } = frameOf(surface);
  const x = view.px(contact.point[0]), y = view.py(contact.point[1]);
  const n = contact.normal * perNewton, t = contact.friction * perNewton;
  const bar = (/** @type {number} */ dx, /** @type {number} */ dy, /** @type {number} */ half) =>
    linesThrough([[x, y], [x + dx, y + dy]], half);
  const sides = /** @type {const} */ (["static", "dynamic"]).flatMap((kind) =>
    coneEnds(view, contact, surface, surface[kind] ?? parameters[kind])
      .flatMap((end) => [...linesThrough([[x, y], [end.x, end.y]], 1), ...linesThrough([[end.x, end.y], [end.x, end.y]], DOT)]));
  return [...sides, ...bar(n * nx, n * ny, WIDTH / 2 + 1), ...bar(t * tx, t * ty, WIDTH / 2 + 1),
    // The reaction is as wide as its head.
    ...bar(n * nx + t * tx, n * ny + t * ty, HEAD), ...bar(0, 0, 5),
    ...contact.sliding ? linesThrough([[x, y], [x - BELOW * nx, y - BELOW * ny]], 2 * CHEVRON + 2) : []];
}

/**
 * Writes the values of a contact's bars next to their ends; omits bars that are absent or outside the window.
 * @param {Ink} ctx @param {View} view @param {Contact} contact @param {Facing} surface @param {number} perNewton
 * @param {import("./labels.js").Taken} taken
 */
export function labelContact(ctx, view, contact, surface, perNewton, taken) {
  const { tx, ty, nx, ny } = frameOf(surface);
  const x = view.px(contact.point[0]), y = view.py(contact.point[1]);
  if (contact.normal === 0 || x < 0 || y < 0 || x > view.width || y > view.height) return;
  const n = contact.normal * perNewton, t = contact.friction * perNewton;
  const side = contact.friction > 0 ? -1 : 1;
  const away = 14;
  const [right, down] = [nx * n + side * away * tx, ny * n + side * away * ty];
  const key = `${contact.vertex} ${surface.name} ${contact.corner}`;
  const ofN = { text: `N ${digits(contact.normal)}`, key: `N ${key}`, x: x + right, y: y + down };
  label(ctx, { ...ofN, named: boxOf(x, y, x + n * nx, y + n * ny) }, side * tx, colors.normal, taken);
  if (Math.abs(t) < 1) return;
  const sense = Math.sign(t);
  const along = t + 8 * sense;
  // Behind the border and its hatching.
  const ofT = { text: `T ${digits(contact.friction)}`, key: `T ${key}`, x: x + along * tx - 26 * nx, y: y + along * ty - 26 * ny };
  label(ctx, { ...ofT, named: boxOf(x, y, x + t * tx, y + t * ty) }, sense * tx, colors.friction, taken);
}

/**
 * Draws a bar from a point; that of T is hollow with strokes across, to differ from N without its colour.
 * @param {Ink} ctx @param {number} x @param {number} y @param {number} dx @param {number} dy @param {string} color
 * @param {boolean} hollow
 */
function drawBar(ctx, x, y, dx, dy, color, hollow) {
  const length = Math.hypot(dx, dy);
  if (length < 0.5) return;
  const wx = (-dy / length) * (WIDTH / 2), wy = (dx / length) * (WIDTH / 2);
  ctx.beginPath();
  ctx.moveTo(x + wx, y + wy);
  ctx.lineTo(x + dx + wx, y + dy + wy);
  ctx.lineTo(x + dx - wx, y + dy - wy);
  ctx.lineTo(x - wx, y - wy);
  ctx.closePath();
  ctx.fillStyle = hollow ? colors.paper : color;
  ctx.fill();
  if (hollow) {
    for (let s = 5; s < length; s += 5) {
      ctx.moveTo(x + (dx * s) / length + wx, y + (dy * s) / length + wy);
      ctx.lineTo(x + (dx * s) / length - wx, y + (dy * s) / length - wy);
    }
  }
  ctx.strokeStyle = color;
  ctx.lineWidth = 1.6;
  ctx.stroke();
}

/**
 * Draws the reaction: an arrow.
 * @param {Ink} ctx @param {number} x @param {number} y @param {number} dx @param {number} dy
 */
function drawArrow(ctx, x, y, dx, dy) {
  const length = Math.hypot(dx, dy);
  if (length < 2) return;
  const ux = dx / length, uy = dy / length;
  const head = Math.min(10, length);
  ctx.beginPath();
  ctx.moveTo(x, y);
  ctx.lineTo(x + dx - head * ux, y + dy - head * uy);
  ctx.strokeStyle = colors.reaction;
  ctx.lineWidth = 2.4;
  ctx.stroke();
  ctx.beginPath();
  ctx.moveTo(x + dx, y + dy);
  ctx.lineTo(x + dx - head * ux - HEAD * uy, y + dy - head * uy + HEAD * ux);
  ctx.lineTo(x + dx - head * ux + HEAD * uy, y + dy - head * uy - HEAD * ux);
  ctx.closePath();
  ctx.fillStyle = colors.reaction;
  ctx.fill();
}
