// Texts in the drawing that do not overlap.

import { colors } from "./theme.js";

/** Height of a line of text (px). */
export const LINE = 14;
/** Rows of pixels at the bottom reserved for the scales, and distance of a text from the window's border (px). */
const SCALES = 40;
const MARGIN = 4;

/**
 * The box of a text, or of buttons of the page over the drawing (px).
 * @typedef {{left: number, top: number, width: number, height: number, buttons?: true}} Label
 */

/**
 * Writes a text with a halo of paper, to the right or left of a position and to the left of buttons; moves it up or down by the
 * least distance that avoids other texts, within the window.
 * @param {Ink} ctx @param {{text: string, x: number, y: number}} place @param {number} toward
 * @param {string} color @param {Label[]} labels existing labels
 */
export function label(ctx, { text, x, y }, toward, color, labels) {
  const { width } = ctx.measureText(text);
  const { canvas } = ctx;
  const { a: ratio } = ctx.getTransform();
  const [right, bottom] = [canvas.width / ratio - MARGIN - width, canvas.height / ratio - SCALES - LINE];
  const wanted = toward > 0.5 ? x : toward < -0.5 ? x - width : x - width / 2;
  const box = { left: Math.min(right, wanted), top: y - LINE / 2, width, height: LINE };
  const buttons = labels.find((other) => other.buttons && covers(other, box));
  const left = Math.max(MARGIN, buttons ? buttons.left - MARGIN - width : box.left);
  const top = freeRow(labels, { ...box, left }, bottom);
  labels.push({ left, top, width, height: LINE });
  ctx.textAlign = "left";
  ctx.textBaseline = "middle";
  ctx.lineJoin = "round";
  ctx.lineWidth = 4;
  ctx.strokeStyle = colors.paper;
  ctx.strokeText(text, left, top + LINE / 2);
  ctx.fillStyle = color;
  ctx.fillText(text, left, top + LINE / 2);
}

/**
 * Returns the top nearest to that of a box at which it covers no label and is in the window.
 * @param {Label[]} labels @param {Label} box @param {number} bottom
 */
function freeRow(labels, box, bottom) {
  const inside = Math.max(MARGIN, Math.min(bottom, box.top));
  // A label can be passed above or below; one of these rows is free.
  const rows = labels.flatMap(({ top, height }) => [top - box.height, top + height]);
  const free = [inside, ...rows].filter((top) => top >= MARGIN && top <= bottom
    && !labels.some((other) => covers(other, { ...box, top })));
  return free.length === 0 ? inside
    : free.reduce((best, top) => (Math.abs(top - inside) < Math.abs(best - inside) ? top : best));
}

/** Returns true if two labels overlap. @param {Label} a @param {Label} b */
export const covers = (a, b) => a.left < b.left + b.width && b.left < a.left + a.width
  && a.top < b.top + b.height && b.top < a.top + a.height;
