// The scene as a file: opened by a button or dropped onto the page, saved, and edited. What is dropped besides is a path of the hand.

import { Editor } from "./editor.js";

/** A link to a text stays good for so long (ms). */
const SOON = 10_000;

/** @type {Editor | null} */
let editor = null;

/**
 * What the page is to these.
 * @typedef {{stage: Stage, feed: () => Files, tell: (text: string) => void, upload: (file: File) => void}} Page
 */

/** The style of the editor, once. */
function addStyle() {
  if (document.querySelector("link[data-editor]")) return;
  const link = document.createElement("link");
  Object.assign(link, { rel: "stylesheet", href: "editor.css" });
  link.dataset.editor = "";
  document.head.append(link);
}

/** Opens the editor, or closes it. @param {Page} page */
export function toggleEditor({ stage, feed, tell }) {
  const edit = /** @type {HTMLElement} */ (document.getElementById("edit"));
  if (editor) {
    editor.close();
    return;
  }
  addStyle();
  editor = new Editor(stage, feed, tell, () => {
    editor = null;
    edit.setAttribute("aria-pressed", "false");
  });
  edit.setAttribute("aria-pressed", "true");
}

/** The state has changed. */
export const setState = () => editor?.setState();

/** Saves the scene that is shown, as a file that can be run. @param {Page} page */
export async function save({ stage, feed, tell }) {
  try {
    const text = await feed().file("scene.toml", "", null);
    const url = URL.createObjectURL(new Blob([text], { type: "application/toml" }));
    const download = `${stage.state?.scene.title ?? "scene"}.toml`;
    Object.assign(document.createElement("a"), { href: url, download }).click();
    setTimeout(() => URL.revokeObjectURL(url), SOON);
  } catch (why) {
    tell(`The scene cannot be saved. ${/** @type {Error} */ (why).message}`);
  }
}

/** Shows the scene of a file, or has the hand follow its path. @param {Page} page @param {File} file */
export async function take({ feed, tell, upload }, file) {
  if (/\.(csv|tum|txt)$/i.test(file.name)) {
    upload(file);
    return;
  }
  try {
    await feed().file("scene", file.name, await file.text());
  } catch (why) {
    tell(`${file.name} cannot be used. ${/** @type {Error} */ (why).message}`);
  }
}
