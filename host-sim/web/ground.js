// The fixed parts: grid, surfaces with hatching, and scales of length and force.

import { prefixed } from "./dom.js";
import { LINE, covers, linesThrough } from "./labels.js";
import { colors } from "./theme.js";

/** Spacing of the hatching and its depth (px). */
const HATCH_SPACING = 11;
const HATCH_DEPTH = 12;
/** Distance of other texts from the ends of a name (px). */
const ENDS = 4;

/** Returns the largest of 1, 2, 5 times a power of ten not above a value. @param {number} value */
export function step125(value) {
  const power = 10 ** Math.floor(Math.log10(value));
  const lead = value / power;
  return (lead >= 5 ? 5 : lead >= 2 ? 2 : 1) * power;
}

/** Draws graph paper: lines at round numbers of metres, at least 36 px apart. @param {Ink} ctx @param {View} view */
export function drawGrid(ctx, view) {
  let step = step125(36 / view.scale);
  if (step * view.scale < 30) step *= 2;
  const [left, top] = view.world(0, 0);
  const [right, bottom] = view.world(view.width, view.height);
  ctx.beginPath();
  for (let x = Math.ceil(left / step) * step; x <= right; x += step) {
    const px = Math.round(view.px(x)) + 0.5;
    ctx.moveTo(px, 0);
    ctx.lineTo(px, view.height);
  }
  for (let y = Math.ceil(bottom / step) * step; y <= top; y += step) {
    const py = Math.round(view.py(y)) + 0.5;
    ctx.moveTo(0, py);
    ctx.lineTo(view.width, py);
  }
  ctx.strokeStyle = colors.grid;
  ctx.lineWidth = 1;
  ctx.stroke();
}

/**
 * Draws every surface: its solid side tinted, its border with hatching, its name.
 * @param {Ink} ctx @param {View} view @param {Surface[]} surfaces
 * @param {import("./labels.js").Label[]} labels existing labels
 */
export function drawSurfaces(ctx, view, surfaces, labels) {
  for (const surface of surfaces) fillSolid(ctx, view, surface);
  for (const surface of surfaces) {
    drawBorder(ctx, view, surface, surfaces);
    nameSurface(ctx, view, surface, surfaces, labels);
  }
}

/**
 * Returns the foot of the window's middle on a surface, in pixels, and the half length that crosses the window.
 * @param {View} view @param {Surface} surface
 */
function foot(view, { normal, offset }) {
  const gap = normal[0] * view.x + normal[1] * view.y - offset;
  const px = view.px(view.x - gap * normal[0]), py = view.py(view.y - gap * normal[1]);
  return { px, py, tx: normal[1], ty: normal[0], nx: normal[0], ny: -normal[1], reach: view.width + view.height };
}

/** @param {Ink} ctx @param {View} view @param {Surface} surface */
function fillSolid(ctx, view, surface) {
  const { px, py, tx, ty, nx, ny, reach } = foot(view, surface);
  ctx.beginPath();
  ctx.moveTo(px - reach * tx, py - reach * ty);
  ctx.lineTo(px + reach * tx, py + reach * ty);
  ctx.lineTo(px + reach * (tx - 2 * nx), py + reach * (ty - 2 * ny));
  ctx.lineTo(px - reach * (tx + 2 * nx), py - reach * (ty + 2 * ny));
  ctx.closePath();
  ctx.fillStyle = colors.solid;
  ctx.fill();
}

/**
 * Returns true if a pixel is on the solid side of another surface.
 * @param {View} view @param {number} px @param {number} py @param {Surface} surface @param {Surface[]} surfaces
 */
function buried(view, px, py, surface, surfaces) {
  const [x, y] = view.world(px, py);
  return surfaces.some((other) => other !== surface
    && other.normal[0] * x + other.normal[1] * y - other.offset < -1e-9);
}

/**
 * Draws the border line and the strokes behind it, which are fixed to the surface.
 * @param {Ink} ctx @param {View} view @param {Surface} surface @param {Surface[]} surfaces
 */
function drawBorder(ctx, view, surface, surfaces) {
  const { px, py, tx, ty, nx, ny, reach } = foot(view, surface);
  const along = (view.x * surface.normal[1] - view.y * surface.normal[0]) * view.scale;
  const first = Math.ceil((along - reach) / HATCH_SPACING) * HATCH_SPACING - along;
  let open = false;
  ctx.beginPath();
  const hatch = new Path2D();
  for (let s = first; s <= reach; s += HATCH_SPACING) {
    const x = px + s * tx, y = py + s * ty;
    const outside = x < -20 || y < -20 || x > view.width + 20 || y > view.height + 20;
    if (outside || buried(view, x, y, surface, surfaces)) {
      open = false;
      continue;
    }
    if (open) ctx.lineTo(x, y);
    else ctx.moveTo(x - 0.5 * HATCH_SPACING * tx, y - 0.5 * HATCH_SPACING * ty), ctx.lineTo(x, y);
    ctx.lineTo(x + 0.5 * HATCH_SPACING * tx, y + 0.5 * HATCH_SPACING * ty);
    open = true;
    hatch.moveTo(x, y);
    hatch.lineTo(x - HATCH_DEPTH * (nx + 0.8 * tx), y - HATCH_DEPTH * (ny + 0.8 * ty));
  }
  ctx.strokeStyle = colors.ink;
  ctx.lineWidth = 2;
  ctx.stroke();
  ctx.strokeStyle = colors.hatch;
  ctx.lineWidth = 1;
  ctx.stroke(hatch);
}

/**
 * Writes the surface's name behind its border, as near the window's edge as no other text and no button is.
 * @param {Ink} ctx @param {View} view @param {Surface} surface @param {Surface[]} surfaces
 * @param {import("./labels.js").Label[]} labels
 */
function nameSurface(ctx, view, surface, surfaces, labels) {
  const { px, py, tx, ty, nx, ny, reach } = foot(view, surface);
  const length = ctx.measureText(surface.name).width;
  // Other texts keep their distance from its sides, not from the ends of a name that runs upwards.
  const [width, height] = [length * Math.abs(tx) + LINE * Math.abs(ty), (length + 2 * ENDS) * Math.abs(ty) + LINE * Math.abs(tx)];
  for (let s = reach; s > -reach; s -= 12) {
    const x = px + s * tx - 27 * nx, y = py + s * ty - 27 * ny;
    const inside = x > 60 && x < view.width - 60 && y > view.top + 24 && y < view.height - 24;
    const box = { left: x - width / 2, top: y - height / 2, width, height };
    if (!inside || buried(view, x, y, surface, surfaces) || labels.some((other) => covers(other, box))) continue;
    ctx.save();
    ctx.translate(x, y);
    let angle = Math.atan2(ty, tx);
    if (Math.abs(angle) > Math.PI / 2 + 1e-6) angle += Math.PI;
    ctx.rotate(angle);
    ctx.fillStyle = colors.muted;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.fillText(surface.name, 0, 0);
    ctx.restore();
    labels.push(box);
    return;
  }
}

/** Returns the lines of the surfaces: their borders with the hatching behind them. @param {View} view @param {Surface[]} surfaces */
export const linesOfSurfaces = (view, surfaces) => surfaces.flatMap((surface) => {
  const { px, py, tx, ty, nx, ny, reach } = foot(view, surface);
  /** Returns a line in the direction of the border. @param {number} below px @param {number} half */
  const line = (below, half) => {
    const [x, y] = [px - below * nx, py - below * ny];
    return linesThrough([[x - reach * tx, y - reach * ty], [x + reach * tx, y + reach * ty]], half);
  };
  const hatching = line(0.5 * HATCH_DEPTH, 0.5 * HATCH_DEPTH + 2);
  return [...line(0, 1), ...hatching.map((wide) => ({ ...wide, isHatching: true }))];
});

/** Formats a round size in a suitable unit. @param {number} size @param {string} unit */
function round(size, unit) {
  const { name, per } = prefixed(size, unit);
  return `${Number((size * per).toPrecision(1))} ${name}`;
}

/**
 * Draws two bars in the lower left corner: a round length, and, once there were forces, a round force in the scale of the force
 * bars.
 * @param {Ink} ctx @param {View} view @param {number} perNewton pixels per N
 */
export function drawScales(ctx, view, perNewton) {
  const length = step125(110 / view.scale);
  drawScale(ctx, view, 16, length * view.scale, round(length, "m"));
  if (perNewton === 0) return;
  const force = step125(80 / perNewton);
  drawScale(ctx, view, 34 + length * view.scale, force * perNewton, round(force, "N"));
}

/** @param {Ink} ctx @param {View} view @param {number} x @param {number} width @param {string} text */
function drawScale(ctx, view, x, width, text) {
  const y = view.height - 16;
  ctx.fillStyle = colors.paper;
  ctx.globalAlpha = 0.8;
  ctx.fillRect(x - 6, y - 20, width + 12, 30);
  ctx.globalAlpha = 1;
  ctx.beginPath();
  ctx.moveTo(x, y - 4);
  ctx.lineTo(x, y + 4);
  ctx.moveTo(x, y);
  ctx.lineTo(x + width, y);
  ctx.moveTo(x + width, y - 4);
  ctx.lineTo(x + width, y + 4);
  ctx.strokeStyle = colors.ink;
  ctx.lineWidth = 1.5;
  ctx.stroke();
  ctx.fillStyle = colors.ink;
  ctx.textAlign = "center";
  ctx.textBaseline = "alphabetic";
  ctx.fillText(text, x + width / 2, y - 7);
}
