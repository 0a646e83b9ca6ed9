// Faults in the layout of a page, for tests of its appearance.

/** Smallest text (px), and smallest subscript. */
const SMALLEST = 11;
const SMALLEST_INDEX = 9;

/** Returns the faults in the layout. @param {import("./live.js").Live} live */
export function layoutFaults(live) {
  return live.page.evaluate(
    ([smallest, smallestIndex]) => {
      /** @type {string[]} */
      const faults = [];
      const wide = document.documentElement.clientWidth;
      if (document.documentElement.scrollWidth > wide) faults.push(`${document.documentElement.scrollWidth} px wide`);
      // A window wide enough for all columns next to each other does not scroll.
      const tall = document.documentElement.scrollHeight - window.innerHeight;
      if (window.matchMedia("(min-width: 901px)").matches && tall > 0) faults.push(`${tall} px too high`);
      for (const key of document.querySelectorAll(".key")) {
        const parent = /** @type {Element} */ (key.parentElement);
        if (parent.getBoundingClientRect().height > 2 * parseFloat(getComputedStyle(parent).fontSize)) {
          faults.push(`“${parent.textContent}” is on another line than its key`);
        }
      }
      const name = (/** @type {Element} */ element) =>
        element.id || `${element.tagName} “${element.textContent?.trim().slice(0, 30)}”`;
      // Cards that the strip of scenes has scrolled out of sight do not count.
      const strip = /** @type {Element} */ (document.querySelector("#cards")).getBoundingClientRect();
      const shown = (/** @type {Element} */ element) =>
        element.checkVisibility({ visibilityProperty: true, opacityProperty: true }) &&
        !element.closest(".hidden, dialog:not([open])");

      for (const element of document.body.querySelectorAll("*")) {
        if (!shown(element) || element.closest("svg, .chart")) continue;
        const { left, right, width } = element.getBoundingClientRect();
        if (width > 0 && !element.closest("#cards > *") && (left < -0.5 || right > wide + 0.5))
          faults.push(`${name(element)} from ${left} to ${right} px`);
        const clips = element.matches("button, select, p, dd, dt, td, th, label, figcaption, h1, h2, a, li, output");
        if (clips && element.scrollWidth > element.clientWidth + 1 && element.clientWidth > 0)
          faults.push(`${name(element)} is cut`);
      }
      const ruler = /** @type {OffscreenCanvasRenderingContext2D} */ (new OffscreenCanvas(1, 1).getContext("2d"));
      for (const list of document.querySelectorAll("select")) {
        if (!shown(list)) continue;
        const style = getComputedStyle(list);
        ruler.font = `${style.fontSize} ${style.fontFamily}`;
        const room = list.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight);
        const text = list.selectedOptions[0]?.text ?? "";
        if (ruler.measureText(text).width > room) faults.push(`“${text}” is cut in ${name(list)}`);
      }

      /** @type {{text: string, box: DOMRect}[]} */
      const texts = [];
      const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
      for (let node = walker.nextNode(); node; node = walker.nextNode()) {
        const parent = node.parentElement,
          text = node.textContent?.trim();
        if (!parent || !text || !shown(parent) || parent.closest("option, script")) continue;
        const scale = parent instanceof SVGGraphicsElement ? (parent.getScreenCTM()?.a ?? 1) : 1;
        const size = scale * parseFloat(getComputedStyle(parent).fontSize);
        if (size < (parent.closest("sub") ? smallestIndex : smallest) - 0.01) faults.push(`“${text}” has ${size} px`);
        const range = document.createRange();
        range.selectNodeContents(node);
        for (const box of range.getClientRects()) {
          const isOut = parent.closest("#cards") && (box.right > strip.right || box.left < strip.left);
          if (box.width > 0 && !isOut) texts.push({ text, box });
        }
      }
      texts.forEach(({ text, box }, i) => {
        for (const other of texts.slice(i + 1)) {
          const across = Math.min(box.right, other.box.right) - Math.max(box.left, other.box.left);
          const down = Math.min(box.bottom, other.box.bottom) - Math.max(box.top, other.box.top);
          // The lines of a text may touch; letters leave room above and below.
          if (across > 1 && down > 0.35 * Math.min(box.height, other.box.height))
            faults.push(`“${text}” is over “${other.text}”`);
        }
      });

      for (const canvas of document.querySelectorAll("canvas")) {
        if (!shown(canvas)) continue;
        const { width, height } = canvas.getBoundingClientRect();
        const [across, down] = [width, height].map((size) => size * window.devicePixelRatio);
        if (Math.abs(canvas.width - across) > 1 || Math.abs(canvas.height - down) > 1) {
          faults.push(`a canvas of ${canvas.width} by ${canvas.height} on ${across} by ${down} pixels`);
        }
      }
      return faults;
    },
    [SMALLEST, SMALLEST_INDEX],
  );
}
