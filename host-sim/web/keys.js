// The keyboard as the hand: pressed keys move and turn it smoothly. Other keys are the page's commands.

import { bodySize } from "./view.js";

/** Speed in body sizes per second, and angular speed (rad/s); factor with shift. */
const SPEED = 0.7;
const TURN = 1.0;
const FINE = 0.1;
/** Time between two samples (ms). */
const PERIOD = 4;
/** Longest time step of a sample (ms): after a stall the hand does not leap. */
const LONGEST = 40;

/** Effect of a key: x, y, turn. @type {{[code: string]: [number, number, number]}} */
const MOVES = {
  ArrowLeft: [-1, 0, 0], ArrowRight: [1, 0, 0], ArrowUp: [0, 1, 0], ArrowDown: [0, -1, 0],
  KeyA: [-1, 0, 0], KeyD: [1, 0, 0], KeyW: [0, 1, 0], KeyS: [0, -1, 0],
  KeyQ: [0, 0, 1], KeyE: [0, 0, -1],
};

export class Keys {
  /**
   * @param {Stage} stage @param {Grip} grip
   * @param {{[key: string]: () => void}} commands what other keys do, by their letter or sign
   */
  constructor(stage, grip, commands) {
    this.stage = stage;
    this.grip = grip;
    this.commands = commands;
    /** @type {Set<string>} */
    this.down = new Set();
    this.fine = false;
    this.timer = 0;
    this.last = 0;
    document.addEventListener("keydown", (event) => this.press(event));
    document.addEventListener("keyup", (event) => this.lift(event.code, event.shiftKey));
    window.addEventListener("blur", () => this.liftAll());
  }

  /** @param {KeyboardEvent} event */
  press(event) {
    this.fine = event.shiftKey;
    if (event.ctrlKey || event.altKey || event.metaKey || isTyping(event.target)) return;
    const onStage = document.activeElement === this.stage.canvas || document.activeElement === document.body;
    if (onStage && event.code in MOVES) {
      event.preventDefault();
      this.move(event.code);
    } else if (onStage && event.code === "Space") {
      event.preventDefault();
      if (!event.repeat) this.grip.toggle(event.timeStamp);
    } else if (!event.repeat || event.key === ".") {
      const command = this.commands[event.key.toLowerCase()];
      if (!command) return;
      event.preventDefault();
      command();
    }
  }

  /** Takes the press of a movement key. @param {string} code */
  move(code) {
    if (this.down.has(code)) return;
    if (this.down.size === 0) {
      if (!this.grip.active && !this.grip.begin(performance.now())) return;
      this.last = performance.now();
      this.timer = window.setInterval(() => this.tick(), PERIOD);
    }
    this.down.add(code);
  }

  /** Takes the release of a key. @param {string} code @param {boolean} fine */
  lift(code, fine) {
    this.fine = fine;
    if (!this.down.delete(code) || this.down.size > 0) return;
    clearInterval(this.timer);
    this.grip.rest();
  }

  /** Releases all keys when the window loses the keyboard. */
  liftAll() {
    for (const code of [...this.down]) this.lift(code, false);
  }

  /** Moves the hand by the displacement since the last sample. */
  tick() {
    const now = performance.now();
    const time = (Math.min(LONGEST, now - this.last) / 1000) * (this.fine ? FINE : 1);
    this.last = now;
    const scene = this.stage.state?.scene;
    if (!scene) return;
    const way = SPEED * bodySize(scene) * time;
    let [x, y, turn] = [0, 0, 0];
    for (const code of this.down) {
      x += MOVES[code][0];
      y += MOVES[code][1];
      turn += MOVES[code][2];
    }
    this.grip.move(way * x, way * y, TURN * time * turn, now);
  }
}

/** Returns true if a key would enter text or move a control. @param {EventTarget | null} target */
function isTyping(target) {
  return target instanceof HTMLElement && target.matches("input:not([type=range], [type=checkbox], [type=radio]), select, textarea");
}
