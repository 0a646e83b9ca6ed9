// The edited scene as plain numbers: converts a state to them, and them to an edit as specified in VIEW.md; and their geometry.
// SI units; the object's corners are in its own frame.

/**
 * @typedef {{name: string, normal: Vec, offset: number, static: number, dynamic: number, memory: number | null}} EditedSurface
 * @typedef {{name: string, vertices: Vec[], static: number, dynamic: number, memory: number | null}} EditedObstacle
 * @typedef {{body: Vec[], start: Pose, weight: number, grasp: Vec | null, reach: number, stiffness: Vec,
 *   surfaces: EditedSurface[], obstacles: EditedObstacle[]}} Model
 */

/** Relative difference below which numbers are equal: the solver's side normalises normals again. */
const ROUNDING = 1e-9;
/** Friction of what is added to a scene without any. */
const FRICTION = { static: 0.5, dynamic: 0.3, memory: null };
/** Directions of surfaces that are added, in this order. @type {[string, Vec][]} */
const DIRECTIONS = [["floor", [0, 1]], ["wall", [-1, 0]], ["wall", [1, 0]], ["ceiling", [0, -1]]];
/** Cosine of the angle above which two surfaces count as having the same direction. */
const SAME_DIRECTION = 0.98;
/** Coarsest rounding of positions set by the page, in sizes of the object. */
const FINENESS = 1e-3;
/** Distance of an added item from the object, in sizes of the object. */
const APART = 1.6;

/** Returns the scene of a state. @param {StateMessage} state @returns {Model} */
export function modelOf({ scene, parameters }) {
  const friction = (/** @type {any} */ { static: s, dynamic, memory }) => ({ static: s, dynamic, memory: memory ?? null });
  return structuredClone({
    body: scene.body,
    start: scene.start,
    weight: scene.weight,
    grasp: scene.grasp,
    reach: scene.reach,
    stiffness: [parameters.stiffness_translation, parameters.stiffness_rotation],
    surfaces: scene.surfaces.map(({ name, normal, offset, ...rest }) => ({ name, normal, offset, ...friction(rest) })),
    obstacles: (scene.obstacles ?? []).map(({ name, vertices, ...rest }) => ({ name, vertices, ...friction(rest) })),
  });
}

/** Returns the body of `POST /edit`. @param {Model} model */
export function editOf({ body, start, weight, grasp, reach, stiffness, surfaces, obstacles }) {
  return JSON.stringify({
    body: { vertices: body, start, weight },
    grasp: { point: grasp, reach },
    spring: { translation: stiffness[0], rotation: stiffness[1] },
    surface: surfaces,
    obstacle: obstacles,
  });
}

/** Returns true if two values are equal up to rounding. @param {any} a @param {any} b @returns {boolean} */
export function same(a, b) {
  if (typeof a === "number" && typeof b === "number") {
    return Math.abs(a - b) <= ROUNDING * Math.max(1, Math.abs(a), Math.abs(b));
  }
  if (a === null || b === null || typeof a !== "object" || typeof b !== "object") return a === b;
  const keys = Object.keys(a);
  return keys.length === Object.keys(b).length && keys.every((key) => same(a[key], b[key]));
}

/** Transforms a point of the object to the world. @param {Model} model @param {Vec} point @returns {Vec} */
export function toWorld({ start: [x, y, theta] }, [u, v]) {
  const c = Math.cos(theta), s = Math.sin(theta);
  return [x + c * u - s * v, y + s * u + c * v];
}

/** Transforms a point of the world to the object's frame. @param {Model} model @param {Vec} point @returns {Vec} */
export function toBody({ start: [x, y, theta] }, [px, py]) {
  const c = Math.cos(theta), s = Math.sin(theta);
  return [c * (px - x) + s * (py - y), c * (py - y) - s * (px - x)];
}

/**
 * Returns the largest distance of a corner from the object's origin; for a point, a length for drawing (m).
 * @param {Model} model
 */
export const sizeOf = ({ body }) => Math.max(...body.map(([x, y]) => Math.hypot(x, y))) || 0.04;

/** Returns twice the area of a triangle, positive if it is counter-clockwise. @param {Vec} a @param {Vec} b @param {Vec} c */
const turn = (a, b, c) => (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);

/** Returns the convex hull, counter-clockwise; for collinear points, its ends. @param {Vec[]} points @returns {Vec[]} */
export function hull(points) {
  const sorted = [...points].sort((a, b) => a[0] - b[0] || a[1] - b[1])
    .filter((point, k, all) => k === 0 || point[0] !== all[k - 1][0] || point[1] !== all[k - 1][1]);
  if (sorted.length < 3) return sorted;
  const half = (/** @type {Vec[]} */ row) => {
    /** @type {Vec[]} */
    const chain = [];
    for (const point of row) {
      while (chain.length > 1 && turn(chain[chain.length - 2], chain[chain.length - 1], point) <= 0) chain.pop();
      chain.push(point);
    }
    return chain.slice(0, -1);
  };
  return [...half(sorted), ...half(sorted.reverse())];
}

/** Returns the centroid of a convex polygon, of a rod or of a point. @param {Vec[]} corners @returns {Vec} */
export function centroid(corners) {
  let area = 0, x = 0, y = 0;
  const [first] = corners;
  for (let k = 2; k < corners.length; k++) {
    const [a, b] = [corners[k - 1], corners[k]];
    const part = turn(first, a, b);
    area += part;
    x += part * (first[0] + a[0] + b[0]) / 3;
    y += part * (first[1] + a[1] + b[1]) / 3;
  }
  if (area !== 0) return [x / area, y / area];
  const mean = (/** @type {0 | 1} */ axis) => corners.reduce((sum, corner) => sum + corner[axis], 0) / corners.length;
  return [mean(0), mean(1)];
}

/**
 * Adds a corner on side `k` at a point of the same frame, slightly outside: a corner on the line would not count.
 * @param {Vec[]} corners @param {number} k @param {Vec} point @returns {Vec[]}
 */
export function withCorner(corners, k, point) {
  const [a, b] = [corners[k], corners[(k + 1) % corners.length]];
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const along = Math.min(0.9, Math.max(0.1, ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / (dx * dx + dy * dy)));
  const out = corners.length > 2 ? 0.04 : 0.3;
  /** @type {Vec} */
  const corner = [digits(a[0] + along * dx + out * dy), digits(a[1] + along * dy - out * dx)];
  return [...corners.slice(0, k + 1), corner, ...corners.slice(k + 1)];
}

/**
 * Replaces the object by a polygon drawn in the world: its origin is the centroid.
 * @param {Model} model @param {Vec[]} corners
 */
export function withBody(model, corners) {
  const [u, v] = centroid(corners);
  const size = Math.max(...corners.map(([px, py]) => Math.hypot(px - u, py - v))) || sizeOf(model);
  const [x, y] = [round(u, FINENESS * size), round(v, FINENESS * size)];
  model.body = corners.map(([px, py]) => [digits(px - x), digits(py - y)]);
  model.start = [x, y, 0];
  if (model.grasp) model.grasp = [0, 0];
}

/**
 * Returns the shortest displacement that brings the object out of a surface or obstacle, or null if it is outside.
 * @param {Vec[]} corners of the object in the world @param {EditedSurface | EditedObstacle} solid
 * @returns {{depth: number, normal: Vec} | null}
 */
function wayOut(corners, solid) {
  const low = (/** @type {Vec} */ [nx, ny], /** @type {Vec[]} */ points) => Math.min(...points.map(([x, y]) => nx * x + ny * y));
  if ("normal" in solid) {
    const depth = solid.offset - low(solid.normal, corners);
    return depth > 0 ? { depth, normal: solid.normal } : null;
  }
  // Of two convex shapes the shortest way is along a normal of a side.
  const normals = (/** @type {Vec[]} */ points, /** @type {number} */ sense) => points.flatMap(([ax, ay], k) => {
    const [bx, by] = points[(k + 1) % points.length], length = Math.hypot(bx - ax, by - ay);
    return length > 0 ? [/** @type {Vec} */ ([sense * (by - ay) / length, sense * (ax - bx) / length])] : [];
  });
  const ways = [...normals(solid.vertices, 1), ...normals(corners, -1)].map((normal) => {
    const [nx, ny] = normal;
    return { normal, depth: -low([-nx, -ny], solid.vertices) - low(normal, corners) };
  });
  ways.sort((one, other) => one.depth - other.depth);
  return ways.length > 0 && ways[0].depth > 0 ? ways[0] : null;
}

/**
 * Moves an object that reaches into surfaces or obstacles by at most `most` (m) out of them.
 * @param {Model} model @param {number} most
 */
export function lift(model, most) {
  const solids = [...model.surfaces, ...model.obstacles];
  // Out of one it may come into another one, so as many passes as there are.
  for (let pass = 0; pass < solids.length; pass++) {
    for (const solid of solids) {
      const way = wayOut(model.body.map((corner) => toWorld(model, corner)), solid);
      if (!way || way.depth > most) continue;
      const [x, y, theta] = model.start;
      // Outwards, by less than the solver sees, so that no rounding is inside.
      const step = way.depth + ROUNDING * sizeOf(model);
      const [u, v] = way.normal.map((part, axis) => Number(((axis ? y : x) + step * part).toPrecision(12)));
      model.start = [u, v, theta];
    }
  }
}

/** Returns an unused name. @param {Model} model @param {string} base */
function freeName(model, base) {
  const taken = new Set([...model.surfaces, ...model.obstacles].map(({ name }) => name));
  let name = base;
  for (let k = 2; taken.has(name); k++) name = `${base} ${k}`;
  return name;
}

/** Returns the friction of the first surface or obstacle. @param {Model} model */
function friction({ surfaces, obstacles }) {
  const [first] = [...surfaces, ...obstacles];
  return first ? { static: first.static, dynamic: first.dynamic, memory: first.memory } : { ...FRICTION };
}

/** Adds a surface near the object, in a direction that no surface has. @param {Model} model */
export function addSurface(model) {
  const isFree = (/** @type {[string, Vec]} */ [, [nx, ny]]) =>
    !model.surfaces.some(({ normal }) => nx * normal[0] + ny * normal[1] > SAME_DIRECTION);
  const [base, normal] = DIRECTIONS.find(isFree) ?? DIRECTIONS[0];
  const [x, y] = model.start;
  const offset = round(normal[0] * x + normal[1] * y - APART * sizeOf(model), FINENESS * sizeOf(model));
  model.surfaces.push({ name: freeName(model, base), normal: [...normal], offset, ...friction(model) });
}

/** Adds an obstacle with these corners; without any, a box near the object. @param {Model} model @param {Vec[]} corners */
export function addObstacle(model, corners) {
  const [x, y] = model.start, size = sizeOf(model);
  const [left, low] = [x + APART * size, y - 0.5 * size];
  /** @type {Vec[]} */
  const box = [[left, low], [left + size, low], [left + size, low + size], [left, low + size]];
  const place = (/** @type {number} */ value) => round(value, FINENESS * size);
  const vertices = corners.length > 0 ? corners : box.map(([u, v]) => /** @type {Vec} */ ([place(u), place(v)]));
  const base = ["", "pin", "wall"][vertices.length] ?? "block";
  model.obstacles.push({ name: freeName(model, base), vertices, ...friction(model) });
}

/** Removes rounding errors in the last digits of a number. @param {number} value */
const digits = (value) => Number(value.toPrecision(6));

/** Rounds to a multiple of the power of ten below a step. @param {number} value @param {number} step */
export function round(value, step) {
  const unit = 10 ** Math.floor(Math.log10(step));
  return Number((Math.round(value / unit) * unit).toPrecision(12));
}
