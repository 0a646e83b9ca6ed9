// The handles of the editor: an outline, corners, and the handles of surfaces and of the pose, as shapes over the scene that
// follow its window; by mouse, finger or keyboard.

import { svg } from "./dom.js";
import { round, toWorld, toBody } from "./editor-model.js";

/** @typedef {import("./editor-model.js").Model} Model */
/**
 * The selection: the object, or a surface or obstacle by its index.
 * @typedef {{kind: "body" | "surface" | "obstacle", index: number}} Item
 */
/**
 * A handle: its position (m), and the effect of a displacement (m) on a model as it was at the press.
 * @typedef {{key: string, shape: "corner" | "turn" | "move" | "grasp" | "outline", item: Item, label: string, at: Vec,
 *   points?: Vec[], pivot?: Vec, pull: (model: Model, to: Vec, from: Vec) => void, corner?: number}} Handle
 */

/** Radius of a handle and of its touch area (px). */
const RADIUS = 6;
const TOUCH = 15;
/** Distance from a surface's handle to its rotation handle, and from the object's border to its rotation handle (px). */
const ARM = 64;
const STEM = 26;
/** Distance of a surface's handles from the border of the window (px). */
const MARGIN = 28;
/** Displacement by an arrow key (px), and its factor with shift; rotation by an arrow key (rad). */
const STEP = 5;
const FINE = 0.1;
const ANGLE = Math.PI / 180;
/** Coarsest rounding of positions (px). */
const UNIT = 0.1;

/** @type {{[key: string]: Vec}} */
const ARROWS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };

/**
 * Returns the position of a surface's handle: on its border, in the window, near a point.
 * @param {View} view @param {EditedSurface} surface @param {Vec} near @returns {Vec}
 */
function footOf(view, { normal: [nx, ny], offset }, near) {
  const gap = nx * near[0] + ny * near[1] - offset;
  const foot = /** @type {Vec} */ ([near[0] - gap * nx, near[1] - gap * ny]);
  const step = 12 / view.scale;
  for (let k = 0; k < 200; k++) {
    const s = (k % 2 ? 1 : -1) * Math.ceil(k / 2) * step;
    const at = /** @type {Vec} */ ([foot[0] + s * ny, foot[1] - s * nx]);
    const x = view.px(at[0]), y = view.py(at[1]);
    if (x > MARGIN && y > view.top + MARGIN && x < view.width - MARGIN && y < view.height - MARGIN) return at;
  }
  return foot;
}

/** Returns the rotation from one point to another about a third one. @param {Vec} about @param {Vec} from @param {Vec} to */
function turnAbout(about, from, to) {
  const [ax, ay] = [from[0] - about[0], from[1] - about[1]];
  const [bx, by] = [to[0] - about[0], to[1] - about[1]];
  return Math.atan2(ax * by - ay * bx, ax * bx + ay * by);
}

/** @param {Model} model @param {View} view @returns {Handle[]} */
function bodyHandles(model, view) {
  const item = /** @type {Item} */ ({ kind: "body", index: 0 });
  const place = (/** @type {number} */ value) => round(value, UNIT / view.scale);
  const corners = model.body.map((corner) => toWorld(model, corner));
  const [x, y] = model.start;
  const far = Math.max(0, ...model.body.map(([u]) => u)) + STEM / view.scale;
  const grip = model.grasp ?? [0, 0];
  return [
    { key: "body", shape: "outline", item, label: "Object", at: [x, y], points: corners, pull: (m, to, from) => {
      const [sx, sy, theta] = m.start;
      m.start = [place(sx + to[0] - from[0]), place(sy + to[1] - from[1]), theta];
    } },
    { key: "body-turn", shape: "turn", item, label: "Turn the object", at: toWorld(model, [far, 0]), pull: (m, to, from) => {
      m.start[2] = Number((m.start[2] + turnAbout([x, y], from, to)).toFixed(4));
    } },
    { key: "grasp", shape: "grasp", item, label: model.grasp ? "Holding point" : "Holding point, where the hand is",
      at: toWorld(model, grip), pull: (m, to) => { m.grasp = /** @type {Vec} */ (toBody(m, to).map(place)); } },
    ...corners.map((at, k) => /** @type {Handle} */ ({ key: `body-${k}`, shape: "corner", item, corner: k,
      label: `Corner ${k + 1} of the object`, at,
      pull: (m, to) => { m.body[k] = /** @type {Vec} */ (toBody(m, to).map(place)); } })),
  ];
}

/**
 * @param {EditedSurface} surface @param {number} index @param {View} view
 * @param {Handle | null} pulled the dragged handle: its pivot stays fixed
 * @returns {Handle[]}
 */
function surfaceHandles(surface, index, view, pulled) {
  const item = /** @type {Item} */ ({ kind: "surface", index });
  const isPulled = pulled?.item.kind === "surface" && pulled.item.index === index;
  const at = footOf(view, surface, isPulled ? pulled.pivot ?? pulled.at : [view.x, view.y]);
  const [nx, ny] = surface.normal;
  const arm = ARM / view.scale;
  const [a, b] = [1, -1].map((side) => /** @type {Vec} */ ([at[0] + side * arm * ny, at[1] - side * arm * nx]));
  const isIn = (/** @type {Vec} */ [u, v]) => view.px(u) > MARGIN && view.px(u) < view.width - MARGIN
    && view.py(v) > view.top && view.py(v) < view.height;
  return [
    { key: `surface-${index}`, shape: "move", item, label: `Surface ${surface.name}`, at, pull: (m, to, from) => {
      const s = m.surfaces[index];
      s.offset = round(s.offset + s.normal[0] * (to[0] - from[0]) + s.normal[1] * (to[1] - from[1]), UNIT / view.scale);
    } },
    { key: `surface-${index}-turn`, shape: "turn", item, label: `Turn surface ${surface.name}`,
      at: isIn(a) ? a : b, pivot: at, pull: (m, to, from) => {
      const s = m.surfaces[index];
      const angle = Number((Math.atan2(s.normal[1], s.normal[0]) + turnAbout(at, from, to)).toFixed(4));
      s.normal = [Math.cos(angle), Math.sin(angle)];
      s.offset = s.normal[0] * at[0] + s.normal[1] * at[1];
    } },
  ];
}

/** @typedef {import("./editor-model.js").EditedSurface} EditedSurface */
/** @typedef {import("./editor-model.js").EditedObstacle} EditedObstacle */

/** @param {EditedObstacle} obstacle @param {number} index @param {View} view @returns {Handle[]} */
function obstacleHandles({ name, vertices }, index, view) {
  const item = /** @type {Item} */ ({ kind: "obstacle", index });
  const place = (/** @type {number} */ value) => round(value, UNIT / view.scale);
  return [
    { key: `obstacle-${index}`, shape: "outline", item, label: `Obstacle ${name}`,
      at: vertices[0], points: vertices, pull: (m, to, from) => {
      const o = m.obstacles[index];
      const by = [to[0] - from[0], to[1] - from[1]].map(place);
      o.vertices = o.vertices.map(([x, y]) => [place(x + by[0]), place(y + by[1])]);
    } },
    ...vertices.map((at, k) => /** @type {Handle} */ ({ key: `obstacle-${index}-${k}`, shape: "corner", item, corner: k,
      label: `Corner ${k + 1} of ${name}`, at,
      pull: (m, to) => { m.obstacles[index].vertices[k] = /** @type {Vec} */ (to.map(place)); } })),
  ];
}

/**
 * Returns all handles, those in front last.
 * @param {Model} model @param {View} view @param {Handle | null} pulled @returns {Handle[]}
 */
function handlesOf(model, view, pulled) {
  return [
    ...model.obstacles.flatMap((obstacle, k) => obstacleHandles(obstacle, k, view)),
    ...model.surfaces.flatMap((surface, k) => surfaceHandles(surface, k, view, pulled)),
    ...bodyHandles(model, view),
  ];
}

/**
 * Actions of the editor on handles.
 * @typedef {{model: () => Model, select: (item: Item | null) => void, begin: () => Model, pulled: (model: Model) => void,
 *   end: () => void, remove: (item: Item, corner: number | undefined) => void,
 *   insert: (item: Item, side: number, at: Vec) => void}} Deeds
 */

export class Handles {
  /** @param {Stage} stage @param {Deeds} deeds */
  constructor(stage, deeds) {
    this.stage = stage;
    this.deeds = deeds;
    this.root = svg("svg", { class: "editor-layer", "aria-label": "Handles of the scene" });
    /** @type {Map<string, {element: SVGElement, handle: Handle}>} */
    this.known = new Map();
    /** The handle that a pointer drags. @type {{handle: Handle, from: Vec, start: Model, moved: boolean} | null} */
    this.pull = null;
    /** Beginning of the keys of what the solver refuses. */
    this.bad = "";
    /** @type {Item | null} */
    this.selected = null;
    this.root.addEventListener("wheel", (event) => {
      event.preventDefault();
      stage.canvas.dispatchEvent(new WheelEvent("wheel", /** @type {WheelEvent} */ (event)));
    }, { passive: false });
    stage.canvas.after(this.root);
  }

  /** Removes everything. */
  remove() {
    this.root.remove();
  }

  /** Returns the position of a pointer in the world. @param {MouseEvent} event @returns {Vec} */
  worldOf(event) {
    const { left, top } = this.stage.canvas.getBoundingClientRect();
    const { magnify, view } = this.stage;
    return view.world((event.clientX - left) / magnify, (event.clientY - top) / magnify);
  }

  /** Draws every handle at its place. */
  draw() {
    const handles = handlesOf(this.deeds.model(), this.stage.view, this.pull?.handle ?? null);
    const keys = new Set(handles.map(({ key }) => key));
    for (const [key, { element }] of this.known) {
      if (keys.has(key)) continue;
      element.remove();
      this.known.delete(key);
    }
    for (const handle of handles) this.drawOne(handle);
  }

  /** @param {Handle} handle */
  drawOne(handle) {
    const known = this.known.get(handle.key) ?? this.make(handle);
    known.handle = handle;
    const { element } = known;
    const { magnify, view } = this.stage;
    const px = (/** @type {Vec} */ [x, y]) => `${(magnify * view.px(x)).toFixed(1)} ${(magnify * view.py(y)).toFixed(1)}`;
    if (handle.points) {
      const path = handle.points.map((point) => px(point)).join("L");
      element.setAttribute("d", `M${path}Z`);
    } else {
      element.setAttribute("transform", `translate(${px(handle.at)})`);
    }
    const { kind, index } = handle.item;
    const isSelected = this.selected?.kind === kind && this.selected.index === index;
    const isBad = this.bad !== "" && (handle.key === this.bad || handle.key.startsWith(`${this.bad}-`));
    element.setAttribute("class", `handle ${handle.shape}${isSelected ? " selected" : ""}${isBad ? " bad" : ""}`);
    element.setAttribute("aria-label", handle.label);
  }

  /** @param {Handle} handle */
  make(handle) {
    const size = { corner: RADIUS, turn: RADIUS, grasp: RADIUS + 1, move: RADIUS + 1, outline: 0 }[handle.shape];
    const element = handle.points ? svg("path", {}) : svg("g", {}, svg("circle", { r: TOUCH, class: "touch" }),
      handle.shape === "move" || handle.shape === "grasp"
        ? svg("rect", { x: -size, y: -size, width: 2 * size, height: 2 * size,
          transform: `rotate(${handle.shape === "grasp" ? 45 : 0})` })
        : svg("circle", { r: size }));
    element.setAttribute("data-handle", handle.key);
    element.setAttribute("tabindex", "0");
    element.setAttribute("role", "button");
    const known = { element, handle };
    this.known.set(handle.key, known);
    this.listen(known);
    this.root.append(element);
    return known;
  }

  /** @param {{element: SVGElement, handle: Handle}} known */
  listen(known) {
    const { element } = known;
    element.addEventListener("focus", () => this.deeds.select(known.handle.item));
    element.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      element.setPointerCapture(event.pointerId);
      this.pull = { handle: known.handle, from: this.worldOf(event), start: this.deeds.begin(), moved: false };
    });
    element.addEventListener("pointermove", (event) => {
      if (this.pull?.handle.key !== known.handle.key) return;
      this.move(this.worldOf(event));
    });
    for (const name of /** @type {const} */ (["pointerup", "pointercancel"])) {
      element.addEventListener(name, () => {
        if (this.pull) this.deeds.end();
        this.pull = null;
      });
    }
    element.addEventListener("dblclick", (event) => this.double(known.handle, this.worldOf(event)));
    element.addEventListener("keydown", (event) => this.press(known.handle, event));
  }

  /** Drags the handle to a point. @param {Vec} to */
  move(to) {
    if (!this.pull) return;
    const { handle, from, start } = this.pull;
    const model = structuredClone(start);
    // A corner keeps its offset from the pointer at the press.
    const aim = /** @type {Vec} */ ([handle.at[0] + to[0] - from[0], handle.at[1] + to[1] - from[1]]);
    handle.pull(model, handle.points ? to : aim, handle.points ? from : handle.at);
    this.pull.moved = true;
    this.deeds.pulled(model);
  }

  /** Adds a corner to the nearest side, at a double click on an outline. @param {Handle} handle @param {Vec} at */
  double({ points, item }, at) {
    if (!points || points.length < 2) return;
    const distances = points.map((a, k) => distanceTo(a, points[(k + 1) % points.length], at));
    this.deeds.insert(item, distances.indexOf(Math.min(...distances)), at);
  }

  /** @param {Handle} handle @param {KeyboardEvent} event */
  press(handle, event) {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = ARROWS[event.key];
    if (event.key === "Delete" || event.key === "Backspace") {
      this.deeds.remove(handle.item, handle.corner);
    } else if (event.key === "Insert" && handle.corner !== undefined) {
      this.insertAfter(handle, handle.corner);
    } else if (arrow) {
      this.nudge(handle, arrow, event.shiftKey ? FINE : 1);
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }

  /** Adds a corner in the middle of the side after a corner. @param {Handle} handle @param {number} k */
  insertAfter({ item }, k) {
    const outline = this.known.get(item.kind === "body" ? "body" : `obstacle-${item.index}`)?.handle.points ?? [];
    const [a, b] = [outline[k], outline[(k + 1) % outline.length]];
    this.deeds.insert(item, k, [(a[0] + b[0]) / 2, (a[1] + b[1]) / 2]);
  }

  /** Moves or rotates by an arrow key. @param {Handle} handle @param {Vec} arrow @param {number} share */
  nudge(handle, arrow, share) {
    const model = structuredClone(this.deeds.begin());
    const { view } = this.stage;
    const step = share * STEP / view.scale;
    let to = /** @type {Vec} */ ([handle.at[0] + step * arrow[0], handle.at[1] + step * arrow[1]]);
    if (handle.shape === "turn") {
      const about = handle.item.kind === "body" ? /** @type {Vec} */ ([model.start[0], model.start[1]])
        : this.known.get(`surface-${handle.item.index}`)?.handle.at ?? handle.at;
      const angle = ANGLE * share * (arrow[1] - arrow[0]);
      const [dx, dy] = [handle.at[0] - about[0], handle.at[1] - about[1]];
      const c = Math.cos(angle), s = Math.sin(angle);
      to = [about[0] + c * dx - s * dy, about[1] + s * dx + c * dy];
    }
    handle.pull(model, to, handle.at);
    this.deeds.pulled(model);
    this.deeds.end();
  }
}

/** Returns the distance of a point from the segment between two others. @param {Vec} a @param {Vec} b @param {Vec} point */
function distanceTo(a, b, point) {
  const [dx, dy] = [b[0] - a[0], b[1] - a[1]];
  const along = Math.min(1, Math.max(0, ((point[0] - a[0]) * dx + (point[1] - a[1]) * dy) / (dx * dx + dy * dy || 1)));
  return Math.hypot(point[0] - a[0] - along * dx, point[1] - a[1] - along * dy);
}
