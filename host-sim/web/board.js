// A board over Web Serial, without any program in between: opens the port, identifies the board, sends it the scene, a mode and
// the hand, and turns its messages into those of the server.

import { BoardModel, BOX, BOX_PARAMETERS } from "./board-model.js";
import { Decoder, encode, REASONS } from "./frame.js";

/** Time after which a command is sent again (ms), and number of attempts (FRAME 7). */
const PATIENCE = 150;
const TRIES = 15;
/** Pause between two samples of a resting hand (ms): a board counts 20 ms without one as silence. */
const REST = 5;
/** Fraction of the line that samples may use; bytes of a sample. */
const SHARE = 0.6;
const SAMPLE_BYTES = 34;
/** Bits per byte on the line. */
const BITS = 10;
/** Poses and forces per second, on a fast and on a slow line (baud). */
const FAST = 400000;
const POSES = { fast: 125, slow: 50 };
const TURN = 2 * Math.PI;

/** @implements {Feed} */
export class Board {
  /** @param {FeedEvents} events @param {StateMessage | null} state what the page shows: the board gets that scene */
  constructor(events, state) {
    this.events = events;
    this.model = new BoardModel(state?.scene ?? BOX, state?.parameters ?? BOX_PARAMETERS);
    this.decoder = new Decoder((message) => this.take(message));
    /** @type {SerialPort | null} */
    this.port = null;
    /** @type {WritableStreamDefaultWriter<Uint8Array> | null} */
    this.writer = null;
    /** @type {ReadableStreamDefaultReader<Uint8Array> | null} */
    this.reader = null;
    this.baud = 0;
    this.sequence = 0;
    /** Resolves after all requests so far. @type {Promise<unknown>} */
    this.turn = Promise.resolve();
    /**
     * The command that waits for its answer, and the sequence numbers under which it was sent.
     * @type {{type: string, sent: number[], take: (message: Message) => void} | null}
     */
    this.asked = null;
    /** The newest hand. @type {{pose: Pose, held: boolean, sent: number}} */
    this.sample = { pose: this.model.scene.home, held: true, sent: -1 };
    this.lastSample = 0;
    this.timer = 0;
    this.gone = false;
  }

  /** Asks the reader for a port and sets up the board; rejects with a readable message. @param {number} baud */
  start(baud) {
    return this.inTurn(() => this.open(baud));
  }

  /**
   * Runs a task after all earlier requests: one command at a time is in progress.
   * @template T @param {() => Promise<T>} work @returns {Promise<T>}
   */
  inTurn(work) {
    const done = this.turn.then(work);
    this.turn = done.catch(() => {});
    return done;
  }

  /** @param {number} baud */
  async open(baud) {
    if (!navigator.serial) throw new Error("This browser has no Web Serial.");
    this.port = await navigator.serial.requestPort();
    this.baud = baud;
    await this.port.open({ baudRate: baud, bufferSize: 65536 });
    this.writer = this.port.writable?.getWriter() ?? null;
    this.port.addEventListener("disconnect", () => this.stop("The board was unplugged."));
    this.read();
    await this.writer?.write(Uint8Array.of(0));
    const info = await this.command({ type: "hello" }, "info");
    this.model.setInfo(info);
    this.events.hello(this.model.hello(info, baud));
    await this.command(this.model.sceneMessage());
    await this.command(this.modeMessage());
    this.events.state(this.model.state());
    this.events.connected(true);
    this.timer = window.setInterval(() => this.rest(), REST);
  }

  /** Reads until the port is closed. */
  async read() {
    try {
      while (this.port?.readable && !this.gone) {
        this.reader = this.port.readable.getReader();
        for (;;) {
          const { value, done } = await this.reader.read();
          if (done) break;
          this.decoder.push(value);
        }
        this.reader.releaseLock();
      }
    } catch (why) {
      if (!this.gone) this.stop(`The board cannot be read: ${/** @type {Error} */ (why).message}`);
    }
  }

  /** Ends the connection; the board then goes to zero force by itself. @param {string} [why] */
  async stop(why) {
    if (this.gone) return;
    this.gone = true;
    clearInterval(this.timer);
    this.events.connected(false);
    if (why) this.events.error(why);
    try {
      await this.reader?.cancel();
      this.writer?.releaseLock();
      await this.port?.close();
    } catch {
      // It was unplugged: there is nothing left to close.
    }
  }

  /** Sends one message; returns its sequence number. @param {{type: string, [field: string]: any}} message */
  write(message) {
    const sequence = this.sequence;
    this.sequence = (sequence + 1) & 0xff;
    const time = Math.round(performance.now() * 1000) % 2 ** 32;
    const bytes = encode({ ...message, sequence, time });
    this.writer?.write(bytes).catch((why) => this.stop(`The board cannot be written to: ${why.message}`));
    return sequence;
  }

  /**
   * Sends a command until it is answered; rejects with the reason of a refusal. A reply names the command that it answers
   * (FRAME 5.4): a reply to another command, or a late one, is ignored.
   * @param {{type: string, [field: string]: any}} message @param {string} [answer] type of the answer
   */
  async command(message, answer = "reply") {
    /** @type {number[]} */
    const sent = [];
    for (let attempt = 0; attempt < TRIES; attempt++) {
      /** @type {Message | null} */
      const reply = await new Promise((take) => {
        this.asked = { type: answer, sent, take };
        sent.push(this.write(message));
        setTimeout(() => take(null), PATIENCE);
      });
      this.asked = null;
      if (!reply) continue;
      if (reply.type !== "reply" || reply.reason === 0) return reply;
      const why = reply.allowed ? `${REASONS[reply.reason]}; allowed: ${reply.allowed}` : REASONS[reply.reason];
      throw new Error(`The board refuses the ${message.type}: ${why}.`);
    }
    throw new Error(`The board does not answer (${message.type}, ${this.baud} baud).`);
  }

  /** Takes a message from the board. @param {Message} message */
  take(message) {
    this.model.count(message);
    const { asked } = this;
    const isAnswer = message.type !== "reply" || asked?.sent.includes(message.command_sequence);
    if (asked?.type === message.type && isAnswer) asked.take(message);
    const frame = this.model.take(message, this.decoder.faults);
    if (frame && this.timer) this.events.frame(frame);
  }

  /**
   * Returns the board's mode: in time with its ticks, with as many poses and forces as line and screen can take.
   * @param {number} [evolution] by default the present one
   */
  modeMessage(evolution = this.model.info.evolution) {
    const { info } = this.model;
    const rate = Math.min(info.tick_rate, info.fastest_tick);
    const every = Math.max(1, Math.round(rate / (this.baud >= FAST ? POSES.fast : POSES.slow)));
    return {
      type: "mode", evolution, stepping: 0, axis_x: 0, axis_y: 1, events: 1, tick_rate: rate,
      pose_every: every, forces_every: every, health_every: 500,
    };
  }

  /** @param {Pose} pose @param {boolean} held @param {number} sent */
  hand(pose, held, sent) {
    const changed = held !== this.sample.held;
    this.sample = { pose, held, sent };
    const spacing = (1000 * SAMPLE_BYTES * BITS) / (SHARE * this.baud);
    if (changed || performance.now() - this.lastSample >= spacing) this.sendSample();
  }

  /** Sends samples of a resting hand, too. */
  rest() {
    if (performance.now() - this.lastSample >= 0.8 * REST) this.sendSample();
  }

  /** Sends the newest sample. */
  sendSample() {
    const { pose: [x, y, angle], held, sent } = this.sample;
    this.lastSample = performance.now();
    const turns = Math.round(angle / TURN);
    const sequence = this.write({ type: "hand", x, y, phi: angle - TURN * turns, turns, depth: 0, held: Number(held) });
    this.model.sent(sequence, this.sample.pose, this.lastSample, sent);
  }

  /** Handles those requests to a server that a board supports. @param {{type: string, [field: string]: any}} message */
  request(message) {
    return this.inTurn(() => this.carryOut(message));
  }

  /** @param {{type: string, [field: string]: any}} message */
  async carryOut(message) {
    switch (message.type) {
      case "set": {
        if (message.parameters.weight !== undefined) throw new Error("A board keeps the weight of its scene.");
        const parameters = this.model.changed(message.parameters);
        await this.command({
          type: "parameters", k_h: parameters.stiffness_translation, k_theta: parameters.stiffness_rotation,
          mu_s: parameters.static, mu_d: parameters.dynamic,
          has_memory: Number(parameters.memory !== null), memory: parameters.memory ?? 0,
        });
        this.model.setParameters(parameters);
        break;
      }
      case "reset":
        this.sample = { pose: this.model.scene.home, held: true, sent: -1 };
        await this.command({ type: "reset", what: 0 });
        this.model.reset();
        break;
      case "evolution":
        await this.command(this.modeMessage(message.value === "path" ? 0 : 1));
        this.model.info.evolution = message.value === "path" ? 0 : 1;
        break;
      default:
        throw new Error("A board by Web Serial cannot do this: it needs the program.");
    }
    this.events.state(this.model.state());
  }
}
