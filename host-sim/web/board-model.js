// Combines the messages of a board: poses, forces, events and health become the frame and state messages that the page shows.

import { EVENTS } from "./events.js";
import { STATES, statusName } from "./frame.js";

const TURN = 2 * Math.PI;
/** Largest number of slips in a frame message. */
const SLIPS = 32;
/** Number of poses over which latencies are averaged. */
const SMOOTH = 50;
/** Number types in the order of their codes. */
const NUMBERS = ["f32", "fixed"];

/** The scene of a board after power-up: a box on a floor. @type {Scene} */
export const BOX = {
  title: "box on a floor", body: [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
  surfaces: [{ name: "floor", normal: [0, 1], offset: 0 }], weight: 0, grasp: [0, 0.02], reach: 0.02,
  start: [0, 0.03, 0], home: [0, 0.05, 0],
};
/** Its parameters. @type {SceneParameters} */
export const BOX_PARAMETERS = {
  stiffness_translation: 500, stiffness_rotation: 0.5, static: 0.5, dynamic: 0.3, memory: null, weight: 0,
};

/**
 * Returns true if a board has room for a scene, and for the frame that transfers it (FRAME 4.4).
 * @param {Scene} scene @param {Message} info
 */
function fits({ body, surfaces }, info) {
  return body.length <= info.vertices && surfaces.length <= info.surfaces
    && 50 + 8 * body.length + 25 * surfaces.length <= info.longest_frame;
}

/**
 * Returns the first memory length that is given; null counts as one: the default length of a scene.
 * @param {(number | null | undefined)[]} all
 */
const firstGiven = (...all) => all.find((memory) => memory !== undefined) ?? null;

/** Values that are counted from the start pose on. */
const newRun = () => ({
  /** The board's clock (µs), and the seconds since the start. */
  clock: NaN,
  time: 0,
  turns: 0,
  /** State of the previous pose. @type {string | null} */
  before: null,
  /** Events and slips since the last pose. @type {string[]} */
  happened: [],
  slipped: 0,
  /** @type {Slip[]} */
  slips: [],
  /** @type {number[][]} */
  strip: [],
  /** @type {Counts} */
  counts: { ticks: 0, missed: 0, slips: 0, transitions: {}, events: {} },
  /** The newest ones. @type {Message | null} */
  forces: null,
});

export class BoardModel {
  /** @param {Scene} scene @param {SceneParameters} parameters */
  constructor(scene, parameters) {
    this.scene = scene;
    this.parameters = parameters;
    /** @type {any} */
    this.info = { number: 0, evolution: 0, name: "" };
    /** @type {Message | null} */
    this.health = null;
    /** Samples by their sequence number. @type {({pose: Pose, at: number, sent: number} | null)[]} */
    this.samples = Array(256).fill(null);
    this.latency = NaN;
    this.lost = 0;
    this.sequence = -1;
    this.poses = 0;
    this.rate = 0;
    this.rateSince = performance.now();
    this.run = newRun();
  }

  /**
   * Returns the parameters with a change; a friction applies to all surfaces. Throws if surfaces would keep their own friction:
   * a board has one pair for all.
   * @param {Partial<SceneParameters>} change @returns {SceneParameters}
   */
  changed(change) {
    const parameters = { ...this.parameters, ...change };
    const { scene: { surfaces } } = this;
    const frictions = surfaces.map((own) => ({
      static: change.static ?? own.static ?? parameters.static,
      dynamic: change.dynamic ?? own.dynamic ?? parameters.dynamic,
      memory: firstGiven(change.memory, own.memory, parameters.memory),
    }));
    const [first] = frictions;
    const isOther = (/** @type {typeof first} */ other) =>
      other.static !== first.static || other.dynamic !== first.dynamic || other.memory !== first.memory;
    if (frictions.some(isOther)) {
      throw new Error(
        "The surfaces have frictions of their own; allowed on a board: the same static and dynamic one and the same "
          + "memory length for all.",
      );
    }
    return { ...parameters, ...first };
  }

  /** Takes the parameters of the board, with the same friction for all surfaces. @param {SceneParameters} parameters */
  setParameters(parameters) {
    const { static: mu_s, dynamic: mu_d, memory } = parameters;
    const surfaces = this.scene.surfaces.map((surface) => ({ ...surface, static: mu_s, dynamic: mu_d, memory }));
    this.parameters = parameters;
    this.scene = { ...this.scene, surfaces };
  }

  /** Restarts, with the body at the start pose. */
  reset() {
    this.run = newRun();
  }

  /**
   * Takes the board's description. If the board has no room for the scene, the box replaces it; throws if that does not fit
   * either.
   * @param {Message} info
   */
  setInfo(info) {
    this.info = info;
    if (fits(this.scene, info)) return;
    const { vertices, surfaces } = info;
    if (!fits(BOX, info)) throw new Error(`The board has too little room: vertices ${vertices}, surfaces ${surfaces}.`);
    this.scene = BOX;
    this.parameters = BOX_PARAMETERS;
  }

  /** Returns the server's hello message. @param {Message} info @param {number} baud @returns {HelloMessage} */
  hello(info, baud) {
    return {
      type: "hello", version: 1, you: 1, program: `firmware ${info.major}.${info.minor}.${info.patch}`,
      scenes: [this.scene.title],
      source: {
        kind: "board", name: info.name, number: NUMBERS[info.number], where: `Web Serial, ${baud} baud`,
        emulated: false,
      },
    };
  }

  /** Returns the server's state message. @returns {StateMessage} */
  state() {
    return {
      type: "state", scene: this.scene, parameters: this.parameters, number: NUMBERS[this.info.number],
      evolution: this.info.evolution === 0 ? "path" : "frame", paused: false, speed: 1, recording: null,
      recording_file: null, recorded: null, replay: null, hand: { by: "page", client: 1 }, clients: 1,
    };
  }

  /** Returns the scene as a message to the board. */
  sceneMessage() {
    const { scene, parameters } = this;
    const [start_x, start_y, start_theta] = scene.start;
    const [point_x, point_y] = scene.grasp ?? [0, 0];
    return {
      type: "scene", has_point: scene.grasp ? 1 : 0, start_x, start_y, start_theta, weight: scene.weight,
      point_x, point_y, reach: scene.reach,
      k_h: parameters.stiffness_translation, k_theta: parameters.stiffness_rotation, vertex: scene.body, obstacle: [], corner: [],
      surface: scene.surfaces.map(({ normal, offset, static: mus, dynamic: mud, memory: own }) => {
        const memory = firstGiven(own, parameters.memory);
        return [
          ...normal, offset, mus ?? parameters.static, mud ?? parameters.dynamic, Number(memory !== null), memory ?? 0,
        ];
      }),
    };
  }

  /** Notes a sample sent to the board. @param {number} sequence @param {Pose} pose @param {number} at @param {number} sent */
  sent(sequence, pose, at, sent) {
    this.samples[sequence] = { pose, at, sent };
  }

  /** Counts lost frames by their sequence numbers. @param {Message} message */
  count({ sequence }) {
    if (this.sequence >= 0) this.lost += (sequence - this.sequence - 1) & 0xff;
    this.sequence = sequence;
  }

  /**
   * Takes a message; a pose returns a frame.
   * @param {Message} message @param {{[why: string]: number}} faults @returns {FrameMessage | null}
   */
  take(message, faults) {
    switch (message.type) {
      case "forces": this.takeForces(message); return null;
      case "events": this.takeEvents(message); return null;
      case "health": this.health = message; return null;
      case "pose": return this.frame(message, faults);
      default: return null;
    }
  }

  /** @param {Message} message */
  takeForces(message) {
    const { run } = this;
    run.forces = message;
    const row = [this.since(message.time), ...this.scene.surfaces.flatMap(() => [0, 0])];
    for (const contact of message.contact) {
      const [, , surface, , , , , normal, friction] = contact;
      row[1 + 2 * surface] += normal;
      row[2 + 2 * surface] += friction;
    }
    run.strip.push(row);
  }

  /** @param {Message} message */
  takeEvents(message) {
    const { happened, counts, forces, slips } = this.run;
    for (const code of message.event) {
      const name = EVENTS[code];
      happened.push(name);
      counts.events[name] = (counts.events[name] ?? 0) + 1;
    }
    counts.slips += message.slips;
    this.run.slipped += message.slips;
    const [contact] = forces?.contact ?? [];
    if (message.slips === 0 || !contact) return;
    slips.push({
      n: counts.slips, t: this.since(message.time), point: [contact[5], contact[6]], direction: [contact[3], contact[4]],
      length: message.longest_slip,
    });
    if (slips.length > SLIPS) slips.shift();
  }

  /** Returns the seconds since the first message, by the board's clock, which wraps. @param {number} time µs */
  since(time) {
    const { run } = this;
    if (Number.isNaN(run.clock)) run.clock = time;
    const step = (time - run.clock) | 0;
    run.time += step * 1e-6;
    run.clock = time;
    return run.time;
  }

  /**
   * Returns a contact: of a vertex on a surface, as the scenes that the page sends have no obstacles.
   * @param {number[]} contact @returns {Contact}
   */
  contact([vertex, , surface, nx, ny, x, y, normal, friction, sliding]) {
    const { name = "" } = this.scene.surfaces[surface] ?? {};
    return { vertex, surface: name, direction: [nx, ny], point: [x, y], normal, friction, sliding };
  }

  /**
   * Returns the frame message of a pose.
   * @param {Message} pose @param {{[why: string]: number}} faults @returns {FrameMessage}
   */
  frame(pose, faults) {
    const { run } = this;
    const t = this.since(pose.time);
    this.unwrap(pose.turns);
    const sample = this.samples[pose.sample];
    if (sample && statusName(pose.status) !== "held-last") this.measure(performance.now() - sample.at);
    const theta = pose.theta + TURN * run.turns;
    const at = /** @type {Pose} */ ([pose.x, pose.y, theta]);
    const hand = sample?.pose ?? this.scene.home;
    const state = /** @type {StateName} */ (STATES[pose.state]);
    this.transition(state);
    const { holding, ghost } = this.springs(at, hand, pose.held === 1);
    const { forces } = run;
    const touching = state === "non-contact" ? [] : forces?.contact ?? [];
    const contacts = touching.map((/** @type {number[]} */ contact) => this.contact(contact));
    /** @type {FrameMessage} */
    const message = {
      type: "frame", tick: this.health?.ticks ?? 0, skipped: 0, holding, ghost,
      echo: sample && sample.sent >= 0 ? sample.sent : null,
      frame: {
        t, hand, held: pose.held === 1, pose: at, depth: pose.depth, state, contacts,
        wrench: forces ? [forces.wrench_x, forces.wrench_y, forces.wrench_m] : [0, 0, 0],
        slips: run.slipped, events: run.happened, status: statusName(pose.status),
      },
      reference: null, counts: run.counts, slips: run.slips, strip: run.strip,
      step: this.health ? { median: null, worst: this.health.worst_step * 1e-9 } : null,
      board: this.healthMessage(faults),
    };
    [run.happened, run.strip, run.slipped] = [[], [], 0];
    return message;
  }

  /** Sets the number of whole turns that is nearest to the last one (FRAME 5.1). @param {number} turns modulo 8 */
  unwrap(turns) {
    const step = (turns - this.run.turns) & 7;
    this.run.turns += step > 4 ? step - 8 : step;
  }

  /** @param {number} latency ms */
  measure(latency) {
    this.latency = Number.isNaN(this.latency) ? latency : this.latency + (latency - this.latency) / SMOOTH;
    this.poses++;
    const now = performance.now();
    if (now - this.rateSince < 1000) return;
    this.rate = (1000 * this.poses) / (now - this.rateSince);
    this.poses = 0;
    this.rateSince = now;
  }

  /** @param {string} state */
  transition(state) {
    const { before, counts: { transitions } } = this.run;
    if (before !== null && before !== state) {
      const key = `${before}>${state}`;
      transitions[key] = (transitions[key] ?? 0) + 1;
    }
    this.run.before = state;
  }

  /**
   * Returns holding point and free pose, from the wrench: G = p_h - F / k_h, and the twist M / k_theta.
   * @param {Pose} pose @param {Pose} hand @param {boolean} held @returns {{holding: Vec | null, ghost: Pose | null}}
   */
  springs(pose, hand, held) {
    const { forces } = this.run;
    if (!held || !forces) return { holding: null, ghost: null };
    const { stiffness_translation: kh, stiffness_rotation: kt } = this.parameters;
    const holding = /** @type {Vec} */ ([hand[0] - forces.wrench_x / kh, hand[1] - forces.wrench_y / kh]);
    const twist = kt > 0 ? forces.wrench_m / kt : 0;
    const c = Math.cos(twist), s = Math.sin(twist);
    const [gx, gy] = [holding[0] - pose[0], holding[1] - pose[1]];
    return { holding, ghost: [hand[0] - (c * gx - s * gy), hand[1] - (s * gx + c * gy), pose[2] + twist] };
  }

  /** @param {{[why: string]: number}} faults @returns {BoardHealth} */
  healthMessage(faults) {
    const { health, run: { counts } } = this;
    const garbled = Object.values(faults).reduce((sum, count) => sum + count, 0);
    const kinds = ["too_long", "cobs", "crc", "version", "unknown_type", "length", "value"];
    const refused = health ? kinds.reduce((sum, kind) => sum + health[kind], 0) : 0;
    counts.ticks = health?.ticks ?? 0;
    counts.missed = health?.missed_ticks ?? 0;
    return {
      rate: this.rate, latency: Number.isNaN(this.latency) ? null : this.latency * 1e-3,
      late: health?.late_samples ?? 0, lost: this.lost + (health?.lost_frames ?? 0),
      missed: health?.missed_ticks ?? 0, faults: garbled + refused, connected: true,
    };
  }
}
