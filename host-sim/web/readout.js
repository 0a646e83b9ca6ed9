// Texts and numbers of the page: the state over the scene, the trade, the source of the poses and its quality, the holder of
// the hand, and the connection.

import { byId, digits, duration, fixed, quantile, setText, whole } from "./dom.js";
import { EVENTS, MEANINGS } from "./events.js";
import { unitsOf } from "./sizes.js";

/** Pause between two updates of the texts, and of the text that is read aloud (ms). */
const PAUSE = 100;
const ALOUD = 2000;
/** Decades of the error bars: from 1e-4 to 1e5. */
const LEAST = -4;
const MOST = 5;

export class Readout {
  /** @param {Stage} stage */
  constructor(stage) {
    this.stage = stage;
    /** @type {HelloMessage | null} */
    this.hello = null;
    /** @type {StateMessage | null} */
    this.state = null;
    this.last = 0;
    /** The frame that the texts show. @type {FrameMessage | null} */
    this.shown = null;
    this.spoken = "";
    this.spokenAt = 0;
    this.events = new Map(EVENTS.map((name) => [name, eventChip(name)]));
  }

  /** @param {HelloMessage} hello */
  setHello(hello) {
    this.hello = hello;
    setText(byId("source"), sourceText(hello.source));
    setText(byId("program"), hello.program);
  }

  /** @param {StateMessage} state */
  setState(state) {
    this.state = state;
    const { by, client } = state.hand;
    const mine = client !== null && client === this.hello?.you;
    const page = mine ? "this page" : `page ${client}`;
    const holders = /** @type {{[by: string]: string}} */ ({ page, osc: "OSC", opentrack: "OpenTrack", replay: "a path" });
    setText(byId("holder"), `Hand: ${by === null ? "at rest" : holders[by] ?? by}`);
    byId("holder").dataset.mine = String(mine);
    byId("clients").parentElement?.setAttribute("data-alone", String(state.clients === 1));
    setText(byId("clients"), state.clients === 1 ? "1 page" : `${state.clients} pages`);
    setText(byId("trade-what"), `${state.number}, ${state.evolution} against f64, path`);
  }

  /**
   * Shows the newest frame as text; called with every drawing, works ten times per second. Returns true if it must be called
   * again to show the newest one.
   */
  update() {
    const { message } = this.stage;
    const now = performance.now();
    if (!message || message === this.shown) return false;
    if (now - this.last < PAUSE) return true;
    this.last = now;
    this.shown = message;
    this.showFrame(message);
    this.showTrade(message.reference);
    this.showHealth(message);
    const { counts } = message;
    // Several slips in one tick are one event; here, as everywhere on the page, each slip counts.
    for (const name of EVENTS) this.showEvent(name, name === "slip" ? counts.slips : counts.events[name] ?? 0);
    if (now - this.spokenAt > ALOUD && message.frame.state !== this.spoken) {
      this.spokenAt = now;
      this.spoken = message.frame.state;
      setText(byId("aloud"), `Contact state: ${message.frame.state}`);
    }
    return false;
  }

  /** Shows state, poses and wrench, over the scene. @param {FrameMessage} message */
  showFrame({ frame, holding }) {
    setText(byId("state-name"), frame.state);
    const status = byId("status");
    setText(status, frame.status === "ok" ? "" : frame.status);
    status.hidden = frame.status === "ok";
    if (!this.state) return;
    const { length, force, moment } = unitsOf(this.state);
    const poseTexts = (/** @type {Pose} */ [x, y, angle]) =>
      [fixed(x * length.per, 2), fixed(y * length.per, 2), fixed((angle * 180) / Math.PI, 2)];
    const poseWords = [", ", ` ${length.name}, `];
    setNumbers(byId("hand-pose"), poseTexts(frame.hand), [...poseWords, holding ? "°" : "°, open"]);
    setNumbers(byId("body-pose"), poseTexts(frame.pose), [...poseWords, "°"]);
    const [fx, fy, m] = frame.wrench;
    setNumbers(byId("wrench"), [fixed(Math.hypot(fx, fy) * force.per, 2), fixed(m * moment.per, 1)],
      [` ${force.name}, `, ` ${moment.name}`]);
  }

  /** Shows the errors against the reference, present and worst. @param {Reference | null} reference */
  showTrade(reference) {
    byId("trade").dataset.none = String(reference === null);
    if (!reference) return;
    const { error, worst, differ, since, state } = reference;
    showError("length", error[0] * 1e6, worst[0] * 1e6, "µm");
    showError("angle", error[1] * 1e3, worst[1] * 1e3, "mrad");
    const now = this.stage.message?.frame.state === state;
    setText(byId("differ-now"), now ? "the same" : `reference: ${state}`);
    byId("differ-now").dataset.differs = String(!now);
    const part = fixed(since ? (100 * differ) / since : 0, 2);
    setText(byId("differ"), `${whole(differ)} of ${whole(since)} (${part} %)`);
  }

  /** Shows time per step, ticks, lost frames, latency; for a board also its health. @param {FrameMessage} message */
  showHealth({ counts, skipped, board }) {
    setText(byId("ticks"), `${whole(counts.ticks)}, ${whole(counts.missed)} missed`);
    setText(byId("skipped"), whole(skipped));
    const latencies = this.stage.latencies.list().slice(-300);
    const [median, most] = [0.5, 0.99].map((part) => fixed(quantile(latencies, part), 0));
    setText(byId("latency"), latencies.length ? `${median} ms, 99 %: ${most} ms` : "move the hand to measure");
    setText(byId("drawing"), `${fixed(quantile(this.stage.drawTimes.list().slice(-300), 0.5), 1)} ms`);
    byId("board-health").hidden = board === null;
    if (!board) return;
    setText(byId("board-link"), board.connected ? `connected, ${fixed(board.rate, 0)} poses/s` : "not connected");
    setText(byId("board-latency"), board.latency === null ? "–" : duration(board.latency));
    setText(byId("board-lost"), `${whole(board.lost)} lost, ${whole(board.late)} late`);
    setText(byId("board-missed"), `${whole(board.missed)} ticks missed, ${whole(board.faults)} faults`);
  }

  /** Shows the count of an event. @param {string} name @param {number} count */
  showEvent(name, count) {
    const chip = this.events.get(name);
    if (!chip) return;
    setText(chip.count, whole(count));
    chip.root.dataset.none = String(count === 0);
  }

  /** Shows the connection. @param {boolean} yes @param {boolean} serial whether a board on Web Serial replaces it */
  setConnected(yes, serial) {
    byId("lost").hidden = yes || serial;
    byId("source").dataset.lost = String(!yes);
    document.body.dataset.lost = String(!yes);
    if (!yes && !serial) setText(byId("source"), "not connected");
    else if (this.hello) setText(byId("source"), sourceText(this.hello.source));
  }
}

/** Makes a chip with the count of an event. @param {string} name */
function eventChip(name) {
  const count = document.createElement("b");
  const root = document.createElement("li");
  root.title = `${name}: ${MEANINGS[name]}`;
  root.append(name, " ", count);
  byId("events").append(root);
  return { root, count };
}

/**
 * Shows the present and the worst error, as numbers and as marks on a logarithmic bar.
 * @param {"length" | "angle"} name @param {number} now @param {number} worst @param {string} unit
 */
function showError(name, now, worst, unit) {
  setText(byId(`error-${name}`), `${digits(now)} ${unit}`);
  setText(byId(`worst-${name}`), `${digits(worst)} ${unit}`);
  const place = (/** @type {number} */ value) =>
    Math.min(1, Math.max(0, (Math.log10(Math.max(value, 1e-12)) - LEAST) / (MOST - LEAST)));
  const bar = byId(`bar-${name}`);
  bar.style.setProperty("--now", place(now).toFixed(3));
  bar.style.setProperty("--worst", place(worst).toFixed(3));
}

/**
 * Sets numbers, each followed by its text, in places of fixed width: none moves when another one becomes longer.
 * @param {HTMLElement} element @param {string[]} numbers @param {string[]} words
 */
function setNumbers(element, numbers, words) {
  if (element.children.length !== 2 * numbers.length) {
    element.replaceChildren(...numbers.flatMap(() => [document.createElement("span"), document.createElement("span")]));
  }
  numbers.forEach((number, i) => {
    const [place, after] = [element.children[2 * i], element.children[2 * i + 1]];
    place.className = "number";
    setText(place, number);
    setText(after, words[i]);
  });
}

/** Describes the source of the poses. @param {Source} source */
function sourceText({ kind, name, number, where, emulated }) {
  if (kind === "core") return "this computer";
  const board = [emulated ? "emulated board" : "board", name].filter(Boolean).join(" ");
  return [board, number, where].filter(Boolean).join(", ");
}
