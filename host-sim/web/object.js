// The body, its ghost, the hand, and the two springs between them.

import { linesThrough } from "./labels.js";
import { colors } from "./theme.js";

/** Size of the hand's ring and of the coil (px). */
export const HAND_RADIUS = 9;
/** How far the marks of its angle reach beyond that, ahead and back (px). */
const AHEAD = 10;
const BACK = 4;
const COIL_RADIUS = 5.5;
const COIL_TURNS = 8;
/** Radii between which the spiral winds (px). */
const OUTER = 25;
const INNER = 16;

/**
 * Traces the body at a pose. A point is a disc, a rod a thick line.
 * @param {Ink} ctx @param {View} view @param {Vec[]} body @param {Pose} pose
 */
function traceBody(ctx, view, body, pose) {
  const c = Math.cos(pose[2]), s = Math.sin(pose[2]);
  ctx.beginPath();
  if (body.length === 1) {
    const [x, y] = body[0];
    ctx.arc(view.px(pose[0] + c * x - s * y), view.py(pose[1] + s * x + c * y), 7, 0, 2 * Math.PI);
    return;
  }
  for (const [x, y] of body) ctx.lineTo(view.px(pose[0] + c * x - s * y), view.py(pose[1] + s * x + c * y));
  ctx.closePath();
}

/**
 * Returns the lines of the body's outline at a pose.
 * @param {View} view @param {Vec[]} body @param {Pose} pose
 */
export function linesOfBody(view, body, [x, y, theta]) {
  const c = Math.cos(theta), s = Math.sin(theta);
  const corners = body.map(([a, b]) => /** @type {Vec} */ ([view.px(x + c * a - s * b), view.py(y + s * a + c * b)]));
  return linesThrough([...corners, corners[0]], body.length > 2 ? 1.5 : 4);
}

/**
 * Returns the lines of the hand and of the springs that hold the body at a point.
 * @param {View} view @param {Pose} hand @param {Vec | null} holding
 */
export function linesOfHand(view, hand, holding) {
  const x = view.px(hand[0]), y = view.py(hand[1]);
  const c = Math.cos(hand[2]), s = -Math.sin(hand[2]);
  const at = (/** @type {number} */ r) => /** @type {Vec} */ ([x + r * c, y + r * s]);
  const own = [...linesThrough([[x, y], [x, y]], HAND_RADIUS), ...linesThrough([at(-HAND_RADIUS - BACK), at(HAND_RADIUS + AHEAD)], 1.1)];
  if (!holding) return own;
  const [hx, hy] = [view.px(holding[0]), view.py(holding[1])];
  return [...own, ...linesThrough([[hx, hy], [x, y]], HAND_RADIUS), ...linesThrough([[hx, hy], [hx, hy]], OUTER)];
}

/**
 * Draws the body, with a cross at its origin whose longer arm is its x axis.
 * @param {Ink} ctx @param {View} view @param {Vec[]} body @param {Pose} pose
 */
export function drawBody(ctx, view, body, pose) {
  traceBody(ctx, view, body, pose);
  ctx.lineJoin = "round";
  ctx.fillStyle = body.length === 1 ? colors.body : colors["body-fill"];
  ctx.fill();
  ctx.strokeStyle = colors.body;
  ctx.lineWidth = body.length === 2 ? 6 : 2.5;
  ctx.stroke();
  if (body.length === 1) return;
  const x = view.px(pose[0]), y = view.py(pose[1]);
  const c = Math.cos(pose[2]), s = -Math.sin(pose[2]);
  ctx.beginPath();
  ctx.moveTo(x - 5 * c, y - 5 * s);
  ctx.lineTo(x + 13 * c, y + 13 * s);
  ctx.moveTo(x + 5 * s, y - 5 * c);
  ctx.lineTo(x - 5 * s, y + 5 * c);
  ctx.lineWidth = 1.5;
  ctx.strokeStyle = body.length === 2 ? colors.paper : colors.body;
  ctx.stroke();
}

/**
 * Draws the pose the body would have if nothing blocked it.
 * @param {Ink} ctx @param {View} view @param {Vec[]} body @param {Pose} ghost
 */
export function drawGhost(ctx, view, body, ghost) {
  traceBody(ctx, view, body, ghost);
  ctx.setLineDash([5, 4]);
  ctx.strokeStyle = colors.ghost;
  ctx.lineWidth = 1.5;
  ctx.stroke();
  ctx.setLineDash([]);
}

/**
 * Draws the translational spring: a coil from the holding point to the hand.
 * @param {Ink} ctx @param {View} view @param {Vec} holding @param {Pose} hand
 */
export function drawCoil(ctx, view, holding, hand) {
  const x0 = view.px(holding[0]), y0 = view.py(holding[1]);
  const x1 = view.px(hand[0]), y1 = view.py(hand[1]);
  const length = Math.hypot(x1 - x0, y1 - y0);
  if (length < 3) return;
  const ux = (x1 - x0) / length, uy = (y1 - y0) / length;
  const radius = Math.min(COIL_RADIUS, 0.25 * length + 1);
  const lead = Math.min(8, 0.12 * length);
  const coil = length - 2 * lead;
  ctx.beginPath();
  ctx.moveTo(x0, y0);
  const steps = COIL_TURNS * 12;
  for (let i = 0; i <= steps; i++) {
    const angle = (2 * Math.PI * COIL_TURNS * i) / steps;
    const loop = Math.min(0.45 * radius, coil / COIL_TURNS);
    const along = lead + (coil * i) / steps + loop * (Math.cos(angle) - 1) * Math.min(1, i / 12, (steps - i) / 12);
    const aside = radius * Math.sin(angle);
    ctx.lineTo(x0 + along * ux - aside * uy, y0 + along * uy + aside * ux);
  }
  ctx.lineTo(x1, y1);
  ctx.strokeStyle = colors.spring;
  ctx.lineWidth = 1.7;
  ctx.stroke();
}

/**
 * Draws the rotational spring: a spiral about the holding point that winds up with the twist. It begins with a stroke in the
 * body's direction and ends with a dot in that of the hand.
 * @param {Ink} ctx @param {View} view @param {Vec} holding @param {number} theta @param {number} twist
 */
export function drawSpiral(ctx, view, holding, theta, twist) {
  const x = view.px(holding[0]), y = view.py(holding[1]);
  const begin = theta + Math.PI / 2;
  const turns = 2 * Math.PI + twist;
  const steps = Math.min(400, 40 + Math.ceil(12 * Math.abs(twist)));
  ctx.beginPath();
  ctx.moveTo(x + (OUTER + 5) * Math.cos(begin), y - (OUTER + 5) * Math.sin(begin));
  for (let i = 0; i <= steps; i++) {
    const angle = begin + (turns * i) / steps;
    const r = OUTER + ((INNER - OUTER) * i) / steps;
    ctx.lineTo(x + r * Math.cos(angle), y - r * Math.sin(angle));
  }
  ctx.strokeStyle = colors.spring;
  ctx.lineWidth = 1.4;
  ctx.stroke();
  ctx.beginPath();
  ctx.arc(x + INNER * Math.cos(begin + turns), y - INNER * Math.sin(begin + turns), 2.6, 0, 2 * Math.PI);
  ctx.fillStyle = colors.spring;
  ctx.fill();
}

/**
 * Draws a dot with a border of a width (px).
 * @param {Ink} ctx @param {number} x @param {number} y @param {number} radius
 * @param {string} fill @param {string} border @param {number} width
 */
export function drawDot(ctx, x, y, radius, fill, border, width) {
  ctx.beginPath();
  ctx.arc(x, y, radius, 0, 2 * Math.PI);
  ctx.fillStyle = fill;
  ctx.fill();
  ctx.strokeStyle = border;
  ctx.lineWidth = width;
  ctx.stroke();
}

/** Draws the holding point: a ring on the body. @param {Ink} ctx @param {View} view @param {Vec} holding */
export function drawHolding(ctx, view, holding) {
  drawDot(ctx, view.px(holding[0]), view.py(holding[1]), 3.5, colors.paper, colors.spring, 2);
}

/**
 * Draws the hand: a ring with a handle in its direction; closed while it holds, otherwise open and dashed.
 * @param {Ink} ctx @param {View} view @param {Pose} hand @param {boolean} holds
 */
export function drawHand(ctx, view, hand, holds) {
  const x = view.px(hand[0]), y = view.py(hand[1]);
  const c = Math.cos(hand[2]), s = -Math.sin(hand[2]);
  ctx.strokeStyle = colors.hand;
  ctx.lineWidth = 2.2;
  if (!holds) ctx.setLineDash([4, 4]);
  ctx.beginPath();
  ctx.arc(x, y, HAND_RADIUS, 0, 2 * Math.PI);
  ctx.stroke();
  ctx.setLineDash([]);
  ctx.beginPath();
  ctx.moveTo(x + HAND_RADIUS * c, y + HAND_RADIUS * s);
  ctx.lineTo(x + (HAND_RADIUS + AHEAD) * c, y + (HAND_RADIUS + AHEAD) * s);
  ctx.moveTo(x - HAND_RADIUS * c, y - HAND_RADIUS * s);
  ctx.lineTo(x - (HAND_RADIUS + BACK) * c, y - (HAND_RADIUS + BACK) * s);
  ctx.stroke();
  ctx.beginPath();
  ctx.arc(x, y, holds ? 3 : 1.5, 0, 2 * Math.PI);
  ctx.fillStyle = colors.hand;
  ctx.fill();
}
