// Light and dark: follows the system until the reader chooses; provides the colours of the style sheet to drawing code.

import { byId, setText } from "./dom.js";

const KEY = "stiction-theme";
const dark = window.matchMedia("(prefers-color-scheme: dark)");

/** Names of the colours for drawing, as in style.css. */
const NAMES = /** @type {const} */ ([
  "paper", "ink", "muted", "grid", "solid", "hatch", "body", "body-fill", "ghost", "hand", "spring", "normal",
  "friction", "reaction", "cone-static", "cone-dynamic", "slip", "trail-hand", "trail-body", "limit-static",
  "limit-dynamic", "accent",
]);

/** Colours by name, read again when the theme changes. @type {Record<typeof NAMES[number], string>} */
export const colors = /** @type {any} */ ({});

/** @type {(() => void)[]} */
const listeners = [];

/** Calls a listener whenever the colours have changed. @param {() => void} listener */
export function onTheme(listener) {
  listeners.push(listener);
}

/** Returns the reader's choice, if there is one. @returns {string | null} */
function chosen() {
  try {
    return localStorage.getItem(KEY);
  } catch {
    return null;
  }
}

/** Stores the choice, if the browser permits it. @param {string} theme */
function remember(theme) {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    // A private window: the choice is valid until the page is closed.
  }
}

/** Sets the theme and reads its colours. @param {string} theme */
function apply(theme) {
  document.documentElement.dataset.theme = theme;
  const probe = document.body.appendChild(document.createElement("i"));
  for (const name of NAMES) {
    probe.style.color = `var(--${name})`;
    colors[name] = getComputedStyle(probe).color;
  }
  probe.remove();
  const button = byId("theme", HTMLButtonElement);
  const other = theme === "dark" ? "light" : "dark";
  setText(button, theme === "dark" ? "Light" : "Dark");
  button.setAttribute("aria-label", `Switch to ${other} colours`);
  for (const listener of listeners) listener();
}

/** Starts with the system's theme or the reader's, and connects the button that changes it. */
export function startTheme() {
  const system = () => (dark.matches ? "dark" : "light");
  apply(chosen() ?? system());
  dark.addEventListener("change", () => apply(chosen() ?? system()));
  byId("theme", HTMLButtonElement).addEventListener("click", () => {
    const theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    remember(theme);
    apply(theme);
  });
}
