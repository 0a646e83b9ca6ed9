// The gallery: a card for each scene, with its picture and its name, and the story of the current one. The cards are radio
// buttons: arrow keys select, and Tab leaves the group.

import { byId, setText } from "./dom.js";
import { FRICTION } from "./stage.js";

/** Windows of this width do not scroll themselves: the wheel scrolls the gallery. */
const wide = window.matchMedia("(min-width: 901px)");

/**
 * `content`: the scene's content when it was last shown, or null.
 * @typedef {{input: HTMLInputElement, picture: HTMLElement, story: string | null, drawn: boolean, content: string | null}} Card
 */

export class Gallery {
  /** @param {(name: string) => Promise<boolean>} choose requests a scene, perhaps the current one; false if it is refused */
  constructor(choose) {
    this.choose = choose;
    this.cards = byId("cards");
    this.story = byId("story");
    /** @type {Map<string, Card>} */
    this.scenes = new Map();
    /** The scene that is shown. */
    this.title = "";
    /** Loads the picture of a card when the card comes into view. */
    this.near = new IntersectionObserver((entries) => entries.forEach(({ isIntersecting, target }) => {
      if (!isIntersecting || !(target instanceof HTMLElement)) return;
      this.near.unobserve(target);
      draw(target.dataset.scene ?? "", target);
    }), { root: this.cards });
    /** Selections without an answer: until then the strip shows the last selection, from which arrow keys continue. */
    this.waiting = 0;
    // Nothing scrolls while it is closed.
    byId("scenes-open").addEventListener("click", () => this.reveal());
    this.cards.addEventListener("wheel", (event) => this.wheel(event), { passive: false });
  }

  /** Takes the scenes to choose from. @param {HelloMessage} hello */
  setHello({ scenes, stories }) {
    this.scenes.clear();
    this.cards.replaceChildren();
    this.cards.append(...scenes.map((name, i) => this.add(name, stories?.[i] ?? null, stories !== undefined)));
    this.title = "";
  }

  /**
   * Adds cards for new scenes, in front, and removes those of deleted scenes.
   * @param {string[]} names @param {boolean} drawn whether there are pictures of them
   */
  list(names, drawn) {
    for (const [name, { input }] of this.scenes) {
      if (names.includes(name)) continue;
      input.closest("label")?.remove();
      this.scenes.delete(name);
    }
    for (const name of names.filter((name) => !this.scenes.has(name))) this.cards.prepend(this.add(name, null, drawn));
  }

  /** Makes a card. @param {string} name @param {string | null} story @param {boolean} drawn whether there is a picture of it */
  add(name, story, drawn) {
    const input = document.createElement("input");
    Object.assign(input, { id: `scene-${name}`, type: "radio", name: "scene", value: name, title: story ?? "" });
    input.addEventListener("change", () => this.pick(name));
    // A click on the card of the current scene restarts it.
    input.addEventListener("click", () => { if (name === this.title) this.pick(name); });
    const picture = document.createElement("span"), label = document.createElement("span");
    picture.className = "picture";
    label.textContent = name;
    const card = document.createElement("label");
    card.className = "card";
    card.append(input, picture, label);
    this.scenes.set(name, { input, picture, story, drawn, content: null });
    picture.dataset.scene = name;
    if (drawn) this.near.observe(picture);
    return card;
  }

  /** Shows a state. Adds a card for its scene if it has none. @param {StateMessage} state */
  show({ scene, scenes }) {
    const { title, story } = scene;
    // Only a program that lists its scenes has pictures of those added later.
    const drawsAll = scenes !== undefined && document.body.dataset.alone === undefined;
    this.list([...new Set([...(scenes ?? this.scenes.keys()), title])], drawsAll);
    const card = /** @type {Card} */ (this.scenes.get(title));
    if (story !== undefined) card.story = story;
    card.input.title = card.story ?? "";
    this.title = title;
    redraw(card, scene, drawsAll);
    this.select(title);
  }

  /** Shows a scene as the selected one, unless another selection waits for its answer. @param {string} title */
  select(title) {
    const card = this.scenes.get(title);
    if (this.waiting > 0 || !card) return;
    const { input, story } = card;
    setText(this.story, story ?? "");
    if (input.checked) return;
    input.checked = true;
    this.reveal();
  }

  /** Takes the selection of a scene. @param {string} name */
  async pick(name) {
    this.waiting++;
    const taken = await this.choose(name);
    this.waiting--;
    this.select(taken ? name : this.title);
  }

  /** Scrolls the strip, and nothing else, until the selected card is visible. */
  reveal() {
    const card = this.cards.querySelector(":scope > :has(:checked)");
    if (!card) return;
    const { left, right } = this.cards.getBoundingClientRect();
    const place = card.getBoundingClientRect();
    this.cards.scrollLeft += Math.min(0, place.left - left) + Math.max(0, place.right - right);
  }

  /** Scrolls the strip sideways by a vertical wheel. @param {WheelEvent} event */
  wheel(event) {
    if (!wide.matches || event.deltaX || event.ctrlKey) return;
    event.preventDefault();
    this.cards.scrollLeft += event.deltaY;
  }
}

/**
 * Draws the picture of a scene that has none, or that was edited since.
 * @param {Card} card @param {Scene} scene @param {boolean} isServed whether the program has pictures of all scenes
 */
async function redraw(card, scene, isServed) {
  const { title, body, start, surfaces, obstacles } = scene;
  const content = JSON.stringify([body, start, surfaces, obstacles], (name, value) => (FRICTION.includes(name) ? undefined : value));
  const isDrawn = card.drawn && (card.content === null || card.content === content);
  Object.assign(card, { content, drawn: true });
  if (isDrawn) return;
  if (isServed) draw(title, card.picture);
  else put((await import("./shown.js")).sketch(scene), card.picture);
}

/** Pictures included in a page that is a single file. @type {{[name: string]: string} | null} */
const packed = JSON.parse(document.querySelector("#pictures")?.textContent ?? "null");

/**
 * Draws the picture of a scene as a part of the page, so that it has the colours of the theme.
 * @param {string} name @param {HTMLElement} place
 */
async function draw(name, place) {
  try {
    const text = packed?.[name] ?? await fetched(`scenes/${encodeURIComponent(name)}.svg`);
    put(text, place);
  } catch {
    // The card still has its name.
  }
}

/** Puts a picture into its place. @param {string} text SVG @param {HTMLElement} place */
function put(text, place) {
  const { documentElement } = new DOMParser().parseFromString(text, "image/svg+xml");
  documentElement.setAttribute("aria-hidden", "true");
  place.replaceChildren(document.importNode(documentElement, true));
}

/** @param {string} address */
async function fetched(address) {
  const response = await fetch(address);
  if (!response.ok) throw new Error(response.statusText);
  return response.text();
}
