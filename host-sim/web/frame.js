// The wire between a board and its client, as specified in core/wire/FRAME.md: encodes and decodes messages. A message is an object
// with the field names of that document; lists are arrays of numbers or of arrays. No state, no hardware.

/** @typedef {{count: string, item: string, shape: string}} List */
/** @typedef {{code: number, shape: string, fields: string[], lists: List[], text: string | null}} Layout */

/** Version of the wire format. */
const VERSION = 4;
/** Contact states in the order of their codes. */
export const STATES = ["non-contact", "single-vertex", "edge", "two-vertex", "corner", "locked"];
/** What limited an answer, in the order of its codes. */
const STATUS = [
  "ok", "event-limit", "iteration-limit", "ambiguous", "saturated", "held-last", "jammed", "twist", "behind",
];
/** Returns the name of a status; an unknown one may be out of balance (FRAME 5.1). @param {number} code */
export const statusName = (code) => STATUS[code] ?? "ambiguous";
/** Reasons for refusing a command, in the order of their codes. */
export const REASONS = [
  "done", "version", "unknown-type", "length", "code", "number", "not-passive", "unsupported", "not-now",
];

/** Bytes before the payload: version, type, sequence, time. */
const HEAD = 7;
/** Bytes of the checksum after the payload. */
const CHECK = 4;
/** Longest frame that a client accepts before COBS (bytes); a board sends shorter ones. */
const LONGEST = 1024;

/** Letters of a shape: B u8, b i8, F a flag, H u16, I u32, i i32, f f32. */
const SIZES = /** @type {{[letter: string]: number}} */ ({ B: 1, b: 1, F: 1, H: 2, I: 4, i: 4, f: 4 });

const PARAMETERS_SHAPE = "ffffFf";
const PARAMETERS = "k_h k_theta mu_s mu_d has_memory memory";
const MODE_SHAPE = "BBBBFHHHH";
const MODE = "evolution stepping axis_x axis_y events tick_rate pose_every forces_every health_every";
const KNOB_SHAPE = "fffIFfffFf";
const KNOB = "origin_x origin_y radius counts_per_turn encoder_reversed torque_constant full_current torque_limit motor_reversed damping";
const FAULTS = "too_long cobs crc version unknown_type length value";

/**
 * Returns one row of the table of types.
 * @param {number} code @param {string} shape @param {string} fields @param {List[]} lists @param {string | null} text
 * @returns {Layout}
 */
const layout = (code, shape, fields, lists = [], text = null) =>
  ({ code, shape, fields: fields.split(" ").filter(Boolean), lists, text });

/** Every type of FRAME 3, by name. @type {{[name: string]: Layout}} */
const LAYOUTS = {
  hand: layout(0x01, "fffifF", "x y phi turns depth held"),
  tracker: layout(0x02, "fffffffF", "x y z qx qy qz qw held"),
  parameters: layout(0x03, PARAMETERS_SHAPE, PARAMETERS),
  scene: layout(0x04, "BBBBFfffffffff",
    "vertices surfaces obstacles corners has_point start_x start_y start_theta weight point_x point_y reach k_h k_theta",
    [
      { count: "vertices", item: "vertex", shape: "ff" }, { count: "surfaces", item: "surface", shape: "fffffFf" },
      { count: "obstacles", item: "obstacle", shape: "BffFf" }, { count: "corners", item: "corner", shape: "ff" },
    ]),
  mode: layout(0x05, MODE_SHAPE, MODE),
  hello: layout(0x06, "", ""),
  ping: layout(0x07, "", ""),
  reset: layout(0x08, "B", "what"),
  knob: layout(0x09, KNOB_SHAPE, KNOB),
  "ask-knob": layout(0x0a, "", ""),
  pose: layout(0x80, "ffffBHB", "x y theta depth flags events sample"),
  forces: layout(0x90, "ffffffiB", "wrench_x wrench_y wrench_m hand_x hand_y hand_m turns contacts",
    [{ count: "contacts", item: "contact", shape: "BBBffffffb" }]),
  events: layout(0x91, "IfB", "slips longest_slip events", [{ count: "events", item: "event", shape: "B" }]),
  reply: layout(0x92, "BBBBBBff", "command command_sequence reason subject index index2 value limit", [], "allowed"),
  info: layout(0x93, "BBBBBBBFHHIff" + PARAMETERS_SHAPE + MODE_SHAPE,
    "major minor patch number vertices surfaces corners actuators longest_frame fastest_tick budget stiffest_k_h "
      + `stiffest_k_theta ${PARAMETERS} ${MODE}`,
    [], "name"),
  health: layout(0x94, "B" + "I".repeat(15),
    `drive ticks missed_ticks samples late_samples lost_frames unsent worst_step worst_tick ${FAULTS}`),
  pong: layout(0x95, "BI", "ping_sequence ping_time"),
  "knob-info": layout(0x96, "B" + KNOB_SHAPE, `source ${KNOB}`),
};

/** Largest codes of fields, by "type.field". @type {{[key: string]: number}} */
const CODES = {
  "mode.evolution": 1, "mode.stepping": 1, "info.evolution": 1, "info.stepping": 1, "info.number": 1,
  "reset.what": 1, "reply.reason": 8, "health.drive": 2, "knob-info.source": 2, "events.event": 10, "forces.contacts": 8, "events.events": 16,
  "pose.events": 0x7ff,
};

/** The axes of a mode that have a meaning. */
const AXES = [0, 1, 2, 4, 5, 6];

/** The reason why a frame is not accepted, in the terms of FRAME 6. */
export class Fault extends Error {
  /** @param {"too-long" | "cobs" | "crc" | "version" | "unknown-type" | "length" | "value"} why */
  constructor(why) {
    super(why);
    this.why = why;
  }
}

/** Table of the CRC. */
const CRC_TABLE = Uint32Array.from({ length: 256 }, (_, byte) => {
  let value = byte;
  for (let bit = 0; bit < 8; bit++) value = value & 1 ? (value >>> 1) ^ 0xedb88320 : value >>> 1;
  return value >>> 0;
});

/** Returns the CRC-32/ISO-HDLC (FRAME 2). @param {Uint8Array} bytes */
export function crc32(bytes) {
  let crc = 0xffffffff;
  for (const byte of bytes) crc = (crc >>> 8) ^ CRC_TABLE[(crc ^ byte) & 0xff];
  return ~crc >>> 0;
}

/** Encodes with COBS: returns bytes without a 0, followed by the delimiter (FRAME 2). @param {Uint8Array} bytes */
export function stuff(bytes) {
  const out = [0];
  let mark = 0;
  for (const byte of bytes) {
    if (out.length - mark === 255) {
      out[mark] = 255;
      mark = out.push(0) - 1;
    }
    if (byte !== 0) {
      out.push(byte);
      continue;
    }
    out[mark] = out.length - mark;
    mark = out.push(0) - 1;
  }
  out[mark] = out.length - mark;
  out.push(0);
  return Uint8Array.from(out);
}

/** Decodes COBS bytes between two delimiters. @param {Uint8Array} bytes */
export function unstuff(bytes) {
  const out = new Uint8Array(bytes.length);
  let length = 0;
  for (let at = 0; at < bytes.length;) {
    const code = bytes[at];
    if (code === 0 || at + code > bytes.length) throw new Fault("cobs");
    out.set(bytes.subarray(at + 1, at + code), length);
    length += code - 1;
    at += code;
    if (code < 255 && at < bytes.length) out[length++] = 0;
  }
  return out.subarray(0, length);
}

/** Returns the number of bytes of a shape. @param {string} shape */
const sizeOf = (shape) => [...shape].reduce((sum, letter) => sum + SIZES[letter], 0);

/** Reads numbers one after the other. */
class Reader {
  /** @param {Uint8Array} bytes */
  constructor(bytes) {
    this.view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
    this.at = 0;
  }

  /** Reads the next number; a flag must be 0 or 1. @param {string} letter */
  field(letter) {
    const value = this.one(letter);
    if (letter === "F" && value > 1) throw new Fault("value");
    return value;
  }

  /** Reads the next number. @param {string} letter */
  one(letter) {
    const at = this.at;
    this.at += SIZES[letter];
    switch (letter) {
      case "H": return this.view.getUint16(at, true);
      case "I": return this.view.getUint32(at, true);
      case "i": return this.view.getInt32(at, true);
      case "f": return this.view.getFloat32(at, true);
      case "b": return this.view.getInt8(at);
      default: return this.view.getUint8(at);
    }
  }
}

/**
 * Writes a number at an offset, as the letter of a shape says.
 * @param {DataView} view @param {number} at @param {string} letter @param {number} value
 */
function put(view, at, letter, value) {
  switch (letter) {
    case "H": view.setUint16(at, value, true); break;
    case "I": view.setUint32(at, value, true); break;
    case "i": view.setInt32(at, value, true); break;
    case "f": view.setFloat32(at, value, true); break;
    case "b": view.setInt8(at, value); break;
    default: view.setUint8(at, value);
  }
  return at + SIZES[letter];
}

/** Encodes a message as a frame, including COBS and delimiter. @param {Message} message */
export function encode(message) {
  const row = LAYOUTS[message.type];
  const values = { ...message };
  for (const { count, item } of row.lists) values[count] = message[item].length;
  let code = row.code;
  if (message.type === "pose") {
    code |= message.state;
    values.flags = message.status | (message.held << 4) | (message.force_off << 5);
    values.events |= message.turns << 13;
  }
  const text = row.text ? String(message[row.text]) : "";
  const tail = row.lists.reduce((sum, { count, shape }) => sum + values[count] * sizeOf(shape), text.length);
  const bytes = new Uint8Array(HEAD + sizeOf(row.shape) + tail + CHECK);
  const view = new DataView(bytes.buffer);
  bytes[0] = VERSION;
  bytes[1] = code;
  bytes[2] = message.sequence;
  view.setUint32(3, message.time, true);
  let at = HEAD;
  row.fields.forEach((field, i) => { at = put(view, at, row.shape[i], values[field]); });
  for (const { item, shape } of row.lists) {
    for (const one of message[item]) [one].flat().forEach((value, i) => { at = put(view, at, shape[i], value); });
  }
  for (const letter of text) bytes[at++] = letter.charCodeAt(0);
  view.setUint32(at, crc32(bytes.subarray(0, at)), true);
  return stuff(bytes);
}

/**
 * Decodes the message between two delimiters; throws a Fault, the first one in the order of FRAME 6.
 * @param {Uint8Array} bytes @returns {Message}
 */
export function decode(bytes) {
  if (bytes.length > LONGEST) throw new Fault("too-long");
  const frame = unstuff(bytes);
  const end = frame.length - CHECK;
  if (end < 0) throw new Fault("crc");
  const view = new DataView(frame.buffer, frame.byteOffset, frame.length);
  if (view.getUint32(end, true) !== crc32(frame.subarray(0, end))) throw new Fault("crc");
  if (end < 1) throw new Fault("length");
  if (frame[0] !== VERSION) throw new Fault("version");
  if (end < HEAD) throw new Fault("length");
  const code = frame[1];
  const family = code >= 0x80 && code <= 0x85 ? 0x80 : code;
  const entry = Object.entries(LAYOUTS).find(([, row]) => row.code === family);
  if (!entry) throw new Fault("unknown-type");
  const message = /** @type {Message} */ ({ type: entry[0], sequence: frame[2], time: view.getUint32(3, true) });
  readPayload(message, entry[1], frame.subarray(HEAD, end));
  if (family === 0x80) readFlags(message, code);
  checkCodes(message);
  return message;
}

/**
 * Reads the fields of a payload into the message.
 * @param {Message} message @param {Layout} row @param {Uint8Array} payload
 */
function readPayload(message, row, payload) {
  const fixed = sizeOf(row.shape);
  if (payload.length < fixed) throw new Fault("length");
  const reader = new Reader(payload);
  row.fields.forEach((field, i) => {
    message[field] = reader.field(row.shape[i]);
  });
  const tail = row.lists.reduce((sum, { count, shape }) => sum + message[count] * sizeOf(shape), fixed);
  if (row.text === null && payload.length !== tail) throw new Fault("length");
  for (const { count, item, shape } of row.lists) {
    const many = Array.from({ length: message[count] }, () => [...shape].map((letter) => reader.field(letter)));
    message[item] = shape.length === 1 ? many.flat() : many;
  }
  if (row.text === null) return;
  const text = payload.subarray(fixed);
  if (text.some((byte) => byte < 0x20 || byte > 0x7e)) throw new Fault("value");
  message[row.text] = String.fromCharCode(...text);
}

/** Splits the flags of a pose (FRAME 5.1). @param {Message} message @param {number} code its type */
function readFlags(message, code) {
  const { flags, events } = message;
  if (flags > 63) throw new Fault("value");
  delete message.flags;
  message.state = code & 7;
  message.status = flags & 15;
  message.held = (flags >> 4) & 1;
  message.force_off = (flags >> 5) & 1;
  message.turns = events >> 13;
  message.events = events & 0x1fff;
}

/** Refuses an undefined code. @param {Message} message */
function checkCodes(message) {
  for (const [field, value] of Object.entries(message)) {
    const greatest = CODES[`${message.type}.${field}`];
    if (greatest !== undefined && [value].flat().some((code) => code > greatest)) throw new Fault("value");
  }
  if (message.axis_x !== undefined && !(AXES.includes(message.axis_x) && AXES.includes(message.axis_y)
    && message.axis_x % 4 !== message.axis_y % 4)) throw new Fault("value");
  /** @type {number[][]} */
  const contacts = message.type === "forces" ? message.contact : [];
  // A surface has no corner.
  if (contacts.some((one) => Math.abs(one[9]) > 1 || (one[0] >= 128 && one[1] === 255))) throw new Fault("value");
}

/** Collects incoming bytes and passes on every message; counts frames that are not accepted. */
export class Decoder {
  /** @param {(message: Message) => void} take */
  constructor(take) {
    this.take = take;
    this.bytes = new Uint8Array(LONGEST + 1);
    this.length = 0;
    /** Number of frames that were not accepted, by fault. @type {{[why: string]: number}} */
    this.faults = {};
  }

  /** Takes any number of bytes. @param {Uint8Array} bytes */
  push(bytes) {
    for (const byte of bytes) {
      if (byte !== 0) {
        if (this.length <= LONGEST) this.bytes[this.length++] = byte;
        continue;
      }
      if (this.length > 0) this.end();
      this.length = 0;
    }
  }

  /** Ends a frame at a delimiter. */
  end() {
    try {
      this.take(decode(this.bytes.subarray(0, this.length)));
    } catch (fault) {
      if (!(fault instanceof Fault)) throw fault;
      this.faults[fault.why] = (this.faults[fault.why] ?? 0) + 1;
    }
  }
}
