// How the page looks, in small and large windows, light and dark: nothing is cut, nothing overlaps, all can be read and
// has a name. STICTION_SCREENSHOTS: a folder that pictures are written to.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/** Windows (px), and pixels of the screen for one of them. */
const WINDOWS = [
  { width: 360, height: 740, ratio: 3 },
  { width: 1024, height: 768, ratio: 1.5 },
  { width: 1920, height: 1080, ratio: 1 },
];
const THEMES = /** @type {const} */ (["light", "dark"]);
/** No text is smaller (px), but for what stands below the line. */
const SMALLEST = 11;
const SMALLEST_INDEX = 9;
/** Least contrast of text (WCAG 2.2, 1.4.3). */
const CONTRAST = 4.5;
/** What the page may weigh (bytes). */
const WEIGHT = 202_000;
/** What has to have a name. */
const ROLES = [
  "button",
  "checkbox",
  "radio",
  "combobox",
  "listbox",
  "slider",
  "spinbutton",
  "textbox",
  "link",
  "application",
  "image",
  "dialog",
];

/**
 * The box in a corner, replayed until it has slipped a few times on both surfaces, and paused there.
 * @param {Live} live
 */
async function inCorner(live) {
  await live.scene("corner-stick-slip");
  await live.page.selectOption("#replay", "scene");
  await live.until(() => {
    const { counts, frame } = window.stiction.frame ?? {};
    return counts && frame && counts.slips > 3 && frame.contacts.length > 1;
  });
  await live.pause();
}

/** What is wrong with the layout. @param {Live} live */
function layoutFaults(live) {
  return live.page.evaluate(
    ([smallest, smallestIndex]) => {
      /** @type {string[]} */
      const faults = [];
      const wide = document.documentElement.clientWidth;
      if (document.documentElement.scrollWidth > wide) faults.push(`${document.documentElement.scrollWidth} px wide`);
      // A window that is wide enough for all beside one another does not scroll.
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
      // What the strip of scenes has scrolled out of sight is not there.
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

/** Writes a picture, where they are wanted. @param {Live} live @param {string} name */
async function picture(live, name) {
  const folder = process.env.STICTION_SCREENSHOTS;
  if (!folder) return;
  mkdirSync(folder, { recursive: true });
  await live.page.screenshot({ path: join(folder, `${name}.png`), fullPage: true });
}

for (const { width, height, ratio } of WINDOWS) {
  liveTest(`at ${width} px nothing is cut, nothing overlaps, and all is large and sharp enough`, async (bench) => {
    const live = await bench.open({ viewport: { width, height }, deviceScaleFactor: ratio });
    await inCorner(live);
    for (const theme of THEMES) {
      await live.page.emulateMedia({ colorScheme: theme });
      await live.until((wanted) => document.documentElement.dataset.theme === wanted, theme);
      await picture(live, `${width}-${theme}`);
      assert.deepEqual(await layoutFaults(live), []);
      await live.page.click("#help-open");
      await picture(live, `${width}-${theme}-help`);
      assert.deepEqual(
        await live.page.evaluate(() => {
          const help = /** @type {Element} */ (document.querySelector("#help"));
          const { top, right } = help.getBoundingClientRect();
          return [help.scrollWidth <= help.clientWidth, top >= 0 && right <= window.innerWidth, help.scrollTop];
        }),
        [true, true, 0],
      );
      await live.page.click("#help-close");
    }
  });
}

liveTest("the values of forces are not over one another, in the smallest window", async (bench) => {
  const live = await bench.open({ viewport: { width: 360, height: 740 } });
  await live.page.evaluate(() => {
    const { prototype } = CanvasRenderingContext2D;
    const { fillText } = prototype;
    /** The values of the drawing that is under way. @type {{text: string, x: number, y: number, width: number}[]} */
    const written = [];
    const values = { most: 0, over: /** @type {string[]} */ ([]) };
    Object.assign(window, { values });
    prototype.fillText = function (text, x, y) {
      fillText.call(this, text, x, y);
      if (this.canvas.id !== "stage") return;
      // The scales are the last in a drawing.
      if (text.endsWith("m")) written.length = 0;
      if (!/^[NT] /.test(text)) return;
      const { width } = this.measureText(text);
      const before = { left: 0, right: width, center: width / 2, start: 0, end: width }[this.textAlign];
      const mine = { text, x: x - before, y, width };
      for (const other of written) {
        const across = Math.min(mine.x + width, other.x + other.width) - Math.max(mine.x, other.x);
        if (across > 0 && Math.abs(other.y - y) < 11) values.over.push(`${text} over ${other.text}`);
      }
      written.push(mine);
      values.most = Math.max(values.most, written.length);
    };
  });
  for (const scene of ["corner-stick-slip", "parallel-walls"]) {
    await live.scene(scene);
    await live.page.selectOption("#replay", "scene");
    await live.until(() => {
      const { state, frame } = window.stiction;
      return state?.replay && (frame?.position ?? 0) >= Math.min(3, 0.99 * state.replay.seconds);
    });
  }
  const { most, over } = await live.page.evaluate(() => /** @type {any} */ (window).values);
  assert.ok(most >= 4, `${most} values at most`);
  assert.deepEqual(over, []);
});

liveTest("every control has a name", async (bench) => {
  const live = await bench.open();
  await live.scene("corner-stick-slip");
  const devtools = await live.page.context().newCDPSession(live.page);
  for (const dialog of [false, true]) {
    if (dialog) await live.page.click("#help-open");
    const { nodes } = await devtools.send("Accessibility.getFullAXTree");
    const controls = nodes.filter(({ ignored, role }) => !ignored && ROLES.includes(role?.value));
    assert.ok(controls.length > (dialog ? 1 : 30), `${controls.length} controls`);
    const nameless = controls
      .filter(({ name }) => !name?.value?.trim())
      .map(({ role, backendDOMNodeId }) => [role?.value, backendDOMNodeId]);
    assert.deepEqual(nameless, []);
    // Two of the same kind are told apart by their names.
    const names = controls.map(({ role, name }) => `${role?.value} ${name?.value}`);
    assert.deepEqual(
      names.filter((name, i) => names.indexOf(name) !== i),
      [],
    );
  }
});

/** Texts by their role, and what they stand on. */
const TEXTS = [
  ["ink", "page"],
  ["ink", "paper"],
  ["ink", "panel"],
  ["muted", "page"],
  ["muted", "paper"],
  ["muted", "panel"],
  ["muted", "solid"],
  ["accent", "panel"],
  ["on-accent", "accent"],
  ["warn", "panel"],
  ["warn", "paper"],
  ["normal", "paper"],
  ["friction", "paper"],
];

for (const theme of THEMES) {
  liveTest(`texts can be read in the ${theme} theme`, async (bench) => {
    const live = await bench.open({ colorScheme: theme });
    const faint = await live.page.evaluate(
      ([texts, least]) => {
        const probe = document.body.appendChild(document.createElement("i"));
        const luminance = (/** @type {string} */ role) => {
          probe.style.color = `var(--${role})`;
          const [r, g, b] = (getComputedStyle(probe).color.match(/[\d.]+/g) ?? []).map((text) => {
            const part = Number(text) / 255;
            return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
          });
          return 0.2126 * r + 0.7152 * g + 0.0722 * b;
        };
        const pairs = /** @type {string[][]} */ (texts).map(([text, ground]) => {
          const [a, b] = [luminance(text), luminance(ground)];
          return { text, ground, contrast: (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) };
        });
        return pairs.filter(({ contrast }) => !(contrast >= Number(least)));
      },
      [TEXTS, CONTRAST],
    );
    assert.deepEqual(faint, []);
  });
}

liveTest("the page is light, and loads what talks to a board only when asked", async (bench) => {
  const context = await bench.browser.newContext();
  const page = await context.newPage();
  /** @type {Map<string, Promise<Buffer>>} */
  const bodies = new Map();
  page.on("response", (response) => bodies.set(new URL(response.url()).pathname, response.body()));
  await page.goto(`${bench.program.origin}/`, { waitUntil: "load" });
  await page.waitForFunction(() => window.stiction?.framesDrawn > 10);
  const files = await Promise.all([...bodies].map(async ([path, body]) => ({ path, size: (await body).length })));
  await context.close();
  const weight = files.reduce((sum, { size }) => sum + size, 0);
  assert.ok(files.length > 10 && weight > 50_000, `${files.length} files`);
  assert.ok(weight <= WEIGHT, `${weight} bytes`);
  assert.ok(!files.some(({ path }) => path.includes("board")));
});
