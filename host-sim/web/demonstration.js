// A demonstration until somebody touches the page: the hand follows the scene's path repeatedly, and a caption describes what
// the object does. It begins when the page is opened and when a scene is chosen. The first press, touch or key ends it, except on a
// button that opens a part of the page; hand and object stay where they are. Also the note about a released object.

import { byId, reducedMotion, setText } from "./dom.js";

/** Duration of a caption (ms): the time to read it. */
const SAID = 600;
/** A hand that is open for this long (ms) has let go; one that grasps elsewhere is open for less. */
const OPEN = 300;
/** Largest distance of a hand from its start at which it counts as there (m, rad): a frame has the digits of f32. */
const NEAR = 1e-6;
/** Captions by the name of the event; if two coincide, the first one is shown. */
const WORDS = /** @type {const} */ ([
  ["snap", "snaps over"], ["tip", "tips"], ["slip", "slips"], ["land", "lies down"], ["touch", "touches"], ["lift", "comes off"],
]);

/** Returns true for a slider under the scene. @param {EventTarget | null} target */
const isDial = (target) => target instanceof Element && target.matches('.dials input[type="range"]');

export class Demonstration {
  /**
   * @param {(message: {type: string, [field: string]: unknown}) => Promise<void>} request
   * @param {() => boolean} ready whether the page has applied its address
   * @param {(text: string) => void} tell
   */
  constructor(request, ready, tell) {
    this.request = request;
    this.ready = ready;
    this.tell = tell;
    /** @type {HelloMessage | null} */
    this.hello = null;
    /** @type {StateMessage | null} */
    this.state = null;
    /** Nothing starts by itself any more: the demonstration has started, or somebody has pressed or typed. */
    this.over = false;
    /** It is requested, but not answered yet. */
    this.asking = false;
    /** It goes on, from its beginning, when the slider under the scene has its value. */
    this.resumes = false;
    /** The last caption, and the end of its time. */
    this.word = "";
    this.until = 0;
    /** Number of past events, by name. @type {{[event: string]: number}} */
    this.counts = {};
    this.openSince = Infinity;
    this.button = byId("show-me", HTMLButtonElement);
    this.button.addEventListener("click", () => this.ask().catch((why) => this.tell(why.message)));
    for (const name of ["pointerdown", "keydown", "click"]) {
      document.addEventListener(name, ({ target }) => this.touch(target, name), { capture: true });
    }
    document.addEventListener("change", ({ target }) => {
      if (this.resumes && isDial(target)) this.ask().catch((why) => this.tell(why.message));
    });
  }

  /** The hand follows the scene's path in a demonstration. */
  get running() {
    return this.state?.replay?.demonstration === true;
  }

  /** Begins. */
  async ask() {
    this.over = this.asking = true;
    try {
      await this.request({ type: "replay", what: "scene", demonstration: true });
    } finally {
      this.asking = false;
    }
  }

  /** Begins with a scene that was chosen: its story promises motion. A board, and a hand that comes from elsewhere, refuse it. */
  play() {
    if (!reducedMotion() && this.hello?.source.kind === "core") this.ask().catch(() => {});
  }

  /**
   * Ends it: somebody has pressed or typed. A slider under the scene only interrupts it.
   * @param {EventTarget | null} target @param {string} name
   */
  touch(target, name) {
    this.over = true;
    // Who opens or closes the scenes or the details goes on watching.
    if (target instanceof Element && target.closest("[data-panel]")) return;
    // The click that ends the motion of a slider.
    if (name === "click" && isDial(target)) return;
    this.resumes = isDial(target) && (this.running || this.asking || this.resumes);
    if (this.running || this.asking) this.request({ type: "replay", what: null }).catch((why) => this.tell(why.message));
  }

  /** @param {StateMessage} state */
  setState(state) {
    this.state = state;
    const { running } = this;
    byId("demonstration").hidden = !running;
    if (running) byId("hint").hidden = false;
    setText(byId("hint"), running ? "Press on the object to take it." : "Press on the object and drag it.");
    this.button.hidden = running || this.hello?.source.kind !== "core";
  }

  /** Takes the newest frame. @param {FrameMessage} message */
  take(message) {
    if (!this.over && this.mayBegin(message)) this.ask().catch(() => {});
    if (this.running) setText(byId("doing"), this.words(message));
    const now = performance.now();
    if (message.holding !== null) this.openSince = Infinity;
    else if (this.openSince === Infinity) this.openSince = now;
    const { length } = message.frame.contacts;
    const hangs = length < 2 || (this.state?.scene.weight ?? 0) > 0;
    byId("released").hidden = !hangs || this.running || now - this.openSince < OPEN;
    setText(byId("released-text"), length === 1
      ? "Released on one corner: it stays tilted, because statics computes rest only, and nothing falls."
      : "Released: it stays where it is, because nothing falls in statics.");
  }

  /** Returns true if nobody has done anything yet, here or elsewhere. @param {FrameMessage} message */
  mayBegin({ frame }) {
    const { hello, state } = this;
    if (!hello || !state || reducedMotion() || !this.ready()) return false;
    const { replay, hand, clients, paused, recording, scene } = state;
    const isAlone = hello.source.kind === "core" && clients === 1 && hand.by === null;
    const isLive = replay === null && recording === null && !paused;
    return isAlone && isLive && frame.hand.every((value, i) => Math.abs(value - scene.home[i]) <= NEAR * (1 + Math.abs(value)));
  }

  /** Returns the caption for the present moment. @param {FrameMessage} message */
  words({ frame, counts: { events } }) {
    const now = performance.now();
    const happened = WORDS.find(([event]) => (events[event] ?? 0) > (this.counts[event] ?? 0));
    this.counts = events;
    if (happened) {
      const again = happened[0] === "slip" && now < this.until && this.word.endsWith("slips");
      this.word = again ? "sticks and slips" : happened[1];
      this.until = now + SAID;
    }
    if (now < this.until) return this.word;
    if (frame.status === "jammed") return "jams";
    if (frame.contacts.length === 0) return "moves freely";
    if (frame.state === "locked") return "is locked";
    return frame.contacts.some(({ sliding }) => sliding !== 0) ? "slides along" : "sticks";
  }
}
