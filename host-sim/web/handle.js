// The handle that turns the hand: a knob on an arm in the direction of the hand. Its position on the screen depends on the
// hand's alone, so that the knob rotates about the hand by the hand's angle.

import { colors } from "./theme.js";

/**
 * Distance from the hand to the knob, and size of the knob (px). The arm is longer than the spiral of the rotational spring.
 */
export const ARM = 56;
const KNOB = 8;

/** Returns the position of the knob. @param {View} view @param {Pose} hand @returns {Spot} */
const knobOf = (view, [x, y, phi]) => ({ x: view.px(x) + ARM * Math.cos(phi), y: view.py(y) - ARM * Math.sin(phi) });

/** Returns true if a press is at the knob. @param {View} view @param {Pose} hand @param {Spot} at @param {number} slack px */
export function isAtKnob(view, hand, at, slack) {
  const { x, y } = knobOf(view, hand);
  return Math.hypot(at.x - x, at.y - y) <= KNOB + slack / 2;
}

/** @param {Ink} ctx @param {View} view @param {Pose} hand @param {boolean} isTaken whether the pointer is at it */
export function drawHandle(ctx, view, hand, isTaken) {
  const { x, y } = knobOf(view, hand);
  const handX = view.px(hand[0]), handY = view.py(hand[1]);
  // From the end of the hand's own stroke to the knob.
  const from = 0.34, to = 1 - KNOB / ARM;
  ctx.beginPath();
  ctx.moveTo(handX + from * (x - handX), handY + from * (y - handY));
  ctx.lineTo(handX + to * (x - handX), handY + to * (y - handY));
  ctx.strokeStyle = colors.hand;
  ctx.lineWidth = 1.4;
  ctx.stroke();
  ctx.beginPath();
  ctx.arc(x, y, KNOB, 0, 2 * Math.PI);
  ctx.fillStyle = isTaken ? colors.accent : colors.paper;
  ctx.fill();
  ctx.lineWidth = 2.2;
  ctx.stroke();
}
