// Slips and slides as sound, slips also as vibration of a phone and of gamepads. A slip is a burst of noise whose loudness
// grows with its length; sliding is soft noise whose loudness grows with its speed.

import { bodySize } from "./view.js";

/** Lengths below this fraction of the body's size are rounding, not motion. */
const NOISE = 1e-6;
/** Length of a slip (body sizes) and speed of a slide (body sizes per second) at which the loudness reaches its maximum. */
const LONGEST = 0.1;
const FASTEST = 4;
/** Overall loudness, and that of the loudest slide relative to the loudest slip. */
const VOLUME = 0.6;
const SOFT = 0.25;
/** Time constant of a burst's decay: for a barely audible slip, and the increase to the loudest (s). */
const DECAY = 0.005;
const LONGER = 0.02;
/** Centre frequency of a burst: for a barely audible slip, and for the loudest; of a slide (Hz). */
const HIGH = 3200;
const LOW = 700;
const RUB = 1500;
/** Length of a burst in time constants: then it is 60 dB lower. */
const ENDS = 7;
/** Time constant of a slide's loudness; time without a frame after which a slide ends (s). */
const EASE = 0.02;
const SILENCE = 0.12;
/** The slips of a frame are spread over the time since the previous frame, but at most over this (s). */
const SPREAD = 0.05;
/** Duration of the vibration for the smallest slip, and the increase to the largest (ms). */
const BUZZ = 8;
const MORE = 40;

/**
 * Starts, or ends what is running; the button shows which.
 * @param {Felt | null} felt @param {HTMLElement} button @returns {Felt | null}
 */
export function toggle(felt, button) {
  button.setAttribute("aria-pressed", String(felt === null));
  felt?.end();
  if (felt) return null;
  const begun = new Felt();
  begun.resume();
  return begun;
}

export class Felt {
  /** @param {BaseAudioContext} context */
  constructor(context = new AudioContext()) {
    this.context = context;
    /** Number of the last slip that was played; null: earlier slips are skipped. @type {number | null} */
    this.played = null;
    /** @type {FrameMessage | null} */
    this.before = null;
    this.cameAt = 0;
    const out = new DynamicsCompressorNode(context);
    out.connect(context.destination);
    this.volume = new GainNode(context, { gain: VOLUME });
    this.volume.connect(out);
    this.hiss = whiteNoise(context);
    this.rub = new GainNode(context, { gain: 0 });
    const source = new AudioBufferSourceNode(context, { buffer: this.hiss, loop: true });
    source.connect(new BiquadFilterNode(context, { type: "bandpass", frequency: RUB, Q: 0.8 })).connect(this.rub);
    this.rub.connect(this.volume);
    source.start();
  }

  /** Starts, if the browser made it wait for a press. */
  resume() {
    if (this.context instanceof AudioContext && this.context.state !== "running") this.context.resume().catch(() => {});
  }

  /** Ends all sound. */
  end() {
    if (this.context instanceof AudioContext) this.context.close().catch(() => {});
    navigator.vibrate?.(0);
  }

  /** Takes a new frame. @param {FrameMessage} message @param {Scene} scene */
  take(message, scene) {
    const size = bodySize(scene);
    const now = this.context.currentTime;
    const before = this.before;
    const isAnew = before !== null && message.frame.t < before.frame.t;
    this.slide(before && !isAnew ? slidingSpeed(before.frame, message.frame, size) / size : 0);
    const last = isAnew ? 0 : this.played ?? Infinity;
    const from = before && !isAnew ? before.frame.t : message.frame.t;
    const span = Math.max(message.frame.t - from, 1e-9);
    const wait = Math.min(SPREAD, now - this.cameAt);
    let loudest = 0;
    for (const { n, t, length } of message.slips) {
      const loudness = loudnessOf(length / size);
      if (n <= last || loudness === 0) continue;
      this.burst(now + wait * Math.min(1, Math.max(0, (t - from) / span)), loudness);
      loudest = Math.max(loudest, loudness);
    }
    if (loudest > 0) this.shake(loudest);
    this.played = message.slips.at(-1)?.n ?? 0;
    this.before = message;
    this.cameAt = now;
  }

  /** Plays the sound of a slip. @param {number} at s @param {number} loudness 0 to 1 */
  burst(at, loudness) {
    this.resume();
    const { context } = this;
    const decay = DECAY + LONGER * loudness;
    const source = new AudioBufferSourceNode(context, { buffer: this.hiss });
    const band = new BiquadFilterNode(context, { type: "bandpass", frequency: HIGH * (LOW / HIGH) ** loudness, Q: 1.5 });
    const gain = new GainNode(context, { gain: 0 });
    gain.gain.setValueAtTime(loudness, at);
    gain.gain.setTargetAtTime(0, at, decay);
    source.connect(band).connect(gain).connect(this.volume);
    source.start(at, Math.random() * (this.hiss.duration - 1));
    source.stop(at + ENDS * decay);
  }

  /** Plays the sound of sliding. @param {number} speed body sizes a second */
  slide(speed) {
    const { gain } = this.rub;
    const now = this.context.currentTime;
    gain.cancelScheduledValues(now);
    gain.setTargetAtTime(SOFT * Math.min(1, Math.sqrt(speed / FASTEST)), now, EASE);
    gain.setTargetAtTime(0, now + SILENCE, EASE);
  }

  /** Makes all devices vibrate that can. @param {number} loudness 0 to 1 */
  shake(loudness) {
    const duration = Math.round(BUZZ + MORE * loudness);
    navigator.vibrate?.(duration);
    for (const pad of navigator.getGamepads?.() ?? []) {
      const strength = { duration, weakMagnitude: loudness, strongMagnitude: loudness };
      pad?.vibrationActuator?.playEffect("dual-rumble", strength).catch(() => {});
    }
  }
}

/**
 * Returns the loudness of a slip, as an amplitude. The force drops by (mu_s - mu_d) N whatever the length, so the energy
 * released by a slip grows in proportion to its length, and the amplitude as the square root of that.
 * @param {number} length body sizes
 */
export const loudnessOf = (length) => (length > NOISE ? Math.min(1, Math.sqrt(length / LONGEST)) : 0);

/**
 * Returns the largest speed at which a contact slides between two frames (m/s): from the displacement there of the body, which
 * rotates about its origin.
 * @param {TraceFrame} before @param {TraceFrame} after @param {number} size of the body (m)
 */
function slidingSpeed(before, after, size) {
  const time = after.t - before.t;
  if (time <= 0) return 0;
  const [dx, dy, turn] = after.pose.map((value, i) => value - before.pose[i]);
  const lengths = after.contacts.filter(({ sliding }) => sliding !== 0).map(({ point: [x, y] }) =>
    Math.hypot(dx - turn * (y - after.pose[1]), dy + turn * (x - after.pose[0])));
  const length = Math.max(0, ...lengths);
  return length > NOISE * size ? length / time : 0;
}

/** Returns two seconds of noise. @param {BaseAudioContext} context */
function whiteNoise(context) {
  const buffer = new AudioBuffer({ length: 2 * context.sampleRate, sampleRate: context.sampleRate });
  const samples = buffer.getChannelData(0);
  for (let i = 0; i < samples.length; i++) samples[i] = 2 * Math.random() - 1;
  return buffer;
}
