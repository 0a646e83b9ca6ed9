// The address of a page without a server: scene, parameters and window, so that a link shows what its sender saw. Values equal
// to those of the scene's file are left out. A scene of the reader is in it as its file, compressed (gzip, base64 for addresses).
//
//     #scene=ladder&k_h=800&mu_s=0.4&number=fixed&evolution=frame&view=0.1,0.2,0.5&hide=ghost,trails
//     #scene=mine&file=H4sIAAAA...

import { bytes } from "./alone.js";
import { byId } from "./dom.js";

/** Names in the address of the parameters of `set`. */
const PARAMETERS = /** @type {const} */ ({
  k_h: "stiffness_translation", k_theta: "stiffness_rotation", mu_s: "static", mu_d: "dynamic", memory: "memory",
  weight: "weight",
});
/** Defaults of a page. */
const NUMBER = "f32";
const EVOLUTION = "path";
/** All keys of an address. */
const KEYS = ["scene", "file", ...Object.keys(PARAMETERS), "number", "evolution", "view", "hide"];
/** Time between two changes of the address (ms): a browser allows 200 in 30 s. */
const PAUSE = 250;

export class Address {
  /**
   * @param {Stage} stage @param {Ask} ask @param {Files} files
   * @param {(layer: string, shown: boolean) => void} showLayer @param {(text: string) => void} tell
   */
  constructor(stage, ask, files, showLayer, tell) {
    this.stage = stage;
    this.ask = ask;
    this.files = files;
    this.showLayer = showLayer;
    this.tell = tell;
    /** Initial parameters of every scene, by its name. @type {Map<string, SceneParameters>} */
    this.own = new Map();
    /** Scenes that every page has. @type {string[] | null} */
    this.bundled = null;
    /** The file of a scene of the reader as the address has it, and what identifies its content. */
    this.file = { of: "", packed: "" };
    /** Requested window: its middle and its width (m). @type {number[] | null} */
    this.view = null;
    /**
     * The address that was followed or written last. A different one was entered by the user: it is followed and not
     * overwritten.
     */
    this.known = "";
    /** An address is being followed. */
    this.busy = false;
    this.timer = 0;
    window.addEventListener("hashchange", () => this.follow());
    stage.also.push(() => this.drawn());
  }

  /** Takes scene and setting whenever they change; follows a new address. @param {StateMessage} state */
  setState({ scene, parameters, scenes }) {
    this.bundled ??= scenes ?? null;
    if (!this.own.has(scene.title)) this.own.set(scene.title, parameters);
    this.follow();
  }

  /** Follows the address until it no longer changes: it may change in the meantime. */
  async follow() {
    if (!this.stage.state || this.busy) return;
    this.busy = true;
    while (location.hash !== this.known) {
      this.known = location.hash;
      await this.obey(this.known, this.stage.state);
      this.stage.ask();
    }
    this.busy = false;
    this.later();
  }

  /** Applies one address. @param {string} hash @param {StateMessage} state */
  async obey(hash, state) {
    const wanted = new URLSearchParams(hash.slice(1));
    const name = wanted.get("scene") ?? state.scene.title, file = wanted.get("file");
    const unknown = [...wanted.keys()].filter((key) => !KEYS.includes(key));
    if (unknown.length > 0) this.tell(`${unknown.join(", ")} in the address: allowed are ${KEYS.join(", ")}.`);
    if (!await (file === null ? this.ask({ type: "scene", name }) : this.open(name, file))) return;
    await this.ask({ type: "number", value: this.choice(wanted, "number", NUMBER) });
    await this.ask({ type: "evolution", value: this.choice(wanted, "evolution", EVOLUTION) });
    const parameters = this.parameters(wanted);
    if (Object.keys(parameters).length > 0) await this.ask({ type: "set", parameters });
    this.layers((wanted.get("hide") ?? "").split(","));
    this.view = this.numbers(wanted, "view", 3);
  }

  /** Opens the scene of a file in the address; returns false if it cannot be used. @param {string} name @param {string} packed */
  async open(name, packed) {
    /** @type {ArrayBuffer} */
    let content;
    try {
      content = await bytes(packed.replaceAll("-", "+").replaceAll("_", "/"));
    } catch {
      this.tell("The address is cut off or damaged: the scene in it cannot be read.");
      return false;
    }
    try {
      const text = new TextDecoder().decode(content);
      await this.files.file("scene", `${name}.toml`, text);
      return true;
    } catch (why) {
      this.tell(`The scene of the address cannot be used. ${/** @type {Error} */ (why).message}`);
      return false;
    }
  }

  /** Returns the parameters for `set`. @param {URLSearchParams} wanted */
  parameters(wanted) {
    /** @type {Partial<SceneParameters>} */
    const parameters = {};
    for (const [key, name] of Object.entries(PARAMETERS)) {
      const [value] = this.numbers(wanted, key, 1) ?? [];
      if (value !== undefined) parameters[name] = value;
    }
    return parameters;
  }

  /**
   * Returns a choice of the address that the page's list offers, or the default.
   * @param {URLSearchParams} wanted @param {"number" | "evolution"} key @param {string} usual
   */
  choice(wanted, key, usual) {
    const value = wanted.get(key) ?? usual;
    const all = [...byId(key, HTMLSelectElement).options].map((option) => option.value);
    if (all.includes(value)) return value;
    this.tell(`${key}=${value} in the address: allowed are ${all.join(", ")}.`);
    return usual;
  }

  /**
   * Returns numbers of the address, or null.
   * @param {URLSearchParams} wanted @param {string} key @param {number} count
   */
  numbers(wanted, key, count) {
    const text = wanted.get(key);
    if (text === null) return null;
    const values = text.split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
    if (values.length === count && values.every(Number.isFinite)) return values;
    this.tell(`${key}=${text} in the address: allowed ${count === 1 ? "is a number" : `are ${count} numbers`}.`);
    return null;
  }

  /** Shows all layers but these. @param {string[]} hidden */
  layers(hidden) {
    for (const layer of Object.keys(this.stage.layers)) this.showLayer(layer, !hidden.includes(layer));
  }

  /** After a drawing: applies the requested window, once there is one, and updates the address. */
  drawn() {
    const { stage, view: wanted } = this;
    if (wanted && !this.busy && stage.fitted) {
      const [x, y, across] = wanted;
      this.view = null;
      stage.adjusted = true;
      Object.assign(stage.view, { x, y, scale: stage.view.width / across });
      stage.ask();
    }
    this.later();
  }

  /** Writes the address soon. */
  later() {
    if (!this.timer) this.timer = window.setTimeout(() => this.write(), PAUSE);
  }

  /** Whether a scene is the reader's own. @param {StateMessage} state */
  isOwn({ scene }) {
    return this.bundled?.includes(scene.title) === false;
  }

  /** Packs the file of a scene of the reader, if the address has another one. @param {StateMessage} state */
  async pack(state) {
    const of = contentOf(state);
    if (of === this.file.of) return;
    const text = await this.files.file("scene.toml", "", null);
    this.file = { of, packed: await compressed(text) };
  }

  /** Writes the address, unless it is being followed or is about to be. */
  async write() {
    this.timer = 0;
    if (this.stage.state && this.isOwn(this.stage.state)) await this.pack(this.stage.state).catch((why) => this.tell(why.message));
    const { state } = this.stage;
    if (this.busy || this.view || !state || location.hash !== this.known) return;
    if (this.isOwn(state) && this.file.of !== contentOf(state)) {
      // It has changed meanwhile.
      this.later();
      return;
    }
    const text = this.text(state);
    const hash = text && `#${text}`;
    // An empty address is that of the page.
    if (hash !== this.known) history.replaceState(null, "", hash || location.pathname + location.search);
    this.known = location.hash;
  }

  /** Returns the address of what the page shows. @param {StateMessage} state */
  text(state) {
    const { stage } = this;
    const { scene, parameters, number, evolution } = state;
    const isOwn = this.isOwn(state);
    const parts = [`scene=${encodeURIComponent(scene.title)}`];
    if (isOwn) parts.push(`file=${this.file.packed}`);
    for (const [key, name] of Object.entries(PARAMETERS)) {
      const value = parameters[name];
      if (!isOwn && value !== null && value !== this.own.get(scene.title)?.[name]) parts.push(`${key}=${value}`);
    }
    if (number !== NUMBER) parts.push(`number=${number}`);
    if (evolution !== EVOLUTION) parts.push(`evolution=${evolution}`);
    if (stage.adjusted) {
      const { x, y, width, scale } = stage.view;
      parts.push(`view=${[x, y, width / scale].map((value) => Number(value.toPrecision(5))).join(",")}`);
    }
    const hidden = Object.entries(stage.layers).filter(([, shown]) => !shown);
    if (hidden.length > 0) parts.push(`hide=${hidden.map(([layer]) => layer).join(",")}`);
    return parts.join("&");
  }
}

/** What identifies the content of a scene's file. @param {StateMessage} state */
const contentOf = ({ scene, parameters }) => JSON.stringify([scene, parameters]);

/** Compresses a text for an address. @param {string} text */
async function compressed(text) {
  const stream = new Blob([text]).stream().pipeThrough(new CompressionStream("gzip"));
  const letters = Array.from(new Uint8Array(await new Response(stream).arrayBuffer()), (byte) => String.fromCharCode(byte));
  return btoa(letters.join("")).replaceAll("+", "-").replaceAll("/", "_").replaceAll("=", "");
}
