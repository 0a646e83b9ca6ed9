// The window on the scene: converts between metres and pixels. It fits the scene, follows what would leave it, and is zoomed
// and moved by the reader.

import { reducedMotion } from "./dom.js";

/** Margin around the fitted objects, relative to the window. */
const ROOM = 0.09;
/** Least distance of followed objects from the border, relative to the window. */
const BORDER = 0.07;
/** Least room at the left and right (px), also in a narrow window: half the width of a friction cone of 0.6. */
const CONE = 48;
/** Distance within which corners of obstacles are fitted, and within which an obstacle is fitted as a whole, in sizes of the body. */
const NEAR = 4;
const WHOLE = 8;
/** Fraction of its displacement that the window makes in one drawing. */
const EASE = 0.2;
/** Limits of the reader's zoom, relative to the fitting scale. */
const LEAST_ZOOM = 0.2;
const MOST_ZOOM = 40;

export class View {
  constructor() {
    /** Size in CSS pixels. */
    this.width = 300;
    this.height = 150;
    /** World point in the middle (m). */
    this.x = 0;
    this.y = 0;
    /** Pixels per metre. */
    this.scale = 2000;
    /** The scale that fits the scene. */
    this.fitting = 2000;
    /** Pixels at the top that are covered by text. */
    this.top = 0;
  }

  /** Returns the pixel column of a world x. @param {number} x */
  px(x) {
    return this.width / 2 + (x - this.x) * this.scale;
  }

  /** Returns the pixel row of a world y. @param {number} y */
  py(y) {
    return (this.height + this.top) / 2 - (y - this.y) * this.scale;
  }

  /** Returns the world point of a pixel. @param {number} px @param {number} py @returns {Vec} */
  world(px, py) {
    return [this.x + (px - this.width / 2) / this.scale, this.y + ((this.height + this.top) / 2 - py) / this.scale];
  }

  /**
   * Fits the scene: the body at its start, the hand's start, and the surfaces and obstacles near them.
   * @param {Scene} scene @param {Pose} pose @param {Pose} hand
   */
  fit(scene, pose, hand) {
    const size = bodySize(scene);
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    const take = (/** @type {number} */ x, /** @type {number} */ y, /** @type {number} */ r) => {
      box[0] = Math.min(box[0], x - r);
      box[1] = Math.min(box[1], y - r);
      box[2] = Math.max(box[2], x + r);
      box[3] = Math.max(box[3], y + r);
    };
    for (const at of [pose, scene.start]) take(at[0], at[1], 1.05 * size);
    for (const at of [hand, scene.home]) take(at[0], at[1], 0.15 * size);
    for (const { normal, offset } of scene.surfaces) {
      const gap = normal[0] * pose[0] + normal[1] * pose[1] - offset;
      if (Math.abs(gap) < 6 * size) take(pose[0] - gap * normal[0], pose[1] - gap * normal[1], 0.35 * size);
    }
    for (const { vertices } of scene.obstacles ?? []) {
      const distances = vertices.map(([x, y]) => Math.hypot(x - pose[0], y - pose[1]) / size);
      const isWhole = Math.max(...distances) < WHOLE;
      vertices.forEach(([x, y], k) => { if (isWhole || distances[k] < NEAR) take(x, y, 0.1 * size); });
    }
    for (const { normal, offset } of scene.surfaces) clip(box, normal, offset, 0.4 * size);
    this.x = (box[0] + box[2]) / 2;
    this.y = (box[1] + box[3]) / 2;
    const across = inside(this.width, ROOM) / (box[2] - box[0]);
    const up = (1 - 2 * ROOM) * (this.height - this.top) / (box[3] - box[1]);
    this.scale = Math.max(1, Math.min(across, up));
    this.fitting = this.scale;
  }

  /**
   * Follows body and hand: moves, and if they are too far apart zooms out as far as necessary. Returns true while it moves.
   * @param {Scene} scene @param {Pose} pose @param {Pose} hand
   */
  follow(scene, pose, hand) {
    const r = Math.min(bodySize(scene), 0.4 * Math.min(this.width, this.height - this.top) / this.scale);
    const left = Math.min(pose[0] - r, hand[0]), right = Math.max(pose[0] + r, hand[0]);
    const low = Math.min(pose[1] - r, hand[1]), high = Math.max(pose[1] + r, hand[1]);
    const [wide, tall] = [inside(this.width, BORDER), (1 - 2 * BORDER) * (this.height - this.top)];
    const ease = reducedMotion() ? 1 : EASE;
    const scale = Math.min(this.scale, wide / (right - left), tall / (high - low));
    const zoom = scale < 0.999 * this.scale;
    if (zoom) this.scale += ease * (scale - this.scale);
    const [half, rise] = [wide / 2 / this.scale, tall / 2 / this.scale];
    const dx = over(left - (this.x - half), right - (this.x + half));
    const dy = over(low - (this.y - rise), high - (this.y + rise));
    this.x += ease * dx;
    this.y += ease * dy;
    return zoom || Math.hypot(dx, dy) * this.scale > 0.5;
  }

  /** Returns true if the window shows some part of the body. @param {Vec[]} body @param {Pose} pose */
  shows(body, [x, y, theta]) {
    const c = Math.cos(theta), s = Math.sin(theta);
    const columns = body.map(([a, b]) => this.px(x + c * a - s * b));
    const rows = body.map(([a, b]) => this.py(y + s * a + c * b));
    return Math.max(...columns) >= 0 && Math.min(...columns) <= this.width
      && Math.max(...rows) >= 0 && Math.min(...rows) <= this.height;
  }

  /** Zooms about a pixel. @param {number} factor @param {number} px @param {number} py */
  zoom(factor, px = this.width / 2, py = (this.height + this.top) / 2) {
    const scale = Math.min(MOST_ZOOM * this.fitting, Math.max(LEAST_ZOOM * this.fitting, factor * this.scale));
    const [x, y] = this.world(px, py);
    this.scale = scale;
    const [nowX, nowY] = this.world(px, py);
    this.x += x - nowX;
    this.y += y - nowY;
  }

  /** Moves with a pointer. @param {number} dx pixels @param {number} dy pixels */
  pan(dx, dy) {
    this.x -= dx / this.scale;
    this.y += dy / this.scale;
  }
}

/** Returns the width between the rooms at the left and right (px). @param {number} width @param {number} room relative to it */
const inside = (width, room) => width - 2 * Math.max(room * width, Math.min(CONE, width / 4));

/**
 * Clips from a box what lies deeper than a depth behind a surface along x or y.
 * @param {number[]} box @param {Vec} normal @param {number} offset @param {number} depth
 */
function clip(box, normal, offset, depth) {
  if (normal[0] > 0.99) box[0] = Math.max(box[0], offset - depth);
  if (normal[0] < -0.99) box[2] = Math.min(box[2], depth - offset);
  if (normal[1] > 0.99) box[1] = Math.max(box[1], offset - depth);
  if (normal[1] < -0.99) box[3] = Math.min(box[3], depth - offset);
}

/**
 * Returns the distance by which a range leaves another one: below (negative), above, or 0.
 * @param {number} below @param {number} above
 */
const over = (below, above) => (below < 0 && above > 0 ? (below + above) / 2 : Math.min(below, 0) + Math.max(above, 0));

/** Returns the largest distance of a vertex from the body's origin; for a point, a length for drawing (m). @param {Scene} scene */
export function bodySize(scene) {
  const size = Math.max(...scene.body.map(([x, y]) => Math.hypot(x, y)));
  return size > 0 ? size : 0.04;
}
