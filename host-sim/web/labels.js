// Texts in the drawing that touch neither one another nor a line, next to what they name.

import { colors } from "./theme.js";

/** Height of a line of text (px). */
export const LINE = 14;
/** Rows of pixels at the bottom reserved for the scales, and distance of a text from the window's border (px). */
const SCALES = 40;
const MARGIN = 4;
/** Largest distance of a text from what it names (px), which a large screen magnifies; and where there is no room so near, as it is seen. */
const FARTHEST = 26;
const AT_MOST = 38;
/** Spacing of the places that are tried, and their largest distance from the wanted one (px). */
const STEP = 5;
const REACH = 110;
/** Least distance of two texts in a row (px): more than a space, so that they are not read as one. */
const APART = 8;
/** Least distance of a text from a line (px). */
const CLEAR = 2;

/**
 * The box of a text, of buttons of the page over the drawing, or of something that is named (px).
 * @typedef {{left: number, top: number, width: number, height: number}} Label
 */
/**
 * A straight line of the drawing, with half its width (px). A text without other room is written over a hatching.
 * @typedef {{x1: number, y1: number, x2: number, y2: number, half: number, isHatching?: boolean}} Line
 */
/** What texts keep clear of: other texts and buttons, and lines. @typedef {{labels: Label[], lines: Line[]}} Taken */

/** Offsets of the places that are tried, the nearest first. @type {Vec[]} */
const OFFSETS = [];
for (let dx = -REACH; dx <= REACH; dx += STEP) {
  for (let dy = -REACH; dy <= REACH; dy += STEP) if (Math.hypot(dx, dy) <= REACH) OFFSETS.push([dx, dy]);
}
OFFSETS.sort((a, b) => Math.hypot(...a) - Math.hypot(...b));

/** The offset of each text in the previous drawing: a text stays there while it can. @type {Map<string, Vec>} */
const previous = new Map();

/**
 * Writes a text with a halo of paper, to the right or left of a position, or as near to it as there is room. A text without room
 * near what it names is left out.
 * @param {Ink} ctx
 * @param {{text: string, key: string, x: number, y: number, named: Label, isElsewhere?: (px: number, py: number) => boolean}} place
 *   the key is that of the previous drawing; at a place that is elsewhere it would name something else
 * @param {number} toward @param {string} color @param {Taken} taken
 */
export function label(ctx, { text, key, x, y, named, isElsewhere }, toward, color, taken) {
  const { width } = ctx.measureText(text);
  const { canvas } = ctx;
  const { a: ratio } = ctx.getTransform();
  const [right, bottom] = [canvas.width / ratio - MARGIN - width, canvas.height / ratio - SCALES - LINE];
  const left = toward > 0.5 ? x : toward < -0.5 ? x - width : x - width / 2;
  const at = (/** @type {Vec} */ [dx, dy]) => ({ left: left + dx, top: y - LINE / 2 + dy, width, height: LINE });
  /** Returns the nearest free place. @param {number} farthest @param {Line[]} lines */
  const free = (farthest, lines) => {
    const isFree = (/** @type {Vec} */ offset) => {
      const box = at(offset), wide = { ...box, left: box.left - APART, width: width + 2 * APART };
      return box.left >= MARGIN && box.left <= right && box.top >= MARGIN && box.top <= bottom && between(box, named) <= farthest
        && !taken.labels.some((other) => covers(other, wide)) && !lines.some((line) => crosses(line, box))
        && !isElsewhere?.(box.left + width / 2, box.top + LINE / 2);
    };
    const before = previous.get(key);
    return before && isFree(before) ? before : OFFSETS.find(isFree);
  };
  const offset = free(FARTHEST, taken.lines)
    ?? free(AT_MOST * devicePixelRatio / ratio, taken.lines.filter(({ isHatching }) => !isHatching));
  if (!offset) {
    previous.delete(key);
    return;
  }
  previous.set(key, offset);
  const box = at(offset);
  taken.labels.push(box);
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  ctx.lineJoin = "round";
  ctx.lineWidth = 4;
  ctx.strokeStyle = colors.paper;
  ctx.strokeText(text, box.left, box.top + LINE / 2);
  ctx.fillStyle = color;
  ctx.fillText(text, box.left, box.top + LINE / 2);
}

/** Returns the box between two corners. @param {number} x1 @param {number} y1 @param {number} x2 @param {number} y2 */
export const boxOf = (x1, y1, x2 = x1, y2 = y1) =>
  ({ left: Math.min(x1, x2), top: Math.min(y1, y2), width: Math.abs(x2 - x1), height: Math.abs(y2 - y1) });

/** Returns the lines between points (px). @param {Vec[]} points @param {number} half @returns {Line[]} */
export const linesThrough = (points, half) =>
  points.slice(1).map(([x2, y2], k) => ({ x1: points[k][0], y1: points[k][1], x2, y2, half }));

/** Returns true if two labels overlap. @param {Label} a @param {Label} b */
export const covers = (a, b) => a.left < b.left + b.width && b.left < a.left + a.width
  && a.top < b.top + b.height && b.top < a.top + a.height;

/** Returns the distance between two boxes. @param {Label} a @param {Label} b */
const between = (a, b) => Math.hypot(
  Math.max(0, b.left - a.left - a.width, a.left - b.left - b.width),
  Math.max(0, b.top - a.top - a.height, a.top - b.top - b.height),
);

/** Returns true if a line touches a box: some part of it is within the box, enlarged by its half width. @param {Line} line @param {Label} box */
function crosses({ x1, y1, x2, y2, half }, { left, top, width, height }) {
  const room = half + CLEAR;
  let from = 0, to = 1;
  for (const [begin, change, low, high] of [
    [x1, x2 - x1, left - room, left + width + room], [y1, y2 - y1, top - room, top + height + room],
  ]) {
    if (change === 0) {
      if (begin < low || begin > high) return false;
      continue;
    }
    const ends = [(low - begin) / change, (high - begin) / change];
    from = Math.max(from, Math.min(...ends));
    to = Math.min(to, Math.max(...ends));
  }
  return from <= to;
}
