// The pen of the editor: points clicked one after the other become a convex polygon, a rod or a point.

import { svg } from "./dom.js";
import { hull, round } from "./editor-model.js";

/** Distance within which a click is meant for what is there: the first point, or the border of something (px). */
export const CLOSE = 12;
/** Coarsest rounding of points (px). */
const UNIT = 0.5;

export class Pen {
  /**
   * @param {Stage} stage
   * @param {(corners: Vec[], left: number, isCrossed: boolean) => void} done called with a convex polygon, counter-clockwise, the
   *   number of points left out of it, and whether the clicked line went around the others in another order
   * @param {() => void} ended
   */
  constructor(stage, done, ended) {
    this.stage = stage;
    this.done = done;
    this.ended = ended;
    /** @type {Vec[]} */
    this.points = [];
    this.line = svg("path", { class: "pen-line" });
    this.dots = svg("g");
    const label = "Click the corners of the polygon";
    this.root = svg("svg", { class: "editor-layer pen", tabindex: 0, "aria-label": label }, this.line, this.dots);
    this.root.addEventListener("click", (event) => this.click(/** @type {MouseEvent} */ (event)));
    this.root.addEventListener("keydown", (event) => this.press(/** @type {KeyboardEvent} */ (event)));
    stage.canvas.parentElement?.querySelector(".editor-layer")?.after(this.root);
    /** @type {any} */ (this.root).focus({ preventScroll: true });
  }

  /** @param {MouseEvent} event */
  click(event) {
    const { left, top } = this.stage.canvas.getBoundingClientRect();
    const { magnify, view } = this.stage;
    const x = (event.clientX - left) / magnify, y = (event.clientY - top) / magnify;
    const [first] = this.points;
    const isNear = (/** @type {Vec} */ p, /** @type {number} */ by) => Math.hypot(view.px(p[0]) - x, view.py(p[1]) - y) < by;
    const last = this.points.at(-1);
    // The second click of a double click ends it, too.
    if ((first && this.points.length > 2 && isNear(first, CLOSE)) || (event.detail > 1 && last && isNear(last, CLOSE))) {
      this.finish();
      return;
    }
    const [wx, wy] = view.world(x, y);
    this.points.push([round(wx, UNIT / view.scale), round(wy, UNIT / view.scale)]);
    this.draw();
  }

  /** @param {KeyboardEvent} event */
  press(event) {
    if (event.key === "Enter") this.finish();
    else if (event.key === "Escape") this.end();
    else if (event.key === "Backspace") this.points.pop();
    else return;
    event.preventDefault();
    event.stopPropagation();
    this.draw();
  }

  /** Completes the polygon. */
  finish() {
    const corners = hull(this.points);
    this.end();
    const count = corners.length, places = corners.map(String);
    const order = this.points.map((point) => places.indexOf(String(point))).filter((place) => place >= 0);
    const steps = order.map((place, k) => (order[(k + 1) % order.length] - place + count) % count).filter((step) => step > 0);
    const isCrossed = [1, count - 1].every((sense) => steps.some((step) => step !== sense));
    this.done(corners, new Set(this.points.map(String)).size - count, isCrossed);
  }

  /** Removes the pen. */
  end() {
    this.root.remove();
    this.ended();
  }

  /** Draws the points so far. */
  draw() {
    const { view, magnify } = this.stage;
    const spots = this.points.map(([x, y]) => [magnify * view.px(x), magnify * view.py(y)]);
    this.line.setAttribute("d", spots.length > 1 ? `M${spots.map((spot) => spot.join(" ")).join("L")}` : "");
    this.dots.replaceChildren(...spots.map(([cx, cy]) => svg("circle", { cx, cy, r: 5 })));
  }
}
