// The canvas with the scene: keeps it as sharp as the screen, draws only when something has changed, and measures the cost of
// drawing and the age of a hand's sample when its pose appears.

import { colors, onTheme } from "./theme.js";
import { coneAt, drawContact, drawCones, drawSliding, ForceScale, labelContact, linesOfContact } from "./forces.js";
import { drawGrid, drawScales, drawSurfaces, linesOfSurfaces } from "./ground.js";
import { drawHandle } from "./handle.js";
import { drawBody, drawCoil, drawGhost, drawHand, drawHolding, drawSpiral, linesOfBody, linesOfHand } from "./object.js";
import { placeOf } from "./reach.js";
import { Samples } from "./samples.js";
import { Trails } from "./trails.js";
import { View } from "./view.js";

/** Rows of pixels at the top reserved for the texts over the scene. */
const TEXT_HEIGHT = 44;
/** Height of a scene (px) with symbols and texts in their normal size; their largest magnification. */
const ORDINARY = 620;
const MOST = 2;

/** Fields of surfaces and obstacles that leave their drawing as it is. */
export const FRICTION = ["static", "dynamic", "memory"];

/** Layers that can be hidden. @typedef {"ghost" | "trails" | "cones" | "bars" | "values"} Layer */

export class Stage {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.canvas = canvas;
    this.ctx = /** @type {CanvasRenderingContext2D} */ (canvas.getContext("2d", { alpha: false }));
    this.view = new View();
    this.view.top = TEXT_HEIGHT;
    this.trails = new Trails();
    this.force = new ForceScale();
    /** @type {StateMessage | null} */
    this.state = null;
    /** @type {FrameMessage | null} */
    this.message = null;
    /** @type {Record<Layer, boolean>} */
    this.layers = { ghost: true, trails: true, cones: true, bars: true, values: true };
    /** Draws obstacles, if scenes have some. @type {typeof import("./obstacles.js") | null} */
    this.obstacles = null;
    /** Key that distinguishes scenes. */
    this.sceneKey = "";
    /** The reader has zoomed or moved the window. */
    this.adjusted = false;
    this.fitted = false;
    /**
     * The pointer that leads or turns the hand: meanwhile the window stays fixed, so that both stay together.
     * @type {Spot | null}
     */
    this.leading = null;
    /** What the pointer is over; of a cone, the kind of its friction. @type {"object" | "knob" | "static" | "dynamic" | null} */
    this.over = null;
    /** The scene is being edited: the window stays fixed. */
    this.editing = false;
    this.asked = false;
    this.lastEcho = -1;
    /** Magnification of symbols and texts on a large screen. */
    this.magnify = 1;
    /** Screen pixels per pixel of the drawing. */
    this.ratio = 1;
    /** The boxes of the buttons and hints over the drawing, which texts avoid. @type {import("./labels.js").Label[]} */
    this.buttons = [];
    this.framesDrawn = 0;
    this.drawTimes = new Samples(2000);
    this.latencies = new Samples(2000);
    /** Callbacks for every drawing, after the scene: other views of the newest frame. @type {(() => void)[]} */
    this.also = [];
    this.work = () => this.draw();
    onTheme(() => this.ask());
    new ResizeObserver((entries) => this.resize(entries[0])).observe(canvas);
    /** The buttons and texts of the page over the drawing. */
    this.overlays = [...canvas.parentElement?.querySelectorAll(".tools button, .foot > *, .over > *") ?? []];
    const changes = new ResizeObserver(() => { this.buttons = this.buttonBoxes(); });
    for (const overlay of this.overlays) changes.observe(overlay);
  }

  /** Gives the canvas as many pixels as the screen has there. @param {ResizeObserverEntry} entry */
  resize(entry) {
    const { width, height } = entry.contentRect;
    if (width === 0 || height === 0) return;
    const ratio = window.devicePixelRatio || 1;
    this.magnify = Math.min(MOST, Math.max(1, Math.min(width, height) / ORDINARY));
    this.ratio = ratio * this.magnify;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    this.view.width = width / this.magnify;
    this.view.height = height / this.magnify;
    this.buttons = this.buttonBoxes();
    // The first edit takes the story away, and the drawing becomes higher: what is being edited stays where it is.
    if (!this.adjusted && !this.editing) this.fitted = false;
    this.draw();
  }

  /** Returns the boxes of the buttons and hints over the drawing, in its pixels. @returns {import("./labels.js").Label[]} */
  buttonBoxes() {
    const canvas = this.canvas.getBoundingClientRect();
    return this.overlays.map((overlay) => {
      const { left, top, width, height } = overlay.getBoundingClientRect();
      const [x, y, w, h] = [left - canvas.left, top - canvas.top, width, height].map((length) => length / this.magnify);
      return { left: x, top: y, width: w, height: h };
    });
  }

  /** Returns the position of a pointer or wheel in the drawing. @param {MouseEvent} event */
  place(event) {
    return { x: event.offsetX / this.magnify, y: event.offsetY / this.magnify };
  }

  /** Returns the position of a point of the world in the window of the browser (CSS px). @param {number} x @param {number} y */
  pixelOf(x, y) {
    const { left, top } = this.canvas.getBoundingClientRect();
    return { x: left + this.view.px(x) * this.magnify, y: top + this.view.py(y) * this.magnify };
  }

  /** Takes a state, which is valid until the next one. @param {StateMessage} state */
  setState(state) {
    const { title, body, surfaces, obstacles } = state.scene;
    // Another friction is not another scene: the window stays.
    const key = JSON.stringify([title, body, surfaces, obstacles], (name, value) => (FRICTION.includes(name) ? undefined : value));
    if (key !== this.sceneKey) {
      this.sceneKey = key;
      this.leading = null;
      this.clear();
      if (!this.editing) {
        // The newest frame belongs to the previous scene.
        this.message = null;
        this.fit();
      }
    }
    this.state = state;
    this.ask();
    if (state.scene.obstacles?.length) this.loadObstacles();
  }

  async loadObstacles() {
    this.obstacles ??= await import("./obstacles.js");
    this.ask();
  }

  /** Takes the newest frame. @param {FrameMessage} message */
  setFrame(message) {
    if (this.message && message.frame.t < this.message.frame.t) this.clear();
    const before = this.message;
    this.message = message;
    if (before && before.tick === message.tick && before.echo === message.echo
      && before.frame.pose.every((value, i) => value === message.frame.pose[i])) return;
    this.trails.take(message, this.view.scale);
    this.force.take(message.frame.contacts);
    this.ask();
  }

  /** Clears trails and slips. */
  clear() {
    this.trails.clear();
    this.force.reset();
    this.ask();
  }

  /** Fits the scene into the window with the next drawing. */
  fit() {
    this.fitted = false;
    this.adjusted = false;
    this.ask();
  }

  /** Requests a drawing before the screen's next refresh. */
  ask() {
    if (this.asked) return;
    this.asked = true;
    requestAnimationFrame(this.work);
  }

  /** Draws, and measures. */
  draw() {
    this.asked = false;
    const begin = performance.now();
    const { state, message } = this;
    this.ctx.setTransform(this.ratio, 0, 0, this.ratio, 0, 0);
    this.ctx.fillStyle = colors.paper;
    this.ctx.fillRect(0, 0, this.view.width, this.view.height);
    if (!state || !message) return;
    this.aim(state.scene, message.frame);
    this.drawScene(this.ctx, this.view, this.buttons, state, message);
    for (const work of this.also) work();
    const end = performance.now();
    this.framesDrawn++;
    this.drawTimes.push(end - begin);
    if (message.echo !== null && message.echo > this.lastEcho) {
      this.lastEcho = message.echo;
      this.latencies.push(end - message.echo);
    }
  }

  /** Zooms about a point, or about the pointer that leads the hand. @param {number} factor @param {Spot | null} at */
  zoom(factor, at = this.leading) {
    this.adjusted = true;
    this.view.zoom(factor, at?.x, at?.y);
    this.ask();
  }

  /** @param {"object" | "knob" | "static" | "dynamic" | null} over what the pointer is over */
  setOver(over) {
    if (over === this.over) return;
    this.over = over;
    this.canvas.dataset.over = over ?? "";
    this.ask();
  }

  /** Returns true if the hand can be turned by its handle: it holds, or the pointer is at the object and it could. */
  handleShown() {
    const { state, message } = this;
    if (!state || !message || state.replay || this.editing) return false;
    const [x, y] = message.frame.hand;
    return message.holding !== null || (this.over !== null && placeOf(state.scene, message.frame.pose, [x, y], 0) !== null);
  }

  /**
   * Returns the cone whose end is at a position: the kind of its friction, its contact and what that touches; or null.
   * @param {Spot} at @param {number} slack px
   */
  coneAt(at, slack) {
    const { state, message, view } = this;
    if (!state || !message || !this.layers.cones || this.editing) return null;
    for (const [contact, surface] of this.contactsOf(message.frame, state.scene)) {
      const kind = coneAt(view, contact, surface, state.parameters, at, slack);
      if (kind) return { kind, point: contact.point, surface };
    }
    return null;
  }

  /** Fits or follows; a window that the reader has chosen stays. @param {Scene} scene @param {TraceFrame} frame */
  aim(scene, frame) {
    if (this.leading) return;
    if (!this.fitted) {
      this.view.fit(scene, frame.pose, frame.hand);
      this.fitted = true;
    } else if (!this.adjusted && !this.editing && this.view.follow(scene, frame.pose, frame.hand)) {
      this.ask();
    }
  }

  /** Draws what is visible into a canvas of another size, without the buttons over it. @param {Ink} ctx */
  paint(ctx) {
    const { state, message, view } = this;
    if (!state || !message) return;
    const { width, height } = ctx.canvas;
    const ratio = Math.min(width / view.width, height / (view.height - view.top));
    const [across, up] = [width / ratio, height / ratio];
    ctx.setTransform(ratio, 0, 0, ratio, 0, 0);
    ctx.fillStyle = colors.paper;
    ctx.fillRect(0, 0, across, up);
    this.drawScene(ctx, Object.assign(new View(), view, { width: across, height: up, top: 0 }), [], state, message);
  }

  /**
   * Draws the layers from back to front.
   * @param {Ink} ctx @param {View} view @param {import("./labels.js").Label[]} buttons places that texts avoid
   * @param {StateMessage} state @param {FrameMessage} message
   */
  drawScene(ctx, view, buttons, { scene, parameters }, { frame, holding, ghost }) {
    const { layers, trails, obstacles } = this;
    ctx.font = "12px system-ui, sans-serif";
    ctx.lineCap = "round";
    /** @type {import("./labels.js").Label[]} */
    const labels = [...buttons];
    drawGrid(ctx, view);
    obstacles?.drawObstacles(ctx, view, scene);
    drawSurfaces(ctx, view, scene.surfaces, labels);
    if (layers.trails) {
      trails.draw(ctx, view);
      trails.drawSlips(ctx, view);
    }
    if (ghost && layers.ghost) drawGhost(ctx, view, scene.body, ghost);
    drawBody(ctx, view, scene.body, frame.pose);
    const contacts = this.contactsOf(frame, scene);
    if (layers.cones) for (const [contact, surface] of contacts) drawCones(ctx, view, contact, surface, parameters, this.over);
    if (holding) {
      if (scene.body.length > 1) drawSpiral(ctx, view, holding, frame.pose[2], ghost ? ghost[2] - frame.pose[2] : 0);
      drawCoil(ctx, view, holding, frame.hand);
      drawHolding(ctx, view, holding);
    }
    const { perNewton } = this.force;
    if (layers.bars) for (const [contact, surface] of contacts) drawContact(ctx, view, contact, surface, perNewton);
    for (const [contact, surface] of contacts) drawSliding(ctx, view, contact, surface);
    obstacles?.drawCorners(ctx, view, frame.contacts);
    drawHand(ctx, view, frame.hand, holding !== null);
    if (this.handleShown()) drawHandle(ctx, view, frame.hand, this.over === "knob");
    const lines = [
      ...linesOfSurfaces(view, scene.surfaces), ...obstacles?.linesOfObstacles(view, scene.obstacles ?? []) ?? [],
      ...linesOfBody(view, scene.body, frame.pose), ...ghost ? linesOfBody(view, scene.body, ghost) : [],
      ...linesOfHand(view, frame.hand, holding),
      ...contacts.flatMap(([contact, surface]) => linesOfContact(view, contact, surface, parameters, perNewton)),
    ];
    const taken = { labels, lines };
    // The handles of the editor would be on them.
    if (layers.bars && layers.values && !this.editing) {
      for (const [contact, surface] of contacts) labelContact(ctx, view, contact, surface, perNewton, taken);
      obstacles?.nameCorners(ctx, view, frame.contacts, taken);
    }
    obstacles?.nameObstacles(ctx, view, scene.obstacles ?? [], taken);
    drawScales(ctx, view, perNewton);
  }

  /**
   * Returns the contacts of a frame with what they touch.
   * @param {TraceFrame} frame @param {Scene} scene @returns {[Contact, Facing][]}
   */
  contactsOf(frame, scene) {
    return frame.contacts.flatMap((contact) => {
      const surface = scene.surfaces.find(({ name }) => name === contact.surface);
      const solid = surface ?? scene.obstacles?.find(({ name }) => name === contact.obstacle);
      const normal = contact.direction ?? surface?.normal;
      return solid && normal ? [/** @type {[Contact, Facing]} */ ([contact, { ...solid, normal }])] : [];
    });
  }
}
