// The messages between a page and the solver, as specified in VIEW.md, over any connection: matches answers to requests, and
// sends samples of the hand one by one.

/** Time after which an answer counts as lost (ms). */
const PATIENCE = 5000;
/** Least time between samples of the hand, for fewer than 2000 per second (ms). */
const SAMPLE_SPACING = 0.6;
/** Frames per second: twice those of most screens, so that a drawn one is fresh; and for a hidden page. */
const RATE = 120;
const HIDDEN_RATE = 2;

/** @implements {Feed} */
export class Talk {
  /** @param {FeedEvents} events */
  constructor(events) {
    this.events = events;
    this.nextId = 1;
    /**
     * Requests without their answer.
     * @type {Map<number, {done: () => void, failed: (why: Error) => void, timer: number}>}
     */
    this.open = new Map();
    this.lastSample = -Infinity;
    /** @type {{pose: Pose, held: boolean, sent: number} | null} */
    this.waiting = null;
    document.addEventListener("visibilitychange", () => this.askRate());
  }

  /**
   * Sends, if there is a receiver.
   * @param {object} _message @returns {boolean}
   */
  send(_message) {
    return false;
  }

  /** Takes a message from the solver's side. @param {string} text */
  take(text) {
    /** @type {any} */
    let message;
    try {
      message = JSON.parse(text);
    } catch {
      this.events.error("Something came that is not JSON.");
      return;
    }
    switch (message.type) {
      case "frame": this.events.frame(message); break;
      case "state": this.events.state(message); break;
      case "hello": this.events.hello(message); break;
      case "done": this.answered(message.id)?.done(); break;
      case "error": {
        const asked = message.id === undefined ? undefined : this.answered(message.id);
        if (asked) asked.failed(new Error(message.message));
        else this.events.error(message.message);
      }
    }
  }

  /** Returns the request with an id, and closes it. @param {number} id */
  answered(id) {
    const asked = this.open.get(id);
    if (asked) clearTimeout(asked.timer);
    this.open.delete(id);
    return asked;
  }

  /**
   * Sends a request, after all earlier samples of the hand.
   * @param {{type: string, [field: string]: unknown}} message @returns {Promise<void>}
   */
  request(message) {
    this.flush();
    const id = this.nextId++;
    return new Promise((done, failed) => {
      if (!this.send({ ...message, id })) {
        failed(new Error("There is no connection."));
        return;
      }
      const tooLate = () => this.answered(id)?.failed(new Error("There was no answer."));
      const timer = window.setTimeout(tooLate, PATIENCE);
      this.open.set(id, { done, failed, timer });
    });
  }

  /**
   * Takes a sample of the hand. One that comes too early waits for its time or for the next one, but a change of `held` never
   * waits.
   * @param {Pose} pose @param {boolean} held @param {number} sent
   */
  hand(pose, held, sent) {
    const now = performance.now();
    const waiting = this.waiting;
    if (waiting && waiting.held !== held) this.flush();
    if (!this.waiting && (now - this.lastSample >= SAMPLE_SPACING || (waiting && waiting.held !== held))) {
      this.sendSample(pose, held, sent, now);
      return;
    }
    if (!this.waiting) setTimeout(() => this.flush(), 1);
    this.waiting = { pose, held, sent };
  }

  /** Sends the waiting sample. */
  flush() {
    const waiting = this.waiting;
    this.waiting = null;
    if (waiting) this.sendSample(waiting.pose, waiting.held, waiting.sent, performance.now());
  }

  /** @param {Pose} pose @param {boolean} held @param {number} sent @param {number} now */
  sendSample(pose, held, sent, now) {
    this.lastSample = now;
    this.send({ type: "hand", pose, held, sent });
  }

  /** Requests as many frames as the page can show. */
  askRate() {
    this.send({ type: "rate", value: document.hidden ? HIDDEN_RATE : RATE });
  }

  /** Fails all open requests. @param {string} why */
  giveUp(why) {
    for (const { failed, timer } of this.open.values()) {
      clearTimeout(timer);
      failed(new Error(why));
    }
    this.open.clear();
    this.waiting = null;
  }
}
