// Explanations of names and symbols of the page: each one is stated once, in `data-tip` of its element. It is the title and the
// description of the controls there, and a button of the group shows all of the group, for fingers and keyboards.

/** Adds the explanations to the page. */
export function startTips() {
  document.querySelectorAll("[data-tips]").forEach((group, i) => {
    const list = element("dl");
    for (const term of /** @type {NodeListOf<HTMLElement>} */ (group.querySelectorAll("[data-tip]"))) {
      const tip = (term.dataset.tip ?? "").replace(/\s+/g, " ");
      for (const described of [term, ...term.querySelectorAll("input, select")]) described.setAttribute("title", tip);
      const name = element("dt", term.dataset.term);
      // A symbol is shown as in its label.
      if (!name.textContent) name.append(...(term.querySelector("label")?.cloneNode(true).childNodes ?? []));
      list.append(name, element("dd", tip));
    }
    const popover = document.createElement("div");
    popover.id = `tips-${i}`;
    popover.className = "tips";
    popover.popover = "auto";
    popover.append(list);
    const button = element("button", "i");
    button.className = "tip";
    button.setAttribute("type", "button");
    button.setAttribute("popovertarget", popover.id);
    button.setAttribute("aria-label", `What it means: ${group.getAttribute("data-tips")}`);
    (group.querySelector("[data-tip-button]") ?? group).append(button);
    document.body.append(popover);
  });
}

/** @param {string} name @param {string} [text] */
function element(name, text = "") {
  const made = document.createElement(name);
  made.textContent = text;
  return made;
}
