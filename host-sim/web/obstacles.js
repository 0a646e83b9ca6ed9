// Obstacles: convex polygons, thin walls and pins. Draws their inside, their free sides with hatching, their names, and the
// corners that touch the object.

import { boxOf, label, linesThrough } from "./labels.js";
import { colors } from "./theme.js";

/** Spacing and depth of the hatching, as of surfaces; width of a wall; radii of pins and of rings at corners (px). */
const SPACING = 11;
const DEPTH = 12;
const WALL = 4;
const PIN = 4;
const RING = 9;
/** Offset outwards from a side, relative to its length. */
const OUTSIDE = 1e-6;

/**
 * A part of a side: its ends (m) and its unit normal.
 * @typedef {{from: Vec, to: Vec, normal: Vec}} Piece
 */

/** Returns the outward unit normal of a side. @param {Vec} a @param {Vec} b @returns {Vec} */
function outward(a, b) {
  const length = Math.hypot(b[0] - a[0], b[1] - a[1]);
  return [(b[1] - a[1]) / length, (a[0] - b[0]) / length];
}

/** Returns the sides of a polygon, as pairs of corners. @param {Vec[]} corners @returns {[Vec, Vec][]} */
const sides = (corners) => corners.map((corner, k) => [corner, corners[(k + 1) % corners.length]]);

/** The pieces of each obstacle, computed once per list. @type {WeakMap<Obstacle[], Piece[][]>} */
const known = new WeakMap();

/**
 * Returns the pieces of polygons' sides that are not inside or against something else.
 * @param {Obstacle[]} obstacles @param {Surface[]} surfaces
 */
function freePieces(obstacles, surfaces) {
  let pieces = known.get(obstacles);
  if (!pieces) {
    pieces = obstacles.map((own) => (own.vertices.length < 3 ? [] : sides(own.vertices)
      .flatMap((side) => freeParts(side, obstacles.filter((other) => other !== own), surfaces))));
    known.set(obstacles, pieces);
  }
  return pieces;
}

/** @param {[Vec, Vec]} side @param {Obstacle[]} others @param {Surface[]} surfaces @returns {Piece[]} */
function freeParts([a, b], others, surfaces) {
  const normal = outward(a, b);
  const off = OUTSIDE * Math.hypot(b[0] - a[0], b[1] - a[1]);
  /** Returns the distances of both ends beyond a line. @param {Vec} n @param {number} offset */
  const beyond = (n, offset) => [a, b]
    .map(([x, y]) => n[0] * (x + off * normal[0]) + n[1] * (y + off * normal[1]) - offset);
  const solids = surfaces.map((surface) => [beyond(surface.normal, surface.offset)]);
  for (const { vertices } of others) {
    if (vertices.length < 3) continue;
    solids.push(sides(vertices).map(([c, d]) => {
      const n = outward(c, d);
      return beyond(n, n[0] * c[0] + n[1] * c[1]);
    }));
  }
  const hidden = solids.map(within).filter(([from, to]) => from < to).sort((one, other) => one[0] - other[0]);
  /** @param {number} part @returns {Vec} */
  const at = (part) => [a[0] + part * (b[0] - a[0]), a[1] + part * (b[1] - a[1])];
  /** @type {Piece[]} */
  const pieces = [];
  let begin = 0;
  for (const [from, to] of [...hidden, [1, 1]]) {
    if (from > begin) pieces.push({ from: at(begin), to: at(from), normal });
    begin = Math.max(begin, to);
  }
  return pieces;
}

/**
 * Returns the range in which all of these are negative; they are affine along a side.
 * @param {number[][]} heights @returns {Vec}
 */
function within(heights) {
  let from = 0, to = 1;
  for (const [low, high] of heights) {
    const zero = low / (low - high);
    if (low >= 0) from = high >= 0 ? 1 : Math.max(from, zero);
    else if (high >= 0) to = Math.min(to, zero);
  }
  return [from, to];
}

/** Draws all obstacles. @param {Ink} ctx @param {View} view @param {Scene} scene */
export function drawObstacles(ctx, view, { obstacles, surfaces }) {
  if (!obstacles?.length) return;
  for (const { vertices } of obstacles) drawInside(ctx, view, vertices);
  freePieces(obstacles, surfaces).forEach((pieces, k) => drawSides(ctx, view, obstacles[k].vertices, pieces));
}

/**
 * Returns the hatching of a side as one wide line. @param {Vec} a px @param {Vec} b px @param {Vec} normal
 * @returns {import("./labels.js").Line[]}
 */
const hatchingOf = (a, b, [nx, ny]) => {
  const inward = (/** @type {Vec} */ [x, y]) => /** @type {Vec} */ ([x - 0.5 * DEPTH * nx, y + 0.5 * DEPTH * ny]);
  return linesThrough([inward(a), inward(b)], 0.5 * DEPTH + 1).map((line) => ({ ...line, isHatching: true }));
};

/**
 * Returns the lines of the obstacles: their sides with the hatching behind them.
 * @param {View} view @param {Obstacle[]} obstacles @returns {import("./labels.js").Line[]}
 */
export const linesOfObstacles = (view, obstacles) => obstacles.flatMap(({ vertices }) => {
  const isSolid = vertices.length > 2;
  return sides(vertices).flatMap(([a, b]) => {
    const at = (/** @type {Vec} */ [x, y]) => /** @type {Vec} */ ([view.px(x), view.py(y)]);
    const side = linesThrough([at(a), at(b)], isSolid ? 1 : PIN);
    return isSolid ? [...side, ...hatchingOf(at(a), at(b), outward(a, b))] : side;
  });
});

/**
 * Writes the names of the obstacles.
 * @param {Ink} ctx @param {View} view @param {Obstacle[]} obstacles @param {import("./labels.js").Taken} taken
 */
export function nameObstacles(ctx, view, obstacles, taken) {
  for (const obstacle of obstacles) drawName(ctx, view, obstacle, taken, obstacles.filter((other) => other !== obstacle));
}

/** @param {Ink} ctx @param {View} view @param {Vec[]} corners */
function trace(ctx, view, corners) {
  ctx.beginPath();
  for (const [x, y] of corners) ctx.lineTo(view.px(x), view.py(y));
  ctx.closePath();
}

/** @param {Ink} ctx @param {View} view @param {Vec[]} corners */
function drawInside(ctx, view, corners) {
  ctx.fillStyle = corners.length > 2 ? colors.solid : colors.ink;
  if (corners.length === 1) {
    ctx.beginPath();
    ctx.arc(view.px(corners[0][0]), view.py(corners[0][1]), PIN, 0, 2 * Math.PI);
  } else {
    trace(ctx, view, corners);
  }
  ctx.fill();
  // Hides the seam between two obstacles.
  ctx.strokeStyle = ctx.fillStyle;
  ctx.lineWidth = corners.length === 2 ? WALL : 1;
  ctx.stroke();
}

/** @param {Ink} ctx @param {View} view @param {Vec[]} corners @param {Piece[]} pieces */
function drawSides(ctx, view, corners, pieces) {
  const hatch = new Path2D();
  for (const { from, to, normal } of pieces) {
    const x = view.px(from[0]), y = view.py(from[1]);
    const length = Math.hypot(view.px(to[0]) - x, view.py(to[1]) - y);
    const nx = normal[0], ny = -normal[1];
    const [tx, ty] = [ny, -nx];
    for (let s = SPACING / 2; s < length; s += SPACING) {
      const [px, py] = [x + s * tx, y + s * ty];
      if (px < -20 || py < -20 || px > view.width + 20 || py > view.height + 20) continue;
      hatch.moveTo(px, py);
      hatch.lineTo(px - DEPTH * (nx + 0.8 * tx), py - DEPTH * (ny + 0.8 * ty));
    }
  }
  ctx.save();
  trace(ctx, view, corners);
  ctx.clip();
  ctx.strokeStyle = colors.hatch;
  ctx.lineWidth = 1;
  ctx.stroke(hatch);
  ctx.restore();
  ctx.beginPath();
  for (const { from, to } of pieces) {
    ctx.moveTo(view.px(from[0]), view.py(from[1]));
    ctx.lineTo(view.px(to[0]), view.py(to[1]));
  }
  ctx.strokeStyle = colors.ink;
  ctx.lineWidth = 2;
  ctx.stroke();
}

/** Returns the visible part of a polygon (px). @param {View} view @param {Vec[]} corners @returns {Vec[]} */
function seen(view, corners) {
  let points = corners.map(([x, y]) => /** @type {Vec} */ ([view.px(x), view.py(y)]));
  /** @type {((p: Vec) => number)[]} */
  const inside = [([x]) => x, ([x]) => view.width - x, ([, y]) => y - view.top, ([, y]) => view.height - y];
  for (const height of inside) {
    points = points.flatMap((p, k) => {
      const next = points[(k + 1) % points.length];
      const [low, high] = [height(p), height(next)];
      /** @type {Vec[]} */
      const seen = low >= 0 ? [p] : [];
      const part = low / (low - high);
      if (low * high < 0) seen.push([p[0] + part * (next[0] - p[0]), p[1] + part * (next[1] - p[1])]);
      return seen;
    });
  }
  return points;
}

/** Returns true if a place (px) is inside a polygon. @param {View} view @param {Vec[]} corners @param {number} px @param {number} py */
function isInside(view, corners, px, py) {
  const [x, y] = view.world(px, py);
  return corners.length > 2 && sides(corners).every(([[ax, ay], [bx, by]]) => (bx - ax) * (y - ay) > (by - ay) * (x - ax));
}

/**
 * Writes the name in the middle of the visible part; next to it, and not in another obstacle, if it is too small.
 * @param {Ink} ctx @param {View} view @param {Obstacle} obstacle @param {import("./labels.js").Taken} taken @param {Obstacle[]} others
 */
function drawName(ctx, view, { name, vertices }, taken, others) {
  const points = seen(view, vertices);
  if (points.length === 0) return;
  const [xs, ys] = [0, 1].map((axis) => points.map((p) => p[axis]));
  const [left, right, top, bottom] = [Math.min(...xs), Math.max(...xs), Math.min(...ys), Math.max(...ys)];
  const { width } = ctx.measureText(name);
  const fits = points.length > 2 && right - left > width + 3 * DEPTH && bottom - top > 3 * DEPTH;
  const beside = right + 8 + width < view.width ? right + 8 : left - 8 - width;
  const mean = (/** @type {number[]} */ values) => values.reduce((sum, value) => sum + value, 0) / values.length;
  const [x, y] = fits ? [mean(xs) - width / 2, mean(ys)] : [beside, (top + bottom) / 2];
  // On no line, it is wholly inside or outside.
  const isElsewhere = (/** @type {number} */ px, /** @type {number} */ py) =>
    others.some((other) => isInside(view, other.vertices, px, py));
  label(ctx, { text: name, key: name, x, y, named: boxOf(left, top, right, bottom), isElsewhere }, 1, colors.muted, taken);
}

/** Draws a ring at every corner that touches the object. @param {Ink} ctx @param {View} view @param {Contact[]} contacts */
export function drawCorners(ctx, view, contacts) {
  for (const { corner, point } of contacts) {
    if (corner === undefined) continue;
    const x = view.px(point[0]), y = view.py(point[1]);
    ctx.beginPath();
    ctx.arc(x, y, RING, 0, 2 * Math.PI);
    ctx.strokeStyle = colors.friction;
    ctx.lineWidth = 2;
    ctx.stroke();
  }
}

/**
 * Writes obstacle and number of every corner that touches the object, next to the corner within the obstacle.
 * @param {Ink} ctx @param {View} view @param {Contact[]} contacts
 * @param {import("./labels.js").Taken} taken
 */
export function nameCorners(ctx, view, contacts, taken) {
  for (const { corner, obstacle, point, direction } of contacts) {
    if (corner === undefined || !direction) continue;
    const [nx, ny] = direction;
    const px = view.px(point[0]), py = view.py(point[1]);
    const x = px - (RING + 7) * nx, y = py + (RING + 11) * ny;
    const toward = Math.abs(nx) > 0.2 ? -Math.sign(nx) : 0;
    const text = `${obstacle}, corner ${corner}`;
    label(ctx, { text, key: text, x, y, named: boxOf(px - RING, py - RING, px + RING, py + RING) }, toward, colors.muted, taken);
  }
}
