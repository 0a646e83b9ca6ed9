// The small panel next to what is selected in the editor: the numbers of the object, or name and friction of a surface or obstacle.

import { digits } from "./dom.js";
import { toWorld } from "./editor-model.js";

/** @typedef {import("./editor-model.js").Model} Model */
/** @typedef {import("./editor-handles.js").Item} Item */
/**
 * A field: its label, its unit, what it shows and what a number in it does. Without `put` of null it must not be empty.
 * @typedef {{id: string, label: string, name: string, unit: string, get: (model: Model) => number | null,
 *   put: (model: Model, value: number | null) => void, mayBeEmpty?: boolean}} Field
 */

const MM = 1e3;
const UM = 1e6;
const DEGREE = 180 / Math.PI;
/** Between the panel and what it is of, and between it and the border of the scene (px). */
const GAP = 26;
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

/** Fields of a surface or an obstacle. @param {Item} item @returns {Field[]} */
function frictionFields({ kind, index }) {
  const of = (/** @type {Model} */ m) => (kind === "surface" ? m.surfaces : m.obstacles)[index];
  return [
    { id: "static", label: "µ<sub>s</sub>", name: "Static friction", unit: "", get: (m) => of(m).static,
      put: (m, v) => { of(m).static = Number(v); of(m).dynamic = Math.min(of(m).dynamic, Number(v)); } },
    { id: "dynamic", label: "µ<sub>d</sub>", name: "Dynamic friction", unit: "", get: (m) => of(m).dynamic,
      put: (m, v) => { of(m).dynamic = Number(v); of(m).static = Math.max(of(m).static, Number(v)); } },
    { id: "memory", label: "D<sub>c</sub>", name: "Memory length", unit: "µm", mayBeEmpty: true, get: (m) => times(of(m).memory, UM),
      put: (m, v) => { of(m).memory = times(v, 1 / UM); } },
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
    /** @type {{field: Field, input: HTMLInputElement}[]} */
    this.inputs = [];
    /** @type {HTMLInputElement | null} */
    this.name = null;
  }

  /** Shows the panel of something, or none. @param {Item | null} item */
  show(item) {
    if (item?.kind === this.item?.kind && item?.index === this.item?.index) return;
    this.item = item;
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

  /** Shows what holds now, next to what it is of. */
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
    this.place(model, item);
  }

  /** @param {Model} model @param {Item} item */
  place(model, item) {
    const { view, magnify, canvas } = this.stage;
    const points = item.kind === "body" ? model.body.map((corner) => toWorld(model, corner))
      : item.kind === "obstacle" ? model.obstacles[item.index].vertices : null;
    const handle = document.querySelector(`[data-handle="surface-${item.index}"]`)?.getBoundingClientRect();
    const { left, top, width, height } = canvas.getBoundingClientRect();
    const xs = points ? points.map(([x]) => magnify * view.px(x)) : handle ? [handle.left - left, handle.right - left] : [0];
    const ys = points ? points.map(([, y]) => magnify * view.py(y)) : handle ? [handle.top - top, handle.bottom - top] : [0];
    const own = this.root.getBoundingClientRect();
    const right = Math.max(...xs) + GAP, before = Math.min(...xs) - GAP - own.width;
    const x = right + own.width < width - MARGIN ? right : before > MARGIN ? before : width - own.width - MARGIN;
    const y = (Math.min(...ys) + Math.max(...ys)) / 2 - own.height / 2;
    this.root.style.left = `${Math.max(MARGIN, x)}px`;
    this.root.style.top = `${Math.min(Math.max(magnify * view.top + MARGIN, y), Math.max(MARGIN, height - own.height - MARGIN))}px`;
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

/** A button. @param {string} text @param {string} name @param {() => void} work */
export function button(text, name, work) {
  const element = document.createElement("button");
  element.type = "button";
  element.textContent = text;
  if (name !== text) element.setAttribute("aria-label", name);
  element.addEventListener("click", work);
  return element;
}
