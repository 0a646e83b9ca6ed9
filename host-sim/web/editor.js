// The editor of the scene: handles over the stage, a panel next to the selection, undo and redo. Every change is sent to the
// solver's side as an edit, which reports what is wrong with it or restarts the edited scene.

import { byId, digits, prefixed, setText } from "./dom.js";
import { button, Card } from "./editor-card.js";
import { Handles } from "./editor-handles.js";
import { addObstacle, addSurface, editOf, lift, modelOf, same, withBody, withCorner } from "./editor-model.js";
import { CLOSE, Pen } from "./editor-pen.js";

/** @typedef {import("./editor-model.js").Model} Model */
/** @typedef {import("./editor-handles.js").Item} Item */

/** Delay from a change to sending the edit, and from a state to checking it (ms): by then the request has been answered. */
const DEBOUNCE = 120;
const SETTLE = 400;
/** Largest number of changes that can be undone. */
const MOST = 200;

export class Editor {
  /**
   * @param {Stage} stage @param {() => Files} feed @param {(text: string) => void} tell
   * @param {() => void} closed called when it is closed
   */
  constructor(stage, feed, tell, closed) {
    this.stage = stage;
    this.feed = feed;
    this.tell = tell;
    this.closed = closed;
    const state = /** @type {StateMessage} */ (stage.state);
    this.title = state.scene.title;
    this.model = modelOf(state);
    /** The model that the solver has. */
    this.applied = this.model;
    /** @type {Model[]} */
    this.past = [];
    /** @type {Model[]} */
    this.future = [];
    /** The model before the change in progress. */
    this.before = this.model;
    /** What the solver refused, or empty. */
    this.problem = "";
    /** The last state that was checked. */
    this.seen = stage.state;
    this.timer = 0;
    this.looking = 0;
    /** The models are being sent. @type {Promise<void> | null} */
    this.sending = null;
    this.open = true;
    /** @type {Pen | null} */
    this.pen = null;
    this.handles = new Handles(stage, {
      model: () => this.model, select: (item) => this.select(item), begin: () => this.begin(),
      pulled: (model) => this.put(model), end: () => this.end(),
      remove: (item, corner) => this.remove(item, corner), insert: (item, side, at) => this.insert(item, side, at),
    });
    this.card = new Card(stage, {
      model: () => this.model, change: (work) => this.change(work), remove: (item) => this.remove(item, undefined),
      draw: () => this.draw("body"), tell,
    });
    this.build();
    this.keys = (/** @type {KeyboardEvent} */ event) => this.press(event);
    document.addEventListener("keydown", this.keys, true);
    this.redraw = () => {
      if (this.seen !== stage.state) this.setState();
      this.seen = stage.state;
      if (this.open) this.update();
    };
    stage.also.push(this.redraw);
    stage.editing = true;
    this.update();
  }

  /** Makes the buttons, and the line with the problem. */
  build() {
    this.bar = document.createElement("div");
    this.bar.className = "editor-bar";
    this.bar.setAttribute("role", "toolbar");
    this.bar.setAttribute("aria-label", "Editor");
    this.undoButton = button("↶", "Undo", () => this.step(this.past, this.future));
    this.redoButton = button("↷", "Redo", () => this.step(this.future, this.past));
    this.hint = document.createElement("p");
    this.hint.className = "editor-hint";
    this.wrong = document.createElement("p");
    this.wrong.className = "editor-problem";
    this.wrong.setAttribute("role", "alert");
    this.bar.append(this.undoButton, this.redoButton,
      button("Draw", "Draw the object's polygon", () => this.draw("body")),
      button("+ Surface", "Add a surface", () => this.change(addSurface)),
      button("+ Obstacle", "Add an obstacle", () => this.draw("obstacle")),
      button("Save", "Save the scene as a file", () => this.save()),
      Object.assign(button("Try it", "Try it", () => this.tryIt()), { className: "main" }));
    this.stage.canvas.parentElement?.append(this.bar, this.hint, this.wrong, this.card.root);
    this.stage.canvas.parentElement?.classList.add("editing");
  }

  /** Closes the editor. */
  close() {
    this.open = false;
    clearTimeout(this.timer);
    clearTimeout(this.looking);
    this.pen?.end();
    document.removeEventListener("keydown", this.keys, true);
    this.stage.also.splice(this.stage.also.indexOf(this.redraw), 1);
    this.stage.editing = false;
    this.handles.remove();
    for (const element of [this.bar, this.hint, this.wrong, this.card.root]) element?.remove();
    this.stage.canvas.parentElement?.classList.remove("editing");
    this.closed();
  }

  /** Sends the scene to the solver immediately and closes the editor, so that the hand can be used. */
  async tryIt() {
    if (await this.sendNow()) this.close();
  }

  /** Sends the scene to the solver immediately, and saves it as a file. */
  async save() {
    if (await this.sendNow()) byId("save-scene").click();
  }

  /** @param {KeyboardEvent} event */
  press(event) {
    const isText = event.target instanceof HTMLInputElement && event.target.type !== "range";
    const key = event.key.toLowerCase();
    if ((event.ctrlKey || event.metaKey) && (key === "z" || key === "y") && !isText) {
      const isRedo = key === "y" || event.shiftKey;
      this.step(isRedo ? this.future : this.past, isRedo ? this.past : this.future);
    } else if (key === "escape" && !this.pen && !document.querySelector("dialog[open]")) {
      if (this.card.item) this.select(null);
      else this.close();
    } else {
      return;
    }
    event.preventDefault();
    event.stopPropagation();
  }

  /** @param {Item | null} item */
  select(item) {
    this.handles.selected = item;
    this.card.show(item);
    this.update();
  }

  /** Begins a change; returns the model before it. */
  begin() {
    this.before = this.model;
    return this.model;
  }

  /** Sets the model during a change. @param {Model} model */
  put(model) {
    this.model = model;
    this.update();
    this.later();
  }

  /** Completes a change: it can be undone. */
  end() {
    if (same(this.before, this.model)) return;
    this.past.push(this.before);
    if (this.past.length > MOST) this.past.shift();
    this.future = [];
    this.before = this.model;
    this.update();
  }

  /** Makes a change in one step. @param {(model: Model) => void} work */
  change(work) {
    const model = structuredClone(this.begin());
    work(model);
    this.put(model);
    this.end();
  }

  /** Undoes or redoes. @param {Model[]} from @param {Model[]} to */
  step(from, to) {
    const model = from.pop();
    if (!model) return;
    to.push(this.model);
    this.put(model);
  }

  /** Removes a corner, or a surface or obstacle. @param {Item} item @param {number | undefined} corner */
  remove({ kind, index }, corner) {
    if (kind === "body") {
      if (corner !== undefined && this.model.body.length > 1) this.change((model) => { model.body.splice(corner, 1); });
      return;
    }
    const isWhole = corner === undefined || kind === "surface" || this.model.obstacles[index].vertices.length === 1;
    if (isWhole) this.select(null);
    this.change((model) => {
      if (kind === "surface") model.surfaces.splice(index, 1);
      else if (isWhole) model.obstacles.splice(index, 1);
      else model.obstacles[index].vertices.splice(/** @type {number} */ (corner), 1);
    });
  }

  /** Adds a corner to a side, at a point of the world. @param {Item} item @param {number} side @param {Vec} at */
  insert({ kind, index }, side, at) {
    this.change((model) => {
      if (kind === "body") {
        const [x, y, theta] = model.start;
        const c = Math.cos(theta), s = Math.sin(theta);
        model.body = withCorner(model.body, side, [c * (at[0] - x) + s * (at[1] - y), c * (at[1] - y) - s * (at[0] - x)]);
      } else {
        const obstacle = model.obstacles[index];
        obstacle.vertices = withCorner(obstacle.vertices, side, at);
      }
    });
  }

  /** Starts the pen for the object or for a new obstacle. @param {"body" | "obstacle"} what */
  draw(what) {
    this.pen?.end();
    this.select(null);
    this.pen = new Pen(this.stage, (corners, left, isCrossed) => {
      const out = left > 0 ? `: ${left} of the points ${left === 1 ? "is" : "are"} left out` : "";
      if (isCrossed) this.tell(`The lines cross. The polygon is the convex one around the points${out}.`);
      else if (left > 0) this.tell(`The polygon is convex${out}.`);
      else if (corners.length === 1) this.tell(what === "body" ? "The object is a point." : "The obstacle is a pin.");
      if (what === "obstacle") this.change((model) => addObstacle(model, corners));
      else if (corners.length > 0) this.change((model) => {
        withBody(model, corners);
        lift(model, CLOSE / this.stage.view.scale);
      });
    }, () => {
      this.pen = null;
      this.update();
    });
    this.update();
  }

  /** Sends the model soon. */
  later() {
    if (!this.timer) this.timer = window.setTimeout(() => { this.timer = 0; this.send(); }, DEBOUNCE);
  }

  /** Sends the model immediately; returns false if the solver refuses it. */
  async sendNow() {
    clearTimeout(this.timer);
    this.timer = 0;
    await this.send();
    return this.problem === "";
  }

  /** Sends the model, each one after the answer to the previous one, until the solver has received the newest. */
  send() {
    this.sending ??= this.sendNewest().finally(() => { this.sending = null; });
    return this.sending;
  }

  async sendNewest() {
    /** @type {Model | null} */
    let sent = null;
    while (sent !== this.model) {
      sent = this.model;
      try {
        const answer = JSON.parse(await this.feed().file("edit", this.title, editOf(sent)));
        this.title = answer.scene;
        this.applied = sent;
        this.problem = "";
      } catch (why) {
        this.problem = /** @type {Error} */ (why).message;
      }
    }
    if (this.open) this.update();
  }

  /** Schedules a check for another scene or somebody else's change, which would be edited from then on. */
  setState() {
    clearTimeout(this.looking);
    this.looking = window.setTimeout(() => this.look(), SETTLE);
  }

  /** Checks whether the state is that of the model sent to the solver. */
  look() {
    const { state } = this.stage;
    if (!this.open || !state) return;
    if (this.sending || this.timer || this.handles.pull) {
      this.setState();
      return;
    }
    const model = modelOf(state);
    const isOther = state.scene.title !== this.title;
    if (!isOther && same(model, this.applied)) return;
    if (isOther) {
      [this.past, this.future, this.title] = [[], [], state.scene.title];
      this.select(null);
      this.stage.fit();
    } else {
      this.past.push(this.model);
      this.future = [];
    }
    [this.model, this.applied, this.before, this.problem] = [model, model, model, ""];
    this.update();
  }

  /** Shows the present model. */
  update() {
    const [, kind, index, , corner] = this.problem.match(/`(body|surface|obstacle)(?:\[(\d+)\])?(\.vertices\[(\d+)\])?/) ?? [];
    this.handles.bad = [kind, index, corner].filter((part) => part !== undefined).join("-");
    this.handles.draw();
    this.card.update();
    this.pen?.draw();
    if (!this.undoButton || !this.redoButton || !this.wrong || !this.hint) return;
    this.undoButton.disabled = this.past.length === 0;
    this.redoButton.disabled = this.future.length === 0;
    setText(this.wrong, inWords(this.problem));
    this.wrong.hidden = this.problem === "";
    setText(this.hint, this.pen ? "Click the corners. Enter or a click on the first one ends, Esc cancels."
      : "Drag what is to move. Double click a side for another corner, Delete removes.");
  }
}

/** Returns what the solver refused in the words of the page. @param {string} problem */
function inWords(problem) {
  const [, depth, name] = problem.match(/ puts .* (\S+) m inside (?:surface|obstacle) "(.*)", allowed/) ?? [];
  // The text with this file and line was generated: nobody wrote it.
  if (!name) return problem.replace(/^.*?, line \d+: /, "").split("\n")[0];
  const { name: unit, per } = prefixed(Number(depth), "m");
  const far = `${digits(Number(depth) * per)} ${unit}`;
  return `The object reaches ${far} into “${name}”. Move one of the two; all other changes wait for that.`;
}
