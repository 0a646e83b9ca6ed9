// The controls of the solver: scene, number type, evolution, the parameters, pause, step, speed, reset.

import { byId, digits, setText } from "./dom.js";
import { Gallery } from "./gallery.js";

/** @typedef {"stiffness_translation" | "stiffness_rotation" | "static" | "dynamic" | "memory" | "weight"} ParameterName */

/**
 * Range of a slider, whether its scale is logarithmic, and the unit of typed values.
 * @type {Record<ParameterName, {least: number, most: number, log: boolean, unit?: number}>}
 */
const RANGES = {
  stiffness_translation: { least: 10, most: 10000, log: true },
  stiffness_rotation: { least: 0.01, most: 100, log: true },
  static: { least: 0, most: 1.5, log: false },
  dynamic: { least: 0, most: 1.5, log: false },
  memory: { least: 1e-6, most: 1e-2, log: true, unit: 1e-6 },
  weight: { least: 0, most: 20, log: false },
};
const NAMES = /** @type {ParameterName[]} */ (Object.keys(RANGES));
/** Memory length of a scene without one, relative to the size of the body. */
const MEMORY = 1 / 4096;
/** Largest number of f32, the usual number type. */
const MOST = "3.4e38";
/** Steps of a slider. */
const STEPS = 1000;

export class Controls {
  /**
   * @param {() => Feed} feed @param {(text: string) => void} tell
   * @param {() => void} chosen called when a scene that the reader has chosen is there
   */
  constructor(feed, tell, chosen) {
    this.feed = feed;
    this.tell = tell;
    /** @type {StateMessage | null} */
    this.state = null;
    /** Parameters that wait for the answer to the previous ones. @type {Partial<SceneParameters> | null} */
    this.waiting = null;
    this.underWay = false;
    this.gallery = new Gallery(async (name) => {
      const taken = await this.ask({ type: "scene", name });
      if (taken) chosen();
      return taken;
    });
    /** A board keeps the weight of its scene. */
    this.keepsWeight = false;
    this.number = byId("number", HTMLSelectElement);
    this.evolution = byId("evolution", HTMLSelectElement);
    this.pauseButton = byId("pause", HTMLButtonElement);
    this.speed = byId("speed", HTMLSelectElement);
    this.sliders = inputs("slide");
    this.typed = inputs("type");
    this.listen();
  }

  /** Connects the controls. */
  listen() {
    this.number.addEventListener("change", () => this.ask({ type: "number", value: this.number.value }));
    this.evolution.addEventListener("change", () => this.ask({ type: "evolution", value: this.evolution.value }));
    this.speed.addEventListener("change", () => this.ask({ type: "speed", value: Number(this.speed.value) }));
    this.pauseButton.addEventListener("click", () => this.pause());
    byId("step").addEventListener("click", () => this.step());
    byId("reset").addEventListener("click", () => this.reset());
    byId("defaults").addEventListener("click", () => this.ask({ type: "defaults" }));
    for (const name of NAMES) {
      const slider = this.sliders[name];
      slider.max = String(STEPS);
      slider.addEventListener("input", () => this.set(name, fromSlider(name, Number(slider.value)), name));
      this.typed[name].addEventListener("change", () => this.type(name));
    }
  }

  /**
   * Sends a request; if it is refused, shows the reason and restores the controls.
   * @param {{type: string, [field: string]: unknown}} message
   */
  async ask(message) {
    try {
      await this.feed().request(message);
      return true;
    } catch (why) {
      this.tell(/** @type {Error} */ (why).message);
      if (this.state) this.show(this.state);
      return false;
    }
  }

  /** Pauses or resumes. */
  pause() {
    this.ask({ type: "pause", value: !this.state?.paused });
  }

  /** Makes one tick; pauses first. */
  async step() {
    if (!this.state?.paused) await this.ask({ type: "pause", value: true });
    this.ask({ type: "step", ticks: 1 });
  }

  /** Restarts: body and hand, and the parameters of the scene's file. */
  reset() {
    this.ask({ type: "reset", parameters: true });
  }

  /** Takes a typed value. @param {ParameterName} name */
  type(name) {
    const text = this.typed[name].value.trim().replace(",", ".").replace("−", "-");
    const value = text === "" ? NaN : Number(text);
    const inSi = Number((value * (RANGES[name].unit ?? 1)).toPrecision(12));
    const isMore = name === "stiffness_translation";
    const problem = Number.isNaN(value) ? " must be a number."
      : value < 0 || (isMore && value === 0) ? ` is ${text}; allowed: ${isMore ? "more than 0" : "0 or more"}.`
      : Number.isFinite(Math.fround(inSi)) ? "" : ` is ${text}; allowed: at most ${MOST}.`;
    if (text === "" && name === "memory") {
      this.set(name, null);
    } else if (problem === "") {
      this.set(name, inSi);
    } else {
      this.tell(this.typed[name].getAttribute("aria-label") + problem);
      if (this.state) this.showParameters(this.state.parameters, null, true);
    }
  }

  /**
   * Sets one parameter. The dynamic friction never exceeds the static one: the other one is adjusted.
   * @param {ParameterName} name @param {number | null} value null: the memory length of a scene without one
   * @param {ParameterName | null} moved the slider that is being moved, which stays where it is
   */
  set(name, value, moved = null) {
    if (!this.state) return;
    const now = { ...this.state.parameters, ...this.waiting };
    /** @type {Partial<SceneParameters>} */
    const change = { [name]: value };
    if (name === "static" && value !== null && value < now.dynamic) change.dynamic = value;
    if (name === "dynamic" && value !== null && value > now.static) change.static = value;
    this.waiting = { ...this.waiting, ...change };
    this.showParameters({ ...now, ...change }, moved, true);
    this.sendParameters();
  }

  /** Sends waiting parameters, each message after the answer to the previous one. */
  async sendParameters() {
    if (this.underWay) return;
    this.underWay = true;
    let taken = true;
    while (this.waiting) {
      const parameters = this.waiting;
      this.waiting = null;
      taken = await this.ask({ type: "set", parameters });
    }
    this.underWay = false;
    if (!taken && this.state) this.showParameters(this.state.parameters, null, true);
  }

  /** Shows the scenes to choose from, and disables what a board does not support. @param {HelloMessage} hello */
  setHello(hello) {
    this.gallery.setHello(hello);
    this.keepsWeight = hello.source.kind !== "core";
    this.number.disabled = hello.source.kind !== "core";
    if (this.state) this.show(this.state);
  }

  /** Shows a state. @param {StateMessage} state */
  show(state) {
    this.state = state;
    this.gallery.show(state);
    choose(this.number, state.number);
    this.evolution.value = state.evolution;
    if (![...this.speed.options].some(({ value }) => Number(value) === state.speed)) {
      this.speed.add(new Option(`${digits(state.speed)}×`, String(state.speed)));
    }
    this.speed.value = [...this.speed.options].find(({ value }) => Number(value) === state.speed)?.value ?? "1";
    this.pauseButton.setAttribute("aria-pressed", String(state.paused));
    setText(byId("pause-text"), state.paused ? "Go on" : "Pause");
    if (!this.waiting && !this.underWay) this.showParameters(state.parameters, null);
  }

  /**
   * Shows parameters, except in the field that is being typed in and on the slider that is being moved.
   * @param {SceneParameters} parameters @param {ParameterName | null} moved @param {boolean} all updates the field, too
   */
  showParameters(parameters, moved, all = false) {
    for (const name of NAMES) {
      // A scene without a surface has no friction.
      const isAbsent = parameters[name === "memory" ? "static" : name] === null || (name === "weight" && this.keepsWeight);
      const value = parameters[name] ?? (name === "memory" && this.state ? MEMORY * size(this.state.scene) : 0);
      const shown = Number((value / (RANGES[name].unit ?? 1)).toPrecision(4));
      this.sliders[name].disabled = isAbsent;
      this.typed[name].disabled = isAbsent;
      const said = document.getElementById(`value-${name}`);
      if (said) setText(said, isAbsent ? "–" : String(shown));
      if (moved !== name) this.sliders[name].value = String(toSlider(name, value));
      this.sliders[name].setAttribute("aria-valuetext", digits(shown));
      const typing = document.activeElement === this.typed[name] && !all;
      if (!typing) this.typed[name].value = parameters[name] === null && name === "memory" ? "" : String(shown);
    }
  }
}

/**
 * Selects a value in a list; adds it if it is missing.
 * @param {HTMLSelectElement} list @param {string} value
 */
function choose(list, value) {
  if (![...list.options].some((option) => option.value === value)) list.add(new Option(value, value));
  list.value = value;
}

/** Returns the largest distance between two vertices of a body; 0 for a point. @param {Scene} scene */
const size = ({ body }) =>
  Math.max(...body.flatMap(([ax, ay]) => body.map(([bx, by]) => Math.hypot(ax - bx, ay - by))));

/**
 * Returns the inputs of the parameters, by name.
 * @param {"slide" | "type"} kind @returns {Record<ParameterName, HTMLInputElement>}
 */
function inputs(kind) {
  const all = NAMES.map((name) => [name, byId(`${kind}-${name}`, HTMLInputElement)]);
  return /** @type {any} */ (Object.fromEntries(all));
}

/** Returns the value at a slider position, rounded to three digits. @param {ParameterName} name @param {number} place */
function fromSlider(name, place) {
  const { least, most, log } = RANGES[name];
  const part = place / STEPS;
  return Number((log ? least * (most / least) ** part : least + part * (most - least)).toPrecision(3));
}

/** Returns the slider position of a value. @param {ParameterName} name @param {number} value */
function toSlider(name, value) {
  const { least, most, log } = RANGES[name];
  if (value <= least) return 0;
  const part = log ? Math.log(value / least) / Math.log(most / least) : (value - least) / (most - least);
  return Math.round(STEPS * Math.min(1, part));
}
