// Mouse, pen and fingers: press to hold, drag to move, let go to release; the handle, the wheel or a second finger turns the
// hand. Dragging off the object moves the window; two fingers, and the wheel with ctrl or without a hold, zoom it.

import { frictionAt } from "./forces.js";
import { ARM, isAtKnob } from "./handle.js";
import { HAND_RADIUS } from "./object.js";
import { placeOf } from "./reach.js";

/** Distance from the object at which a press still grasps it (px), by kind of pointer. */
const SLACK = { mouse: 10, pen: 12, touch: 24 };
/** Rotation of the hand per pixel of the wheel (rad): 5 degrees for a notch, which is about 100. Factor with shift. */
const WHEEL_TURN = (5 * Math.PI) / 180 / 100;
const FINE = 0.1;
/** Pixels of a line and of a page of a wheel. */
const LINE = 33;
const PAGE = 400;
/** Zoom exponent per pixel of the wheel. */
const WHEEL_ZOOM = 0.0025;
/** Distance from the end of a cone's side at which a press still takes it (px), and the largest friction to which it is dragged. */
const CONE_SLACK = { mouse: 6, pen: 8, touch: 16 };
const MOST_FRICTION = 1.5;

export class Pointers {
  /**
   * @param {Stage} stage @param {Grip} grip
   * @param {(kind: "static" | "dynamic", friction: number) => void} setFriction
   */
  constructor(stage, grip, setFriction) {
    this.stage = stage;
    this.grip = grip;
    this.setFriction = setFriction;
    /** The cone that is dragged. @type {ReturnType<Stage["coneAt"]>} */
    this.cone = null;
    /** Positions of all pressed pointers (px), the oldest first. @type {Map<number, Spot>} */
    this.down = new Map();
    /** Action of the first pointer. @type {"hold" | "turn" | "cone" | "pan" | null} */
    this.doing = null;
    /** The hand held before the press on its handle, and keeps holding after it. */
    this.stays = false;
    /** The browser gives raw samples immediately; the other events repeat them. */
    this.raw = false;
    const { canvas } = stage;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => {
      if (!this.raw) this.samples(event);
      this.hover(event);
    });
    canvas.addEventListener("pointerleave", () => { if (this.down.size === 0) this.stage.setOver(null); });
    canvas.addEventListener("pointerrawupdate", (event) => {
      this.raw = true;
      this.samples(/** @type {PointerEvent} */ (event));
    });
    for (const name of /** @type {const} */ (["pointerup", "pointercancel"])) {
      canvas.addEventListener(name, (event) => this.lift(event));
    }
    canvas.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
    canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  }

  /** @param {PointerEvent} event */
  press(event) {
    const { canvas } = this.stage;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    if (!this.raw) this.samples(event);
    const at = this.stage.place(event);
    this.down.set(event.pointerId, at);
    if (this.down.size > 1) return;
    this.doing = event.button === 0 ? this.take(at, event) : "pan";
    canvas.dataset.doing = this.doing;
    if (this.doing === "pan") return;
    // The window stays, so that the cone stays under the pointer.
    this.stage.leading = at;
    if (this.doing === "turn") this.stage.setOver("knob");
  }

  /**
   * Begins the action of a press on the handle, a cone, the holding hand, the object, or the window.
   * @param {Spot} at @param {PointerEvent} event @returns {"hold" | "turn" | "cone" | "pan"}
   */
  take(at, event) {
    const { grip, stage } = this;
    const [slack, sent] = [slackOf(event), event.timeStamp];
    const point = stage.view.world(at.x, at.y);
    const [hand, isShown] = [stage.message?.frame.hand, stage.handleShown()];
    if (hand && isShown && isAtKnob(stage.view, hand, at, slack)) {
      this.stays = grip.holding;
      const place = this.reach([hand[0], hand[1]], slack);
      const had = grip.holding ? grip.begin(sent) : place !== null && grip.grasp(place, sent);
      return had ? "turn" : "pan";
    }
    this.cone = stage.coneAt(at, slackOf(event, CONE_SLACK));
    if (this.cone) return "cone";
    const isNear = grip.holding && this.nearHand(at);
    const place = this.reach(point, slack);
    const had = isNear ? grip.begin(sent) : place !== null && grip.grasp(place, sent);
    if (!had) return "pan";
    grip.anchor(point);
    return "hold";
  }

  /** Finds what the unpressed pointer is over. @param {PointerEvent} event */
  hover(event) {
    const { stage } = this;
    if (this.down.size > 0 || event.pointerType === "touch" || !stage.message) return;
    const { hand } = stage.message.frame;
    const at = stage.place(event), slack = slackOf(event);
    const isShown = stage.handleShown();
    // The pointer keeps the handle while it moves towards it.
    const isNear = isShown && Math.hypot(stage.view.px(hand[0]) - at.x, stage.view.py(hand[1]) - at.y) < ARM + slack;
    const cone = stage.coneAt(at, slackOf(event, CONE_SLACK));
    if (isShown && isAtKnob(stage.view, hand, at, slack)) stage.setOver("knob");
    else if (cone) stage.setOver(cone.kind);
    else stage.setOver(isNear || this.reach(stage.view.world(at.x, at.y), slack) ? "object" : null);
  }

  /** Returns true if a press is at the hand or at its holding point. @param {Spot} at */
  nearHand(at) {
    const message = this.stage.message;
    if (!message) return false;
    const { view } = this.stage;
    return [message.frame.hand, message.holding ?? message.frame.hand].some(([x, y]) =>
      Math.hypot(view.px(x) - at.x, view.py(y) - at.y) < 2.5 * HAND_RADIUS);
  }

  /**
   * Returns the point of the body that a press grasps, or null if it is out of reach.
   * @param {Vec} point @param {number} slack px
   */
  reach(point, slack) {
    const { state, message, view } = this.stage;
    return state && message ? placeOf(state.scene, message.frame.pose, point, slack / view.scale) : null;
  }

  /** Takes all samples of a pointer since the last event. @param {PointerEvent} event */
  samples(event) {
    if (!this.down.has(event.pointerId)) return;
    const all = event.getCoalescedEvents?.() ?? [];
    if (all.length === 0) this.move(event);
    for (const one of all) this.move(one);
  }

  /** Takes one sample of a pointer. @param {PointerEvent} event */
  move(event) {
    const at = this.down.get(event.pointerId);
    if (!at) return;
    const now = this.stage.place(event);
    const dx = now.x - at.x, dy = now.y - at.y;
    if (dx === 0 && dy === 0) return;
    const [first, second] = this.down.values();
    const before = this.arm(first, second);
    at.x = now.x;
    at.y = now.y;
    const after = this.arm(first, second);
    if (this.doing === "hold" || this.doing === "turn") {
      if (before && after) this.grip.move(0, 0, turnBetween(before, after), event.timeStamp);
      if (this.doing === "hold" && at === first) this.grip.lead(this.stage.view.world(at.x, at.y), event.timeStamp);
    } else if (this.doing === "cone" && this.cone) {
      const { kind, point, surface } = this.cone;
      if (at === first) this.setFriction(kind, frictionAt(this.stage.view, point, surface, at, MOST_FRICTION));
    } else {
      this.shift(dx, dy, before, after, first, second);
    }
  }

  /**
   * Returns the vector that turns the hand or zooms: from the first finger to the second one; at the handle from the hand to
   * the pointer.
   * @param {Spot} first @param {Spot | undefined} second
   */
  arm(first, second) {
    const { view } = this.stage;
    const [x, y] = this.grip.pose;
    if (this.doing === "turn") return { x: first.x - view.px(x), y: first.y - view.py(y) };
    return second ? { x: second.x - first.x, y: second.y - first.y } : null;
  }

  /**
   * Moves the window by one pointer, zooms it by two.
   * @param {number} dx @param {number} dy @param {Spot | null} before @param {Spot | null} after @param {Spot} first
   * @param {Spot | undefined} second
   */
  shift(dx, dy, before, after, first, second) {
    const { view } = this.stage;
    this.stage.adjusted = true;
    if (before && after && second) {
      const factor = Math.hypot(after.x, after.y) / Math.max(1, Math.hypot(before.x, before.y));
      view.zoom(factor, (first.x + second.x) / 2, (first.y + second.y) / 2);
      view.pan(dx / 2, dy / 2);
    } else {
      view.pan(dx, dy);
    }
    this.stage.ask();
  }

  /** @param {PointerEvent} event */
  lift(event) {
    const [first] = this.down.keys();
    if (!this.down.delete(event.pointerId)) return;
    if (event.pointerId === first && this.doing !== "pan") {
      if (this.doing !== "cone") this.grip.end(event.timeStamp, this.grip.keep || (this.doing === "turn" && this.stays));
      this.doing = "pan";
      this.stage.leading = null;
      this.stage.setOver(null);
      this.stage.ask();
    }
    if (this.down.size === 0) {
      this.doing = null;
      delete this.stage.canvas.dataset.doing;
      this.hover(event);
    }
  }

  /**
   * Turns the holding hand by the wheel; without a hold, and with ctrl as a pinch on a touch pad, zooms.
   * @param {WheelEvent} event
   */
  wheel(event) {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? LINE : event.deltaMode === 2 ? PAGE : 1;
    const by = (event.deltaY || event.deltaX) * unit;
    const { grip, stage } = this;
    if (event.ctrlKey || event.metaKey || !grip.holding || grip.refusal() !== null) {
      stage.zoom(Math.exp(-WHEEL_ZOOM * by), stage.place(event));
      return;
    }
    const isActive = grip.active;
    if (!isActive && !grip.begin(event.timeStamp)) return;
    grip.active = isActive;
    grip.move(0, 0, -WHEEL_TURN * by * (event.shiftKey ? FINE : 1), event.timeStamp);
  }
}

/** Returns the tolerance of a pointer (px). @param {PointerEvent} event */
const slackOf = ({ pointerType }, slack = SLACK) => slack[/** @type {keyof typeof SLACK} */ (pointerType)] ?? slack.mouse;

/** Returns the angle from one direction to another, counter-clockwise on the screen. @param {Spot} a @param {Spot} b */
const turnBetween = (a, b) => Math.atan2(a.y * b.x - a.x * b.y, a.x * b.x + a.y * b.y);
