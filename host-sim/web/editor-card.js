// The small panel next to the selection in the editor: the numbers of the object, or name and friction of a surface or
// obstacle.

import { digits } from "./dom.js";

/** @typedef {import("./editor-model.js").Model} Model */
/** @typedef {import("./editor-handles.js").Item} Item */
/**
 * A field: its label, its unit, its value and the effect of a new number. Unless `mayBeEmpty`, it must not be empty.
 * @typedef {{id: string, label: string, name: string, unit: string, get: (model: Model) => number | null,
 *   put: (model: Model, value: number | null) => void, mayBeEmpty?: boolean}} Field
 */

const MM = 1e3;
const UM = 1e6;
const DEGREE = 180 / Math.PI;
/** Distance from the panel to the selected item, and to the border of the scene (px). */
const GAP = 14;
const MARGIN = 8;

/** @param {number | null} value @param {number} factor */
const times = (value, factor) => (value === null ? null : Number((value * factor).toPrecision(12)));

/** @type {Field[]} */
const BODY = [
  { id: "weight", label: "weight", name: "Weight", unit: "N", get: (m) => m.weight, put: (m, v) => { m.weight = Number(v); } },
  ...(/** @type {[string, string, string, 0 | 1][]} */ ([
    ["k_h", "Translational stiffness", "N/m", 0], ["k_theta", "Rotational stiffness", "N·m/rad", 1],
  ])).map(([id, name, unit, k]) => /** @type {Field} */ ({ id, label: ["k<sub>h</sub>", "k<sub>θ</sub>"][k], name, unit,
    get: (m) => m.stiffness[k], put: (m, v) => { m.stiffness[k] = Number(v); } })),
  ...(/** @type {[string, string, string, number, 0 | 1 | 2][]} */ ([
    ["x", "Start, x", "mm", MM, 0], ["y", "Start, y", "mm", MM, 1], ["theta", "Start, angle", "°", DEGREE, 2],
  ])).map(([id, name, unit, factor, k]) => /** @type {Field} */ ({ id, label: ["x", "y", "θ"][k], name, unit,
    get: (m) => times(m.start[k], factor), put: (m, v) => { m.start[k] = Number(v) / factor; } })),
];

/** Returns the fields of a surface or an obstacle. @param {Item} item @returns {Field[]} */
function frictionFields({ kind, index }) {
  const of = (/** @type {Model} */ m) => (kind === "surface" ? m.surfaces : m.obstacles)[index];
  return [
    { id: "static", label: "µ<sub>s</sub>", name: "Static friction", unit: "", get: (m) => of(m).static,
      put: (m, v) => { of(m).static = Number(v); of(m).dynamic = Math.min(of(m).dynamic, Number(v)); } },
    { id: "dynamic", label: "µ<sub>d</sub>", name: "Dynamic friction", unit: "", get: (m) => of(m).dynamic,
      put: (m, v) => { of(m).dynamic = Number(v); of(m).static = Math.max(of(m).static, Number(v)); } },
    { id: "memory", label: "D<sub>c</sub>", name: "Memory length", unit: "µm", mayBeEmpty: true,
      get: (m) => times(of(m).memory, UM), put: (m, v) => { of(m).memory = times(v, 1 / UM); } },
  ];
}

export class Card {
  /**
   * @param {Stage} stage
   * @param {{model: () => Model, change: (work: (model: Model) => void) => void, remove: (item: Item) => void,
   *   draw: () => void, tell: (text: string) => void}} deeds
   */
  constructor(stage, deeds) {
    this.stage = stage;
    this.deeds = deeds;
    this.root = document.createElement("form");
    this.root.className = "editor-card";
    this.root.hidden = true;
    this.root.addEventListener("submit", (event) => event.preventDefault());
    /** @type {Item | null} */
    this.item = null;
    /** Side of the item on which the panel stands, of all candidates. @type {number | null} */
    this.side = null;
    /** @type {{field: Field, input: HTMLInputElement}[]} */
    this.inputs = [];
    /** @type {HTMLInputElement | null} */
    this.name = null;
  }

  /** Shows the panel of an item, or none. @param {Item | null} item */
  show(item) {
    if (item?.kind === this.item?.kind && item?.index === this.item?.index) return;
    this.item = item;
    this.side = null;
    this.root.hidden = item === null;
    if (!item) return;
    const title = document.createElement("strong");
    title.textContent = { body: "Object", surface: "Surface", obstacle: "Obstacle" }[item.kind];
    const fields = item.kind === "body" ? BODY : frictionFields(item);
    this.inputs = fields.map((field) => ({ field, input: this.input(field) }));
    this.name = item.kind === "body" ? null : this.nameInput(item);
    const close = button("×", "Close this panel", () => this.show(null));
    close.className = "close";
    const action = item.kind === "body" ? button("Draw anew", "Draw the object's polygon anew", this.deeds.draw)
      : button("Remove", `Remove this ${item.kind}`, () => this.deeds.remove(item));
    const grid = document.createElement("div");
    grid.append(...(this.name ? [labelled("name", this.name, "")] : []),
      ...this.inputs.map(({ field, input }) => labelled(field.label, input, field.unit)));
    this.root.replaceChildren(title, close, grid, action);
    this.update();
  }

  /** @param {Field} field */
  input(field) {
    const input = document.createElement("input");
    input.inputMode = "decimal";
    input.setAttribute("aria-label", field.unit ? `${field.name} in ${field.unit}` : field.name);
    input.dataset.field = field.id;
    if (field.mayBeEmpty) input.placeholder = "L/4096";
    input.addEventListener("change", () => {
      const text = input.value.trim().replace(",", ".").replace("−", "-");
      const value = text === "" ? null : Number(text);
      if (value === null ? !field.mayBeEmpty : !Number.isFinite(value)) {
        this.deeds.tell(`${field.name} must be a number.`);
        this.update();
      } else {
        this.deeds.change((model) => field.put(model, value));
      }
    });
    return input;
  }

  /** @param {Item} item */
  nameInput({ kind, index }) {
    const input = document.createElement("input");
    input.setAttribute("aria-label", `Name of the ${kind}`);
    input.dataset.field = "name";
    input.addEventListener("change", () => this.deeds.change((model) => {
      (kind === "surface" ? model.surfaces : model.obstacles)[index].name = input.value;
    }));
    return input;
  }

  /** Shows the present values, next to the item. */
  update() {
    const { item } = this;
    const model = this.deeds.model();
    if (!item) return;
    const solid = item.kind === "body" ? null : (item.kind === "surface" ? model.surfaces : model.obstacles)[item.index];
    if (item.kind !== "body" && !solid) {
      this.show(null);
      return;
    }
    for (const { field, input } of this.inputs) {
      const value = field.get(model);
      if (document.activeElement !== input) input.value = value === null ? "" : String(Number(value.toPrecision(6)));
      input.title = value === null ? "" : digits(value);
    }
    if (this.name && solid && document.activeElement !== this.name) this.name.value = solid.name;
    this.place(item);
  }

  /** Moves next to the item, to the side where it covers the fewest handles; it stays on that side. @param {Item} item */
  place({ kind, index }) {
    const { left, top, width, height } = this.stage.canvas.getBoundingClientRect();
    const own = this.root.getBoundingClientRect();
    const boxes = [...document.querySelectorAll("[data-handle]")].map((element) => {
      const key = /** @type {SVGElement} */ (element).dataset.handle ?? "";
      const { x, y, width: w, height: h } = element.getBoundingClientRect();
      const isOwn = kind === "body" ? !/^(surface|obstacle)/.test(key) : `${key}-`.startsWith(`${kind}-${index}-`);
      const isOutline = element.matches(".outline");
      return { isOwn, isOutline, x: x - left, y: y - top, right: x - left + w, bottom: y - top + h };
    });
    const about = boxes.filter(({ isOwn }) => isOwn);
    if (about.length === 0) return;
    const [x0, x1] = [Math.min(...about.map(({ x }) => x)), Math.max(...about.map(({ right }) => right))];
    const [y0, y1] = [Math.min(...about.map(({ y }) => y)), Math.max(...about.map(({ bottom }) => bottom))];
    const [midX, midY] = [(x0 + x1 - own.width) / 2, (y0 + y1 - own.height) / 2];
    const highest = this.stage.magnify * this.stage.view.top + MARGIN;
    const spots = [[x1 + GAP, midY], [x0 - GAP - own.width, midY], [midX, y0 - GAP - own.height], [midX, y1 + GAP],
      [width, height], [0, height], [width, highest], [0, highest]].map(([x, y]) => ({
      x: Math.max(MARGIN, Math.min(x, width - own.width - MARGIN)),
      y: Math.min(Math.max(highest, y), height - own.height - MARGIN),
    }));
    const covered = (/** @type {Spot} */ { x, y }) => boxes.filter((box) => !box.isOutline && box.right > x && box.x < x + own.width
      && box.bottom > y && box.y < y + own.height).length;
    if (this.side === null) {
      const counts = spots.map(covered);
      this.side = counts.indexOf(Math.min(...counts));
    }
    const { x, y } = spots[this.side];
    this.root.style.left = `${x}px`;
    this.root.style.top = `${y}px`;
  }
}

/** @param {string} label with subscripts @param {HTMLInputElement} input @param {string} unit */
function labelled(label, input, unit) {
  const element = document.createElement("label");
  const [, base, low] = label.match(/^([^<]*)(?:<sub>(.*)<\/sub>)?$/) ?? ["", label, ""];
  const text = document.createElement("span");
  text.textContent = base;
  if (low) text.append(Object.assign(document.createElement("sub"), { textContent: low }));
  const after = document.createElement("small");
  after.textContent = unit;
  element.append(text, input, after);
  return element;
}

/** Makes a button. @param {string} text @param {string} name @param {() => void} work */
export function button(text, name, work) {
  const element = document.createElement("button");
  element.type = "button";
  element.textContent = text;
  if (name !== text) element.setAttribute("aria-label", name);
  element.addEventListener("click", work);
  return element;
}
