// Parts of the page that a button opens and closes: the gallery of scenes, and the details. A browser remembers what was open.

/** @param {string} name */
const keyOf = (name) => `stiction-${name}`;

/** Returns true if the part was open when the page was last left. @param {string} name */
function wasOpen(name) {
  try {
    return localStorage.getItem(keyOf(name)) === "open";
  } catch {
    return false;
  }
}

/** Opens or closes a part. @param {HTMLElement} button @param {boolean} open */
function set(button, open) {
  const name = button.dataset.panel ?? "";
  document.body.dataset[name] = open ? "open" : "closed";
  button.setAttribute("aria-expanded", String(open));
  try {
    localStorage.setItem(keyOf(name), open ? "open" : "closed");
  } catch {
    // A private window: the choice is valid until the page is closed.
  }
}

/** Connects the buttons. */
export function startPanels() {
  for (const button of /** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll("[data-panel]"))) {
    const name = button.dataset.panel ?? "";
    set(button, wasOpen(name));
    button.addEventListener("click", () => set(button, document.body.dataset[name] !== "open"));
  }
}
