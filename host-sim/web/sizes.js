// The sizes of a scene: its length and its force, the rounding errors relative to them, and the units for its values.

import { prefixed } from "./dom.js";

/**
 * Values below this fraction of the scene's length or force are rounding. f32 and the fixed point of a board round to 2^-24; a
 * reaction is the sum of some ten rounded products, each as large as the scene: 16 * 2^-24 = 1e-6.
 */
export const NOISE = 1e-6;
/** Typical displacement of the hand relative to the object's length; the force is the same fraction of k_h L. */
const PULL = 0.1;
/** Length of a point without rotation (m), as in the solver. */
const LENGTH_OF_POINT = 1;

/**
 * Returns the largest distance between two vertices (m). A point has none: there it is the lever of the springs, from the
 * holding point and sqrt(k_theta / k_h).
 * @param {Scene} scene @param {SceneParameters} parameters
 */
export function lengthOf({ body, grasp }, { stiffness_translation, stiffness_rotation }) {
  let length = 0;
  for (const [x, y] of body) for (const [u, v] of body) length = Math.max(length, Math.hypot(u - x, v - y));
  if (length > 0) return length;
  const [x, y] = body[0] ?? [0, 0];
  const [gx, gy] = grasp ?? [x, y];
  return Math.hypot(gx - x, gy - y, Math.sqrt(stiffness_rotation / stiffness_translation)) || LENGTH_OF_POINT;
}

/**
 * Returns length (m) and force (N) of a frame: k_h L, or the weight or the hand's wrench if one of them is larger.
 * @param {StateMessage} state @param {TraceFrame} frame
 */
function sizesOf({ scene, parameters }, { wrench: [fx, fy, moment] }) {
  const length = lengthOf(scene, parameters);
  const spring = parameters.stiffness_translation * length;
  return { length, force: Math.max(spring, scene.weight, Math.hypot(fx, fy), Math.abs(moment) / length) };
}

/** The original messages, by those without noise. @type {WeakMap<FrameMessage, FrameMessage>} */
const origins = new WeakMap();

/**
 * Returns a frame message in which forces and slips that are rounding are 0 or left out. All forces are drawn and shown from
 * this.
 * @param {FrameMessage} message @param {StateMessage | null} state @returns {FrameMessage}
 */
export function withoutNoise(message, state) {
  if (!state) return message;
  const { frame } = message;
  const { length, force } = sizesOf(state, frame);
  const sift = (/** @type {number} */ value) => (Math.abs(value) < NOISE * force ? 0 : value);
  const twist = (/** @type {number} */ moment) => length * sift(moment / length);
  const [fx, fy, moment] = frame.wrench;
  const contacts = frame.contacts.map((contact) => {
    const [normal, friction] = [sift(contact.normal), sift(contact.friction)];
    // An unloaded contact does not slide.
    return { ...contact, normal, friction, sliding: normal > 0 ? contact.sliding : 0 };
  });
  /** @type {FrameMessage} */
  const clean = {
    ...message,
    frame: { ...frame, contacts, wrench: [sift(fx), sift(fy), twist(moment)] },
    slips: message.slips.filter((slip) => slip.length >= NOISE * length),
    strip: message.strip.map(([t, ...forces]) => [t, ...forces.map(sift)]),
  };
  const { insertion } = frame;
  if (insertion) {
    clean.frame.insertion = { ...insertion, fx: sift(insertion.fx), fz: sift(insertion.fz), m: twist(insertion.m) };
  }
  origins.set(clean, message);
  return clean;
}

/** Returns the original message. @param {FrameMessage | null} message */
export const asItCame = (message) => (message ? origins.get(message) ?? message : null);

/**
 * A unit, and the number of it in one SI unit.
 * @typedef {{name: string, per: number}} Unit
 */

/**
 * Returns the units of lengths, forces and moments in a scene: the same for all its values, so that none changes while it is
 * read.
 * @param {StateMessage} state @returns {{length: Unit, force: Unit, moment: Unit}}
 */
export function unitsOf({ scene, parameters }) {
  const length = lengthOf(scene, parameters);
  const force = PULL * parameters.stiffness_translation * length;
  return { length: prefixed(length, "m"), force: prefixed(force, "N"), moment: prefixed(force * length, "N·m") };
}
