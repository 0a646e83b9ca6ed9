// The appearance of the page, in small and large windows, light and dark: nothing is cut off, nothing overlaps, everything is
// readable and has a name. STICTION_SCREENSHOTS: a folder for pictures.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { layoutFaults } from "./layout.js";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/** Windows (px), and screen pixels per px. */
const WINDOWS = [
  { width: 360, height: 740, ratio: 3 },
  { width: 1024, height: 768, ratio: 1.5 },
  { width: 1920, height: 1080, ratio: 1 },
];
const THEMES = /** @type {const} */ (["light", "dark"]);
/** Least contrast of text (WCAG 2.2, 1.4.3), and of the drawing and the borders of controls (1.4.11). */
const CONTRAST = 4.5;
const SIGNS = 3;
/** Opacity of the oldest parts of trails and the oldest marks of slips, as in trails.js. */
const FAINTEST = 0.8;
/** Largest size of what a browser has to load (bytes). */
const WEIGHT = 250_000;
/** Roles that must have a name. */
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
 * Replays the box in a corner until it has slipped a few times on both surfaces, and pauses there.
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

/** Writes a picture, if pictures are requested. @param {Live} live @param {string} name */
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

liveTest("texts in the drawing are not over one another, in the smallest window", async (bench) => {
  const live = await bench.open({ viewport: { width: 360, height: 740 } });
  await live.page.evaluate((height) => {
    const { prototype } = CanvasRenderingContext2D;
    const { fillText, fillRect } = prototype;
    /** Texts of the drawing in progress, in pixels of the canvas. @type {{text: string, xs: number[], ys: number[]}[]} */
    let written = [];
    const texts = { most: 0, corners: 0, over: /** @type {string[]} */ ([]) };
    Object.assign(window, { texts });
    prototype.fillRect = function (x, y, w, h) {
      // A drawing begins with its background.
      if (this.canvas.id === "stage" && x === 0 && y === 0) written = [];
      fillRect.call(this, x, y, w, h);
    };
    prototype.fillText = function (text, x, y) {
      fillText.call(this, text, x, y);
      if (this.canvas.id !== "stage") return;
      const { width } = this.measureText(text);
      const left = x - { left: 0, right: width, center: width / 2, start: 0, end: width }[this.textAlign];
      const middle = this.textBaseline === "middle" ? y : y - height / 2;
      const [one, other] = [[left, middle - height / 2], [left + width, middle + height / 2]].map(([px, py]) =>
        this.getTransform().transformPoint(new DOMPoint(px, py)),
      );
      const mine = { text, xs: [one.x, other.x].sort((p, q) => p - q), ys: [one.y, other.y].sort((p, q) => p - q) };
      const apart = (/** @type {number[]} */ p, /** @type {number[]} */ q) => p[0] >= q[1] || q[0] >= p[1];
      for (const known of written) {
        if (!apart(mine.xs, known.xs) && !apart(mine.ys, known.ys)) texts.over.push(`${text} over ${known.text}`);
      }
      written.push(mine);
      texts.most = Math.max(texts.most, written.filter((known) => /^[NT] /.test(known.text)).length);
      if (text.includes("corner")) texts.corners++;
    };
  }, 11);
  for (const scene of ["corner-stick-slip", "parallel-walls", "peg-in-hole", "step"]) {
    await live.scene(scene);
    await live.page.selectOption("#replay", "scene");
    await live.until(() => {
      const { state, frame } = window.stiction;
      return state?.replay && (frame?.position ?? 0) >= Math.min(3, 0.99 * state.replay.seconds);
    });
  }
  const { most, corners, over } = await live.page.evaluate(() => /** @type {any} */ (window).texts);
  assert.ok(most >= 4 && corners > 10, `${most} values at most, corners named ${corners} times`);
  assert.deepEqual([...new Set(over)], []);
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
    // Two of the same kind differ by their names.
    const names = controls.map(({ role, name }) => `${role?.value} ${name?.value}`);
    assert.deepEqual(
      names.filter((name, i) => names.indexOf(name) !== i),
      [],
    );
  }
});

/** Colours in the drawing, by role, with their background. */
const DRAWN = [
  ["body", "paper"],
  ["ghost", "paper"],
  ["hand", "paper"],
  ["spring", "paper"],
  ["normal", "paper"],
  ["friction", "paper"],
  ["friction", "solid"],
  ["reaction", "paper"],
  ["limit-static", "paper"],
  ["limit-dynamic", "paper"],
  ["hatch", "solid"],
  ["trail-hand", "paper", FAINTEST],
  ["trail-body", "paper", FAINTEST],
  ["slip", "solid", FAINTEST],
  ["edge", "panel"],
  ["edge", "paper"],
  ["accent", "panel"],
  ["accent", "paper"],
  ["accent", "page"],
];
/** Texts in the drawing. */
const TEXTS = [
  ["muted", "solid"],
  ["muted", "paper"],
  ["normal", "paper"],
  ["friction", "paper"],
];

/** Adds `contrast(element or role, ground, alpha)` and `groundOf(element)` to the page (WCAG 2.2). @param {Live} live */
const bringContrast = (live) =>
  live.page.evaluate(() => {
    const dot = /** @type {OffscreenCanvasRenderingContext2D} */ (
      new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true })
    );
    /**
     * Mixes colours over one another, the lowest first, as the browser does.
     * @param {string[]} layers @param {number} alpha of the last one
     */
    const mixed = (layers, alpha = 1) => {
      layers.forEach((color, i) => {
        dot.globalAlpha = i === layers.length - 1 ? alpha : 1;
        dot.fillStyle = color;
        dot.fillRect(0, 0, 1, 1);
      });
      return [...dot.getImageData(0, 0, 1, 1).data].slice(0, 3);
    };
    const luminance = (/** @type {number[]} */ rgb) => {
      const [r, g, b] = rgb.map((value) => {
        const part = value / 255;
        return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
      });
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const contrast = (/** @type {string} */ color, /** @type {string[]} */ grounds, alpha = 1) => {
      const [a, b] = [luminance(mixed([...grounds, color], alpha)), luminance(mixed(grounds))];
      return (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    };
    const ofRole = (/** @type {string} */ role) => {
      const probe = document.body.appendChild(document.createElement("i"));
      probe.style.color = `var(--${role})`;
      const { color } = getComputedStyle(probe);
      probe.remove();
      return color;
    };
    /** Returns the backgrounds under an element, the lowest first. @param {Element | null} element @returns {string[]} */
    const groundsOf = (element) => {
      if (!element) return [ofRole("page")];
      return [...groundsOf(element.parentElement), getComputedStyle(element).backgroundColor];
    };
    Object.assign(window, { contrast, ofRole, groundsOf });
  });

for (const theme of THEMES) {
  liveTest(`all can be read and stands out from its ground in the ${theme} theme`, async (bench) => {
    const live = await bench.open({ colorScheme: theme });
    await inCorner(live);
    await bringContrast(live);
    const faint = await live.page.evaluate(
      ([texts, drawn, ofText, ofSign]) => {
        const { contrast, ofRole, groundsOf } = /** @type {any} */ (window);
        /** @type {string[]} */
        const faults = [];
        const check = (/** @type {string} */ what, /** @type {number} */ ratio, /** @type {number} */ least) => {
          if (!(ratio >= least)) faults.push(`${what}: ${ratio.toFixed(2)}`);
        };
        for (const [role, ground, alpha = 1] of drawn) {
          check(`${role} on ${ground}`, contrast(ofRole(role), [ofRole(ground)], alpha), ofSign);
        }
        for (const [role, ground] of texts) check(`${role} on ${ground}`, contrast(ofRole(role), [ofRole(ground)]), ofText);
        let count = 0;
        for (const element of document.body.querySelectorAll("*")) {
          const isOff = element.closest(":disabled, [aria-disabled=true], script, option, canvas, dialog");
          if (isOff || !element.checkVisibility()) continue;
          const style = getComputedStyle(element);
          const name = element.id || `${element.tagName} “${element.textContent?.trim().slice(0, 20)}”`;
          const says = [...element.childNodes].some((node) => node.nodeType === Node.TEXT_NODE && node.textContent?.trim());
          const isDrawn = element instanceof SVGElement;
          if (says && !isDrawn) {
            count++;
            check(name, contrast(style.color, groundsOf(element)), ofText);
          }
          if (element.matches("button, select, input:not([type=range], [type=checkbox])")) {
            check(`border of ${name}`, contrast(style.borderTopColor, groundsOf(element.parentElement)), ofSign);
          }
        }
        // The diagram: its texts on their boxes, links and borders on the panel.
        for (const node of document.querySelectorAll(".node")) {
          const [box, text] = [node.querySelector("rect"), node.querySelector("text")].map((part) => getComputedStyle(/** @type {Element} */ (part)));
          check(`${node.textContent}`, contrast(text.fill, [box.fill]), ofText);
          check(`box of ${node.textContent}`, contrast(box.stroke, [ofRole("panel")]), ofSign);
        }
        for (const link of document.querySelectorAll(".link")) {
          check("a link", contrast(getComputedStyle(link).stroke, [ofRole("panel")]), ofSign);
        }
        return { faults: [...new Set(faults)], count };
      },
      /** @type {const} */ ([TEXTS, DRAWN, CONTRAST, SIGNS]),
    );
    assert.deepEqual(faint.faults, []);
    assert.ok(faint.count > 60, `${faint.count} texts`);
  });
}

liveTest("the page is light, and loads what talks to a board only when asked", async (bench) => {
  const context = await bench.browser.newContext();
  const page = await context.newPage();
  /** @type {Promise<{path: string, plain: number, sent: number, encoding: string | undefined}>[]} */
  const coming = [];
  page.on("response", (response) =>
    coming.push(
      (async () => {
        const headers = await response.allHeaders();
        const path = new URL(response.url()).pathname;
        return {
          path,
          plain: (await response.body()).length,
          sent: Number(headers["content-length"]),
          encoding: headers["content-encoding"],
        };
      })(),
    ),
  );
  await page.goto(`${bench.program.origin}/`, { waitUntil: "load" });
  await page.waitForFunction(() => window.stiction?.framesDrawn > 10);
  const files = await Promise.all(coming);
  await context.close();
  assert.ok(files.length > 10 && !files.some(({ path }) => path.includes("board")));
  const sum = (/** @type {"plain" | "sent"} */ what) => files.reduce((total, file) => total + file[what], 0);
  assert.ok(sum("plain") > 50_000 && sum("sent") <= WEIGHT, `${sum("sent")} of ${sum("plain")} bytes`);
  // Text files shrink to less than half, and a browser without gzip gets them uncompressed.
  assert.ok(files[0].encoding === "gzip" && sum("sent") < sum("plain") / 2, `${sum("sent")} of ${sum("plain")} bytes`);
  const { path, plain } = files[0];
  const bare = await fetch(`${bench.program.origin}${path}`, { headers: { "accept-encoding": "identity" } });
  assert.equal(bare.headers.get("content-encoding"), null);
  assert.equal(bare.headers.get("vary"), "accept-encoding");
  assert.equal((await bare.arrayBuffer()).byteLength, plain);
});
