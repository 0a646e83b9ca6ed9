// Recording and replay: records, downloads, replays a path, and seeks in it.

import { byId, fixed, setText, whole } from "./dom.js";

/** The files of a recording. */
const FILES = ["recording.jsonl", "trace.jsonl", "scene.toml", "hand.csv"];
/** Positions on the scrubber. */
const PLACES = 1000;
/** Number of frames from the answer to a seek to its position. */
const LATER = 2;
/** Time between two seeks (ms). */
const PAUSE = 60;

export class Transport {
  /** @param {Ask} ask @param {(text: string) => void} tell */
  constructor(ask, tell) {
    this.ask = ask;
    this.tell = tell;
    /** @type {StateMessage | null} */
    this.state = null;
    /** Name of the uploaded path. @type {string | null} */
    this.uploaded = null;
    this.recordButton = byId("record", HTMLButtonElement);
    this.replay = byId("replay", HTMLSelectElement);
    this.scrubber = byId("scrubber", HTMLInputElement);
    this.place = byId("place");
    this.file = byId("file", HTMLInputElement);
    /** The scrubber is being moved, to this position. */
    this.scrubbing = false;
    this.target = 0;
    /** Pending answers to seeks, and frames since the last one. */
    this.seeking = 0;
    this.since = LATER;
    this.seekAt = 0;
    this.seekTimer = 0;
    this.scrubber.max = String(PLACES);
    this.listen();
  }

  /** Connects the controls. */
  listen() {
    this.recordButton.addEventListener("click", () => this.record());
    this.replay.addEventListener("change", () => this.choose());
    byId("upload").addEventListener("click", () => this.file.click());
    this.file.addEventListener("change", () => {
      const [file] = this.file.files ?? [];
      if (file) this.upload(file);
      this.file.value = "";
    });
    this.scrubber.addEventListener("input", () => {
      this.scrubbing = true;
      this.target = Number(this.scrubber.value) / PLACES;
      this.seek();
    });
    this.scrubber.addEventListener("change", () => { this.scrubbing = false; });
    for (const name of FILES) {
      byId(`get-${name}`, HTMLAnchorElement).addEventListener("click", (event) => {
        if (!this.state?.recorded) event.preventDefault();
      });
    }
  }

  /** Begins or ends a recording. */
  record() {
    this.ask({ type: "record", value: this.state?.recording === null });
  }

  /** Replays the selected path. */
  choose() {
    const what = this.replay.value === "live" ? null : this.replay.value;
    this.ask({ type: "replay", what });
  }

  /** Uploads a path and replays it. @param {File} file */
  async upload(file) {
    try {
      const response = await fetch(`upload?name=${encodeURIComponent(file.name)}`, { method: "POST", body: file });
      const answer = await response.json();
      if (!response.ok) throw new Error(answer.message ?? `The server refused ${file.name}.`);
      this.uploaded = file.name;
      const notes = answer.notes.map((/** @type {string} */ note) => ` Note: ${note}.`);
      this.tell(`${file.name}: ${whole(answer.records)} records, ${fixed(answer.seconds, 1)} s.${notes.join("")}`);
      await this.ask({ type: "replay", what: "upload" });
    } catch (why) {
      this.tell(`${file.name} cannot be used. ${/** @type {Error} */ (why).message}`);
    }
  }

  /** Seeks the last selected position, not too often; until it is reached, the scrubber stays where it was put. */
  seek() {
    if (this.seekTimer) return;
    const wait = Math.max(0, this.seekAt + PAUSE - performance.now());
    this.seekTimer = window.setTimeout(async () => {
      this.seekTimer = 0;
      this.seekAt = performance.now();
      const length = this.state?.replay?.seconds;
      if (!length) return;
      this.seeking++;
      await this.ask({ type: "seek", seconds: this.target * length });
      this.seeking--;
      this.since = 0;
    }, wait);
  }

  /** Shows a state. @param {StateMessage} state */
  show(state) {
    this.state = state;
    const { recording, recorded, replay } = state;
    this.recordButton.setAttribute("aria-pressed", String(recording !== null));
    setText(byId("record-text"), recording === null ? "Record" : "End recording");
    const what = replay === null ? "live" : ["scene", "recording"].includes(replay.what) ? replay.what : "upload";
    if (what === "upload" && replay) this.uploaded ??= replay.what;
    const option = (/** @type {string} */ value) =>
      /** @type {HTMLOptionElement} */ (this.replay.querySelector(`[value=${value}]`));
    option("recording").disabled = recorded === null;
    option("upload").disabled = this.uploaded === null;
    option("upload").textContent = this.uploaded ? `uploaded: ${this.uploaded}` : "uploaded path";
    this.replay.value = what;
    this.scrubber.disabled = replay === null;
    if (replay === null) {
      this.scrubber.value = "0";
      setText(this.place, recording === null ? "live" : "recording");
    }
    for (const name of FILES) {
      const link = byId(`get-${name}`, HTMLAnchorElement);
      link.setAttribute("aria-disabled", String(recorded === null));
      if (recorded === null) link.removeAttribute("href");
      else link.href = `recording/${name}`;
    }
    setText(byId("recorded"), recorded === null ? "nothing recorded yet"
      : `${recorded.earlier ? "of before: " : ""}${fixed(recorded.seconds, 1)} s, ${whole(recorded.frames)} records`);
    setText(byId("recording-file"), state.recording_file ?? recorded?.problem ?? recorded?.file ?? "");
  }

  /** Counts a frame. */
  count() {
    if (this.since < LATER) this.since++;
  }

  /** Shows the position, or the length. @param {FrameMessage} message */
  take({ position, frame }) {
    const { state } = this;
    if (!state) return;
    if (state.replay && position != null) {
      const chosen = this.scrubbing || this.seekTimer || this.seeking || this.since < LATER;
      if (!chosen) this.scrubber.value = String(Math.round((PLACES * position) / (state.replay.seconds || 1)));
      const text = `${fixed(position, 1)} of ${fixed(state.replay.seconds, 1)} s`;
      setText(this.place, text);
      this.scrubber.setAttribute("aria-valuetext", text);
    } else {
      setText(this.place, `${state.recording === null ? "live" : "recording"}, ${fixed(frame.t, 1)} s`);
    }
  }
}
