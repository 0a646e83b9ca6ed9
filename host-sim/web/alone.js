// The solver in the page itself, if there is no server: a worker that exchanges the messages of the server. Controls that need
// a program are hidden.

import { byId } from "./dom.js";
import { Talk } from "./talk.js";

/** Controls that need a program: recordings, uploads, other pages. */
const HIDDEN = ["record", "upload", "recording-section", "let-go", "clients", "holder"];
const CHOICES = ["recording", "upload"];

/** The solver, in files next to the page. */
const BESIDE = { script: "worker.js", wasm: "stiction.wasm" };

export class Alone extends Talk {
  /** @param {FeedEvents} events */
  constructor(events) {
    super(events);
    /** @type {Worker | null} */
    this.worker = null;
    /** The worker has sent something. */
    this.running = false;
    /** Requests for files. @type {((answer: {text?: string, problem?: string}) => void)[]} */
    this.files = [];
    for (const id of HIDDEN) byId(id).hidden = true;
    for (const value of CHOICES) document.querySelector(`#replay [value=${value}]`)?.setAttribute("hidden", "");
    this.start().catch((why) => events.error(`The solver cannot be started here: ${why.message}`));
  }

  /** Starts the worker; if the page is a single file, from the data packed in it. */
  async start() {
    const packed = document.querySelector("#packed")?.textContent;
    const { script, ...files } = packed ? await unpacked(packed) : BESIDE;
    const worker = new Worker(script);
    worker.addEventListener("message", ({ data }) => this.hear(data));
    worker.addEventListener("error", ({ message }) => this.failed(message || "the worker could not be loaded"));
    worker.postMessage(files);
    this.worker = worker;
    this.askRate();
  }

  /**
   * Takes what the worker sends: messages, the answer to a request for a file, or the reason of a failure.
   * @param {string[] | {file?: number, text?: string, problem: string}} data
   */
  hear(data) {
    if (!Array.isArray(data) && data.file !== undefined) {
      this.files[data.file](data);
      return;
    }
    if (!Array.isArray(data)) return this.failed(data.problem);
    if (!this.running) this.events.connected(true);
    this.running = true;
    for (const text of data) this.take(text);
  }

  /** Handles the loss of the solver. @param {string} why */
  failed(why) {
    this.worker?.terminate();
    this.worker = null;
    this.running = false;
    this.giveUp("The solver has stopped.");
    this.events.connected(false);
    this.events.error(`The solver has stopped: ${why}`);
  }

  /**
   * Requests a file from the worker as from a server.
   * @param {"scene" | "edit" | "scene.toml"} path @param {string} name @param {string | null} body @returns {Promise<string>}
   */
  file(path, name, body) {
    return new Promise((done, failed) => {
      const file = this.files.push(({ text, problem }) => {
        delete this.files[file];
        if (text === undefined) failed(new Error(problem));
        else done(text);
      }) - 1;
      if (this.worker) this.worker.postMessage({ file, path, name, body: body ?? "" });
      else failed(new Error("The solver has stopped."));
    });
  }

  /** @param {object} message @returns {boolean} */
  send(message) {
    this.worker?.postMessage(JSON.stringify(message));
    return this.worker !== null;
  }
}

/** Returns script and wasm of a page that is a single file. @param {string} packed */
async function unpacked(packed) {
  const { worker, wasm } = JSON.parse(packed);
  const script = new Blob([await bytes(worker)], { type: "text/javascript" });
  return { script: URL.createObjectURL(script), wasm: await bytes(wasm) };
}

/** Unpacks bytes that were compressed and encoded as text, in base64. @param {string} text */
export function bytes(text) {
  const raw = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
  const stream = new Blob([raw]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).arrayBuffer();
}
