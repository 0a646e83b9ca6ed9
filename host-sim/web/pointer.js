// Mouse, pen and fingers: press to hold, drag to move, wheel or second finger to turn, let go to release. Off the
// object the window is moved; two fingers or ctrl and wheel zoom it.

import { HAND_RADIUS } from "./object.js";

/** A press so far from the object still takes hold of it (px), by mouse and by finger. */
const SLACK = { mouse: 10, pen: 12, touch: 24 };
/** Turn of the hand for a pixel of the wheel (rad); a notch is some 100. With shift a tenth. */
const WHEEL_TURN = 0.0006;
const FINE = 0.1;
/** Pixels of a line and of a page of a wheel. */
const LINE = 33;
const PAGE = 400;
/** Zoom for a pixel of the wheel. */
const WHEEL_ZOOM = 0.0025;
/**
 * A hold is put so far inside the border, as a part of the way to the body's middle, so that rounding leaves it in
 * reach.
 */
const INSIDE = 1e-4;

export class Pointers {
  /** @param {Stage} stage @param {Grip} grip */
  constructor(stage, grip) {
    this.stage = stage;
    this.grip = grip;
    /** Where every pointer is that is down (px), the oldest first. @type {Map<number, Spot>} */
    this.down = new Map();
    /** What the first pointer does. @type {"hold" | "pan" | null} */
    this.doing = null;
    /** The browser gives raw samples, as they come; the others are then the same once more. */
    this.raw = false;
    const { canvas } = stage;
    canvas.addEventListener("pointerdown", (event) => this.press(event));
    canvas.addEventListener("pointermove", (event) => { if (!this.raw) this.samples(event); });
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
    const { canvas, view } = this.stage;
    canvas.focus({ preventScroll: true });
    canvas.setPointerCapture(event.pointerId);
    if (!this.raw) this.samples(event);
    const at = this.stage.place(event);
    this.down.set(event.pointerId, at);
    if (this.down.size > 1) return;
    const slack = SLACK[/** @type {keyof typeof SLACK} */ (event.pointerType)] ?? SLACK.mouse;
    const place = event.button === 0 ? this.reach(view.world(at.x, at.y), slack) : null;
    this.doing = place || (event.button === 0 && this.grip.holding) ? "hold" : "pan";
    if (this.doing === "hold") {
      const anew = place && !(this.grip.holding && this.nearHand(at));
      const had = anew ? this.grip.grasp(place, event.timeStamp) : this.grip.begin(event.timeStamp);
      if (!had) this.doing = "pan";
    }
    canvas.dataset.doing = this.doing;
  }

  /** True if a press is at the hand or at its holding point. @param {Spot} at */
  nearHand(at) {
    const message = this.stage.message;
    if (!message) return false;
    const { view } = this.stage;
    return [message.frame.hand, message.holding ?? message.frame.hand].some(([x, y]) =>
      Math.hypot(view.px(x) - at.x, view.py(y) - at.y) < 2.5 * HAND_RADIUS);
  }

  /**
   * The place of the body that a press takes hold of, or null where it is out of reach.
   * @param {Vec} point @param {number} slack px @returns {Vec | null}
   */
  reach(point, slack) {
    const { state, message, view } = this.stage;
    if (!state || !message) return null;
    const { body, reach } = state.scene;
    const [x, y, theta] = message.frame.pose;
    const c = Math.cos(theta), s = Math.sin(theta);
    const [dx, dy] = [point[0] - x, point[1] - y];
    const local = /** @type {Vec} */ ([c * dx + s * dy, c * dy - s * dx]);
    const near = nearestOf(body, local);
    const distance = Math.hypot(local[0] - near[0], local[1] - near[1]);
    if (distance <= 0.999 * reach || distance === 0) return point;
    if (distance > reach + slack / view.scale) return null;
    const share = 1 / body.length;
    const middle = body.reduce((sum, vertex) => [sum[0] + share * vertex[0], sum[1] + share * vertex[1]], [0, 0]);
    const inside = [near[0] + INSIDE * (middle[0] - near[0]), near[1] + INSIDE * (middle[1] - near[1])];
    return [x + c * inside[0] - s * inside[1], y + s * inside[0] + c * inside[1]];
  }

  /** All that a pointer has been through since the last event. @param {PointerEvent} event */
  samples(event) {
    if (!this.down.has(event.pointerId)) return;
    const all = event.getCoalescedEvents?.() ?? [];
    if (all.length === 0) this.move(event);
    for (const one of all) this.move(one);
  }

  /** One sample of a pointer. @param {PointerEvent} event */
  move(event) {
    const at = this.down.get(event.pointerId);
    if (!at) return;
    const now = this.stage.place(event);
    const dx = now.x - at.x, dy = now.y - at.y;
    if (dx === 0 && dy === 0) return;
    const [first, second] = this.down.values();
    const before = second ? { x: second.x - first.x, y: second.y - first.y } : null;
    at.x = now.x;
    at.y = now.y;
    const after = second ? { x: second.x - first.x, y: second.y - first.y } : null;
    if (this.doing === "hold") this.drag(at === first ? dx : 0, at === first ? dy : 0, before, after, event.timeStamp);
    else this.shift(dx, dy, before, after, first, second);
  }

  /**
   * The first pointer moves the hand, the second one turns it.
   * @param {number} dx @param {number} dy @param {Spot | null} before @param {Spot | null} after @param {number} sent
   */
  drag(dx, dy, before, after, sent) {
    const { scale } = this.stage.view;
    this.grip.move(dx / scale, -dy / scale, before && after ? turnBetween(before, after) : 0, sent);
  }

  /**
   * One pointer moves the window, two zoom it.
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
    if (event.pointerId === first && this.doing === "hold") {
      this.grip.end(event.timeStamp);
      this.doing = "pan";
    }
    if (this.down.size === 0) {
      this.doing = null;
      delete this.stage.canvas.dataset.doing;
    }
  }

  /** The wheel turns the hand that holds; with ctrl, as a pinch on a touch pad, it zooms. @param {WheelEvent} event */
  wheel(event) {
    const unit = event.deltaMode === 1 ? LINE : event.deltaMode === 2 ? PAGE : 1;
    const by = (event.deltaY || event.deltaX) * unit;
    if (event.ctrlKey || event.metaKey) {
      event.preventDefault();
      this.stage.adjusted = true;
      const { x, y } = this.stage.place(event);
      this.stage.view.zoom(Math.exp(-WHEEL_ZOOM * by), x, y);
      this.stage.ask();
      return;
    }
    if (!this.grip.holding) return;
    event.preventDefault();
    if (!this.grip.active) {
      if (!this.grip.begin(event.timeStamp)) return;
      this.grip.active = false;
    }
    this.grip.move(0, 0, -WHEEL_TURN * by * (event.shiftKey ? FINE : 1), event.timeStamp);
  }
}

/** The turn from one direction to another, counter-clockwise on the screen. @param {Spot} a @param {Spot} b */
const turnBetween = (a, b) => Math.atan2(a.y * b.x - a.x * b.y, a.x * b.x + a.y * b.y);

/**
 * The point of a convex polygon that is nearest to another one.
 * @param {Vec[]} body counter-clockwise @param {Vec} point @returns {Vec}
 */
function nearestOf(body, point) {
  let inside = body.length > 2;
  let least = Infinity;
  let best = point;
  body.forEach((a, i) => {
    const b = body[(i + 1) % body.length];
    const ex = b[0] - a[0], ey = b[1] - a[1];
    const rx = point[0] - a[0], ry = point[1] - a[1];
    if (ex * ry - ey * rx < 0) inside = false;
    const along = Math.min(1, Math.max(0, (rx * ex + ry * ey) / (ex * ex + ey * ey || 1)));
    const near = /** @type {Vec} */ ([a[0] + along * ex, a[1] + along * ey]);
    const distance = Math.hypot(point[0] - near[0], point[1] - near[1]);
    if (distance < least) [least, best] = [distance, near];
  });
  return inside ? point : best;
}
