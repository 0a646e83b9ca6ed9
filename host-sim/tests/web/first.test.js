// The first ten seconds: whoever opens the page sees what it is, sees it move, finds the scenes, and can take the object
// immediately. STICTION_SCREENSHOTS: a folder for pictures.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/** Windows (px): a phone, a laptop, a screen. */
const WINDOWS = [
  { width: 360, height: 740 },
  { width: 1280, height: 800 },
  { width: 1920, height: 1080 },
];
/** Elements that are visible at the top without scrolling; of the stage, more than half of its height. */
const AT_ONCE = ["#what", "#cards", "#story", "#help-open"];
/** Some captions of the demonstration of a box that is set down and dragged, in order. */
const SAID = ["moves freely", "slips", "sticks and slips"];
/** Terms that the page explains, by the element with the title. */
const TERMS = [
  "#h-trade", "#number", "#evolution", "#keep", '[data-layer="ghost"]', '[data-layer="trails"]', '[data-layer="cones"]',
  ...["stiffness_translation", "stiffness_rotation", "static", "dynamic", "memory", "weight"].map((name) => `#slide-${name}`),
];

/** Writes a picture, if pictures are requested. @param {Live} live @param {string} name */
async function picture(live, name) {
  const folder = process.env.STICTION_SCREENSHOTS;
  if (!folder) return;
  mkdirSync(folder, { recursive: true });
  await live.page.screenshot({ path: join(folder, `first-${name}.png`) });
}

/** Waits until the demonstration has reached a time (s). @param {Live} live @param {number} seconds */
const shown = (live, seconds) =>
  live.until(
    (from) => window.stiction.state?.replay?.demonstration && (window.stiction.frame?.position ?? 0) > from,
    seconds,
  );

for (const viewport of WINDOWS) {
  liveTest(`at ${viewport.width} px the first screen says what it is, has the gallery, and moves`, async (bench) => {
    const live = await bench.open({ viewport, reducedMotion: "no-preference" });
    for (const theme of /** @type {const} */ (["light", "dark"])) {
      await live.page.emulateMedia({ colorScheme: theme });
      await shown(live, theme === "light" ? 0.6 : 1.2);
      await picture(live, `${viewport.width}-${theme}`);
      for (const place of AT_ONCE) {
        const box = await live.page.locator(place).boundingBox();
        assert.ok(box && box.y >= 0 && box.y + box.height <= viewport.height, `${place}: ${JSON.stringify(box)}`);
      }
      const stage = await live.page.locator("#stage").boundingBox();
      assert.ok(stage && viewport.height - stage.y > stage.height / 2, JSON.stringify(stage));
    }
    // As in `look.test.js`: no column is wider than the window. The pictures are loaded as they come into view.
    assert.ok(await live.page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
    await live.seesAllCards();
    assert.match(await live.text("#story"), /^A box lies flat on the floor .*\.$/);
    assert.ok(await live.page.locator("#demonstration").isVisible());
  });
}

liveTest("the demonstration moves until it is touched, and the object is taken where it is", async (bench) => {
  const live = await bench.open({ reducedMotion: "no-preference" });
  await live.page.evaluate(() => {
    const said = new Set();
    Object.assign(window, { said });
    const doing = /** @type {Element} */ (document.querySelector("#doing"));
    const look = () => said.add(doing.textContent);
    new MutationObserver(look).observe(doing, { childList: true, characterData: true, subtree: true });
    look();
  });
  await live.until((words) => words.every((word) => /** @type {any} */ (window).said.has(word)), SAID);
  // The motion of the body is the solver's answer to the scene's own path.
  assert.equal((await live.state()).hand.by, "replay");
  await live.until(() => (window.stiction.frame?.frame.pose[0] ?? 0) > 0.005);
  const { frame } = await live.frame();
  const at = await live.pixel(frame.pose[0], frame.pose[1]);
  await live.page.mouse.move(at.x, at.y);
  assert.equal((await live.state()).replay?.demonstration, true, "looking is not touching");
  await live.page.mouse.down();
  await live.until(() => window.stiction.state?.replay === null && window.stiction.state.hand.by === "page");
  await live.until(() => window.stiction.frame?.holding);
  const taken = (await live.frame()).frame;
  assert.ok(taken.pose[0] > 0.005, "it is not back at its beginning");
  await live.page.mouse.up();
  await live.page.waitForSelector("#demonstration", { state: "hidden" });

  // Again on request, and until a key is pressed.
  await live.page.click("#show-me");
  await shown(live, 0.1);
  await live.page.keyboard.press("Shift");
  await live.until(() => window.stiction.state?.replay === null);

  // Another page, while nobody holds the hand here: the demonstration does not start by itself if somebody else is present.
  const second = await bench.open({ reducedMotion: "no-preference" });
  await second.fresh();
  assert.equal((await second.state()).replay, null);
});

liveTest("who wants no motion, or another path, sees no demonstration", async (bench) => {
  const live = await bench.open();
  await live.fresh();
  assert.equal((await live.state()).replay, null);
  await live.page.click("#show-me");
  await shown(live, 0.1);
  assert.ok(await live.page.isHidden("#show-me"));
});

liveTest("a hand that comes by OSC is not taken", async (bench) => {
  const live = await bench.open({ reducedMotion: "no-preference" });
  await live.fresh();
  assert.equal((await live.state()).replay, null);
  await live.page.click("#show-me");
  await live.reads("#note", /the hand comes from elsewhere, allowed/);
}, ["--osc-in", "0"]);

liveTest("a scene is picked by its card and by the keyboard, and its story is shown", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const title = (/** @type {string} */ name) =>
    live.until((wanted) => window.stiction.state?.scene.title === wanted && window.stiction.frame, name);
  await live.scene("ladder");
  await live.reads("#story", /^A ladder leans on a wall/);
  // Faster than any answer.
  for (let k = 0; k < 3; k++) await page.keyboard.press("ArrowRight");
  await title("parallel-walls");
  await live.reads("#story", /^A box is turned between floor and ceiling/);
  assert.deepEqual(
    await page.evaluate(() => {
      const strip = /** @type {Element} */ (document.querySelector("#cards")).getBoundingClientRect();
      const chosen = /** @type {HTMLInputElement} */ (document.querySelector(".card :checked"));
      const { left, right } = chosen.getBoundingClientRect();
      return [chosen.value, left >= strip.left && right <= strip.right, document.activeElement === chosen];
    }),
    ["parallel-walls", true, true],
  );
  // Commands work there, and the card of a scene restarts it.
  await page.keyboard.press("p");
  await live.until(() => window.stiction.state?.paused);
  await page.keyboard.press("p");
  await live.grab();
  await live.drag(40, 0);
  await page.mouse.up();
  await live.scene("parallel-walls");
  await live.until(() => {
    const { state, frame } = window.stiction;
    return state && frame && Math.abs(frame.frame.hand[0] - state.scene.home[0]) < 1e-6;
  });
});

liveTest("an object that is let go stays, and the page says why; weight adds to the reaction", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const released = page.locator("#released");
  assert.ok(await released.isHidden());
  await live.grab();
  await page.mouse.up();
  await released.waitFor({ state: "visible" });
  assert.match(await released.innerText(), /^Released: it stays where it is, because nothing falls in statics\./);
  await picture(live, "released");
  const { pose } = (await live.frame()).frame;
  await live.fresh();
  assert.deepEqual((await live.frame()).frame.pose, pose);
  await page.check("#keep");
  await live.grab([pose[0], pose[1]]);
  await released.waitFor({ state: "hidden" });

  // Down onto the floor, without weight and with it.
  const [x, y] = (await live.frame()).frame.hand;
  await live.handTo(x, y - 0.03);
  await live.until(() => window.stiction.frame?.frame.state === "edge");
  await page.mouse.up();
  await live.fresh();
  const load = async () => (await live.frame()).frame.contacts.reduce((sum, { normal }) => sum + normal, 0);
  const before = await load();
  await page.fill("#type-weight", "2,5");
  await page.press("#type-weight", "Enter");
  await live.until(() => window.stiction.state?.parameters.weight === 2.5);
  await live.fresh();
  assert.ok(Math.abs((await load()) - before - 2.5) < 1e-3, `${before} N, with weight ${await load()} N`);
  await page.focus("#slide-weight");
  await page.keyboard.press("End");
  await live.until(() => window.stiction.state?.parameters.weight === 20);
});

liveTest("every term is explained where it stands, by a title, a description, and a button", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const devtools = await page.context().newCDPSession(page);
  await devtools.send("DOM.enable");
  const { root } = await devtools.send("DOM.getDocument");
  for (const term of TERMS) {
    const title = await page.getAttribute(term, "title");
    assert.match(title ?? "", /^\S.{20,}\.$/s, term);
    if (term === "#h-trade") continue;
    const { nodeId } = await devtools.send("DOM.querySelector", { nodeId: root.nodeId, selector: term });
    const { nodes } = await devtools.send("Accessibility.getPartialAXTree", { nodeId, fetchRelatives: false });
    assert.equal(nodes[0].description?.value.replace(/\s+/g, " "), title?.replace(/\s+/g, " "), term);
  }
  // The button of a group shows all explanations, by a finger or a key, and Escape closes them.
  const all = await page.locator(".tip").all();
  let read = "";
  for (const button of all) {
    await button.focus();
    await page.keyboard.press("Enter");
    const tips = page.locator(".tips:popover-open");
    await tips.waitFor();
    read += await tips.innerText();
    const box = await tips.boundingBox();
    assert.ok(box && box.x >= 0 && box.y >= 0 && box.x + box.width <= 1280 && box.y + box.height <= 800, JSON.stringify(box));
    await page.keyboard.press("Escape");
    await tips.waitFor({ state: "hidden" });
  }
  for (const word of ["The trade", "Number", "Evolution", "Keep hold", "Ghost", "Trails", "Cones", "Dc"]) {
    assert.ok(read.includes(word), word);
  }
});
