// An arrow at the border that points to the object while it is outside the window, with its distance from there. A click on it
// fits the scene.

import { byId, digits, setText } from "./dom.js";

/** Distance of the arrow's middle from the borders (CSS px): clear of the texts, of the buttons and of its own half. */
const INSET = { left: 60, right: 112, top: 70, bottom: 48 };

export class Away {
  /** @param {Stage} stage */
  constructor(stage) {
    this.stage = stage;
    this.button = byId("away", HTMLButtonElement);
    this.arrow = /** @type {HTMLElement} */ (this.button.firstElementChild);
    this.text = byId("away-text");
    this.button.addEventListener("click", () => {
      stage.canvas.focus();
      stage.fit();
    });
    stage.also.push(() => this.show());
    stage.ask();
  }

  /** Updates the arrow, with every drawing. */
  show() {
    const { view, magnify, state, message } = this.stage;
    if (!state || !message) return;
    this.button.hidden = view.shows(state.scene.body, message.frame.pose);
    if (this.button.hidden) return;
    const [x, y] = message.frame.pose;
    const middle = { x: (magnify * view.width) / 2, y: (magnify * view.height) / 2 };
    const dx = magnify * view.px(x) - middle.x, dy = magnify * view.py(y) - middle.y;
    const across = dx < 0 ? middle.x - INSET.left : middle.x - INSET.right;
    const up = dy < 0 ? middle.y - INSET.top : middle.y - INSET.bottom;
    const part = Math.min(across / Math.abs(dx), up / Math.abs(dy));
    const metres = ((1 - part) * Math.hypot(dx, dy)) / (magnify * view.scale);
    const distance = metres < 1 ? `${digits(1e3 * metres)} mm` : `${digits(metres)} m`;
    this.button.style.left = `${middle.x + part * dx}px`;
    this.button.style.top = `${middle.y + part * dy}px`;
    this.arrow.style.rotate = `${Math.atan2(dy, dx)}rad`;
    setText(this.text, distance);
    this.button.setAttribute("aria-label", `The object is out of the window, ${distance} from here. Fit the scene`);
  }
}
