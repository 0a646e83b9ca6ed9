// The scene as a file: opened by a button or dropped onto the page, saved, and edited. Other dropped files are paths of the
// hand.

import { byId } from "./dom.js";
import { Editor } from "./editor.js";

/** Lifetime of a link to a text (ms). */
const SOON = 10_000;

/** @type {Editor | null} */
let editor = null;

/**
 * The parts of the page used here; without a server there is no transport of files, and the solver's side takes scenes itself.
 * @typedef {{stage: Stage, feed: Partial<Files>, tell: (text: string) => void,
 *   transport: import("./transport.js").Transport | null}} Page
 */

/**
 * Runs the action of a button, or takes a file.
 * @param {string} what @param {File | undefined} file @param {Page} page
 */
export function use(what, file, page) {
  if (what === "edit") toggleEditor(page);
  else if (what === "save-scene") save(page);
  else if (what === "open-scene") open(page);
  else if (file) take(page, file);
}

/** @param {Page} page @returns {Files} */
const filesOf = ({ feed }) => ({ file: (path, name, body) => (feed.file ? feed.file(path, name, body) : ask(path, name, body)) });

/**
 * Asks the server. @param {"scene" | "edit" | "scene.toml"} path @param {string} name @param {string | null} body
 */
async function ask(path, name, body) {
  const response = await (body === null ? fetch(path)
    : fetch(`${path}?name=${encodeURIComponent(name)}`, { method: "POST", body }));
  const text = await response.text();
  if (!response.ok) throw new Error(problemIn(text));
  return text;
}

/** Returns the problem in an answer. @param {string} text */
function problemIn(text) {
  try {
    return JSON.parse(text).message;
  } catch {
    return text || "The server refused it.";
  }
}

/** Loads the style of the editor, once. */
function addStyle() {
  if (document.querySelector("link[data-editor]")) return;
  const link = document.createElement("link");
  Object.assign(link, { rel: "stylesheet", href: "editor.css" });
  link.dataset.editor = "";
  document.head.append(link);
}

/** Opens the editor, or closes it. @param {Page} page */
function toggleEditor(page) {
  if (editor) {
    editor.close();
    return;
  }
  addStyle();
  editor = new Editor(page.stage, () => filesOf(page), page.tell, () => {
    editor = null;
    byId("edit").setAttribute("aria-pressed", "false");
  });
  byId("edit").setAttribute("aria-pressed", "true");
}

/** Saves the scene that is shown, as a file that can be run. @param {Page} page */
async function save(page) {
  try {
    const text = await filesOf(page).file("scene.toml", "", null);
    const url = URL.createObjectURL(new Blob([text], { type: "application/toml" }));
    const download = `${page.stage.state?.scene.title ?? "scene"}.toml`;
    Object.assign(document.createElement("a"), { href: url, download }).click();
    setTimeout(() => URL.revokeObjectURL(url), SOON);
  } catch (why) {
    page.tell(`The scene cannot be saved. ${/** @type {Error} */ (why).message}`);
  }
}

/** Asks the reader for a file. @param {Page} page */
function open(page) {
  const input = byId("scene-file", HTMLInputElement);
  input.onchange = () => {
    const [file] = input.files ?? [];
    if (file) take(page, file);
    input.value = "";
  };
  input.click();
}

/** Shows the scene of a file, or makes the hand follow its path. @param {Page} page @param {File} file */
async function take(page, file) {
  if (/\.(csv|tum|txt)$/i.test(file.name)) {
    if (page.transport) page.transport.upload(file);
    else page.tell(`${file.name}: paths of the hand (.csv, .tum, .txt) are replayed by the program, stiction view. `
      + "Allowed here: a scene (.toml).");
    return;
  }
  try {
    await filesOf(page).file("scene", file.name, await file.text());
    // What was wrong with an earlier file no longer matters.
    page.tell("");
  } catch (why) {
    page.tell(`${file.name} cannot be used. ${/** @type {Error} */ (why).message}`);
  }
}
