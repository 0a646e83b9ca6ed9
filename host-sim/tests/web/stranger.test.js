// The way of a stranger through the page without a server, with a mouse, in windows of a laptop and a phone: see a slip and read what
// happened, change the friction, draw an object of one's own, close it, save it, and send a link that shows it elsewhere. Nothing
// on the way needs scrolling. STICTION_SCREENSHOTS: a folder for pictures.

import assert from "node:assert/strict";
import { mkdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Host, missingPage } from "./alone.js";
import { Live, shared } from "./live.js";

const WINDOWS = [{ width: 1280, height: 800 }, { width: 1440, height: 900 }, { width: 390, height: 844 }];
/** Drawings that are closed on their first point, of each number of corners. */
const DRAWINGS = 3;
const CORNERS = [3, 4, 5, 6];
/** Distance of the corners from the middle of the drawing (px). */
const RADIUS = 50;

/** Writes a picture, if pictures are requested. @param {Live} live @param {string} name */
async function picture(live, name) {
  const folder = process.env.STICTION_SCREENSHOTS;
  if (!folder) return;
  mkdirSync(folder, { recursive: true });
  await live.page.screenshot({ path: join(folder, `stranger-${name}.png`) });
}

/** Returns the box (CSS px) of a part of the page, all of which is in the window as it is. @param {Live} live @param {string} what */
async function seen({ page }, what) {
  const box = await page.locator(what).boundingBox();
  const [width, height, scrolled] = await page.evaluate(() => [window.innerWidth, window.innerHeight, window.scrollY]);
  assert.ok(box, what);
  const isInside = box.x >= 0 && box.y >= 0 && box.x + box.width <= width && box.y + box.height <= height;
  assert.ok(isInside && scrolled === 0, `${what} is at ${JSON.stringify(box)} of ${width} by ${height}, scrolled by ${scrolled}`);
  return box;
}

/** Presses what is in the window as it is. @param {Live} live @param {string} what */
async function press(live, what) {
  const { x, y, width, height } = await seen(live, what);
  await live.page.mouse.click(x + width / 2, y + height / 2);
}

/** Draws a regular polygon about the middle of the scene and closes it at its first point. @param {Live} live @param {number} corners */
async function draw(live, corners) {
  const { mouse } = live.page;
  await press(live, '.editor-bar [aria-label="Draw the object\'s polygon"]');
  const stage = await seen(live, "#stage");
  const [x, y] = [stage.x + stage.width / 2, stage.y + stage.height / 2];
  const spots = Array.from({ length: corners }, (_, k) => (2 * Math.PI * k) / corners)
    .map((angle) => [x + RADIUS * Math.cos(angle), y + RADIUS * Math.sin(angle)]);
  for (const [left, top] of [...spots, spots[0]]) {
    await mouse.move(left, top);
    await mouse.down();
    // A hand presses for longer than a drawing takes.
    await live.drawn();
    await mouse.up();
  }
  await live.until((count) => window.stiction.state?.scene.body.length === count, corners);
}

/** Waits until the address has this file of a scene. @param {Live} live @param {string} text */
const linked = ({ page }, text) => page.evaluate(async (wanted) => {
  const file = async () => {
    const packed = new URLSearchParams(location.hash.slice(1)).get("file") ?? "";
    const bytes = Uint8Array.from(atob(packed.replaceAll("-", "+").replaceAll("_", "/")), (letter) => letter.charCodeAt(0));
    return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  };
  while (!location.hash.includes("&file=") || await file() !== wanted) await new Promise(requestAnimationFrame);
}, text);

for (const viewport of WINDOWS) {
  const name = `${viewport.width} by ${viewport.height}`;
  test(`a stranger at ${name} sees a slip, changes friction, draws, saves and sends a link`, { skip: missingPage || shared().missing }, async () => {
    const host = await Host.start();
    const newPage = async () => {
      const context = await shared().get().newContext({ viewport, colorScheme: "light", acceptDownloads: true });
      return new Live(await context.newPage(), host.origin);
    };
    const live = await newPage();
    const { page } = live;
    try {
      await page.goto(`${host.origin}/`);
      await live.until(() => window.stiction?.connected && window.stiction.framesDrawn > 0);
      await seen(live, "#stage");
      await live.reads("#demonstration", /The object slips/);
      await seen(live, "#demonstration");

      const slider = await seen(live, "#slide-static");
      const before = (await live.state()).parameters.static;
      await page.mouse.move(slider.x + 0.2 * slider.width, slider.y + slider.height / 2);
      await page.mouse.down();
      await page.mouse.move(slider.x + 0.9 * slider.width, slider.y + slider.height / 2, { steps: 5 });
      await page.mouse.up();
      await live.until((value) => (window.stiction.state?.parameters.static ?? value) > value, before);
      await picture(live, `${viewport.width}-friction`);

      await press(live, "#edit");
      await page.waitForSelector(".editor-bar");
      for (let time = 0; time < DRAWINGS; time++) for (const corners of CORNERS) await draw(live, corners);
      await picture(live, `${viewport.width}-drawn`);
      const coming = page.waitForEvent("download");
      await press(live, '.editor-bar [aria-label="Save the scene as a file"]');
      const file = await coming;
      assert.match(file.suggestedFilename(), /^my-.*\.toml$/);
      const text = readFileSync(await file.path(), "utf8");
      assert.match(text, /^\[body\]\nvertices = \[(\[[^\]]*\],? ?){6}\]/m);

      const { title } = (await live.state()).scene;
      await linked(live, text);
      const other = await newPage();
      await other.page.goto(await page.evaluate(() => location.href));
      await other.until(([title]) => window.stiction?.state?.scene.title === title, [title]);
      const [mine, theirs] = [await live.state(), await other.state()];
      assert.deepEqual(theirs.scene.body, mine.scene.body);
      assert.deepEqual(theirs.parameters, mine.parameters);
      await other.page.context().close();
      live.check();
    } finally {
      await page.context().close();
      await host.kill();
    }
  });
}
