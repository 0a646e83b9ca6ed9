// The first ten seconds: whoever opens the page sees what it is, sees it move, finds the scenes, and can take the object
// immediately. STICTION_SCREENSHOTS: a folder for pictures.

import assert from "node:assert/strict";
import { mkdirSync } from "node:fs";
import { join } from "node:path";
import { layoutFaults } from "./layout.js";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/** Windows (px): phones, laptops, a screen. */
const WINDOWS = [
  { width: 360, height: 740 },
  { width: 390, height: 844 },
  { width: 1280, height: 800 },
  { width: 1440, height: 900 },
  { width: 1920, height: 1080 },
];
/** Elements that are visible at the top without scrolling. */
const AT_ONCE = [
  "#what", "#story", "#scenes-open", "#edit", "#details-open", "#help-open",
  ...["static", "dynamic", "stiffness_translation", "weight"].map((name) => `#slide-${name}`),
];
/** Most words and controls before the first action, and least share of the scene in the window. */
const WORDS = 80;
const CONTROLS = 12;
const SHARE = 0.6;
/** Length of the sides of a cone (px), as in forces.js. */
const CONE = 92;
/** Captions of the demonstration of a box that is dragged. */
const SAID = ["sticks", "slips"];
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

/** Returns the words and the controls in the window, and the share of the scene in it. @param {Live} live */
const firstSight = (live) =>
  live.page.evaluate(() => {
    const isSeen = (/** @type {Element} */ element, /** @type {DOMRect} */ { width, top }) =>
      width > 0 && top < window.innerHeight && element.checkVisibility({ visibilityProperty: true }) && !element.closest(".hidden");
    /** @type {string[]} */
    const words = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      const range = document.createRange();
      range.selectNodeContents(node);
      if (node.parentElement && isSeen(node.parentElement, range.getBoundingClientRect())) {
        words.push(...(node.textContent?.trim().split(/\s+/).filter(Boolean) ?? []));
      }
    }
    const controls = [...document.querySelectorAll("button, select, input, a[href], [tabindex='0']")]
      .filter((element) => isSeen(element, element.getBoundingClientRect())).map(({ id }) => id);
    const { width, height, top } = /** @type {Element} */ (document.querySelector("#stage")).getBoundingClientRect();
    const seen = Math.min(height, window.innerHeight - top);
    return { words, controls, share: (width * seen) / (window.innerWidth * window.innerHeight) };
  });

for (const viewport of WINDOWS) {
  liveTest(`at ${viewport.width} px the first screen is the scene with four sliders, says what it is, and moves`, async (bench) => {
    const live = await bench.openFirst({ viewport, reducedMotion: "no-preference" });
    for (const theme of /** @type {const} */ (["light", "dark"])) {
      await live.page.emulateMedia({ colorScheme: theme });
      await shown(live, theme === "light" ? 0.6 : 1.2);
      await picture(live, `${viewport.width}-${theme}`);
      for (const place of AT_ONCE) {
        const box = await live.page.locator(place).boundingBox();
        assert.ok(box && box.y >= 0 && box.y + box.height <= viewport.height, `${place}: ${JSON.stringify(box)}`);
      }
      const { words, controls, share } = await firstSight(live);
      assert.ok(words.length <= WORDS, `${words.length} words: ${words.join(" ")}`);
      assert.ok(controls.length <= CONTROLS, `${controls.length} controls: ${controls.join(" ")}`);
      assert.ok(share >= SHARE, `${share} of the window`);
    }
    assert.deepEqual(await layoutFaults(live), []);
    assert.match(await live.text("#story"), /^A heavy box is dragged .*\.$/);
    assert.ok(await live.page.locator("#demonstration").isVisible());
    await live.page.click("#scenes-open");
    await live.seesAllCards();
    // What was opened is open again.
    await live.page.reload();
    await live.page.locator("#cards").waitFor();
  }, []);
}

liveTest("a scene that is chosen moves as its story promises", async (bench) => {
  const live = await bench.openFirst({ reducedMotion: "no-preference" });
  await live.page.click("#scenes-open");
  for (const name of ["ladder", "hook"]) {
    await live.scene(name);
    await shown(live, 0.3);
    const { pose } = (await live.frame()).frame;
    await live.until(([x, y, theta]) => {
      const now = window.stiction.frame?.frame.pose ?? [x, y, theta];
      return Math.hypot(now[0] - x, now[1] - y) > 1e-3 || Math.abs(now[2] - theta) > 0.02;
    }, pose);
  }
  // It goes on while its reader closes the gallery, and the chart shows what it presses on.
  await live.page.click("#scenes-open");
  await live.page.locator("#cards").waitFor({ state: "hidden" });
  await shown(live, 1);
  await live.until(() => (window.stiction.frame?.frame.contacts.length ?? 0) > 0);
  await live.until(() => parseFloat((document.querySelector("#now-n")?.textContent ?? "").slice(2)) > 0);
  assert.equal((await live.state()).replay?.demonstration, true);
}, []);

liveTest("no choice of a scene moves the page", async (bench) => {
  for (const viewport of [{ width: 1280, height: 800 }, { width: 390, height: 844 }]) {
    const live = await bench.openFirst({ viewport });
    await live.page.click("#scenes-open");
    const names = await live.page.locator(".card input").evaluateAll((inputs) => inputs.map((input) => /** @type {HTMLInputElement} */ (input).value));
    const top = () => live.page.locator("#stage").evaluate((stage) => stage.getBoundingClientRect().top);
    const before = await top();
    for (const name of names) {
      await live.scene(name);
      assert.equal(await top(), before, `${name} at ${viewport.width} px`);
    }
    await live.page.close();
  }
}, []);

liveTest("a chart without data has the scale of the scene", async (bench) => {
  const live = await bench.open();
  await live.scene("table-edge");
  await live.fresh();
  // The box is 0.1 m wide.
  const most = () => live.page.evaluate(() => /** @type {any} */ (uPlot).sync("stiction-time").plots[1].scales.y.max);
  await live.until(() => /** @type {any} */ (globalThis).uPlot?.sync("stiction-time").plots[1].scales.y.max < 0.1);
  assert.ok(await most() > 0);
});

liveTest("the opening slips by some 6 mm twice in a second, and the chart shows two seconds", async (bench) => {
  const live = await bench.openFirst({ reducedMotion: "no-preference" });
  await shown(live, 4);
  const { frame, slips } = await live.frame();
  const late = slips.filter(({ t }) => t > frame.t - 2);
  assert.ok(late.length >= 3 && late.length <= 5, `${late.length} slips in two seconds`);
  for (const { length } of late) assert.ok(Math.abs(length - 0.006) < 1e-3, `${length} m`);
  // Its scale has a tick below 0 and includes both limits of static friction.
  const [ticks, bottom] = await live.page.evaluate(async () => {
    const { prototype } = CanvasRenderingContext2D;
    const { fillText } = prototype;
    /** @type {Map<number, number>} */
    const places = new Map();
    prototype.fillText = function (text, x, y) {
      fillText.call(this, text, x, y);
      if (this.canvas.closest("#chart-forces") && /^−?\d+$/.test(text)) places.set(Number(text.replace("−", "-")), y);
    };
    await new Promise((done) => { setTimeout(done, 500); });
    prototype.fillText = fillText;
    const { offsetTop, offsetHeight } = /** @type {HTMLElement} */ (document.querySelector("#chart-forces .u-over"));
    return [[...places].sort(([a], [b]) => a - b), offsetTop + offsetHeight];
  });
  const [[least, low], [most, high]] = [ticks[0], ticks[ticks.length - 1]];
  assert.ok(least < 0 && most > 0, JSON.stringify(ticks));
  const end = least - ((bottom - low) / (low - high)) * (most - least);
  const load = frame.contacts.reduce((sum, { normal }) => sum + normal, 0);
  assert.ok(end < -0.6 * load, `the scale ends at ${end} N, the limit is ${-0.6 * load} N`);
  await picture(live, "opening");
}, []);

liveTest("a cone is dragged to change its friction, and a slider only interrupts the demonstration", async (bench) => {
  const live = await bench.openFirst({ reducedMotion: "no-preference" });
  const { page } = live;
  await shown(live, 0.5);
  await page.focus("#slide-static");
  await page.keyboard.press("ArrowRight");
  await live.until(() => (window.stiction.state?.parameters.static ?? 0) > 0.6);
  await shown(live, 1);

  // The dot at the end of the left side of the left cone: the pointer takes the whole cone with it.
  await page.keyboard.press("Shift");
  await live.until(() => window.stiction.state?.replay === null);
  for (const [kind, mu, wanted] of /** @type {const} */ ([["static", 0.601, 0.9], ["dynamic", 0.3, 0.15]])) {
    await live.steady();
    const contacts = (await live.frame()).frame.contacts;
    const [x, y] = contacts.reduce((left, contact) => (contact.point[0] < left.point[0] ? contact : left)).point;
    const foot = await live.pixel(x, y);
    const end = (/** @type {number} */ friction) => {
      const size = CONE / Math.hypot(1, friction);
      return [foot.x - size * friction, foot.y - size];
    };
    const now = (await live.state()).parameters[kind];
    assert.ok(Math.abs(now - mu) < 0.01, `${now}`);
    await page.mouse.move(end(now)[0], end(now)[1]);
    await live.until((over) => /** @type {HTMLElement} */ (document.querySelector("#stage")).dataset.over === over, kind);
    await page.mouse.down();
    await page.mouse.move(end(wanted)[0], end(wanted)[1], { steps: 8 });
    await page.mouse.up();
    await live.until(([name, friction]) => Math.abs((window.stiction.state?.parameters[name] ?? 0) - friction) < 0.03,
      /** @type {const} */ ([kind, wanted]));
    assert.equal((await live.frame()).frame.held, true);
  }
}, []);

liveTest("an object that is let go on one corner stays tilted, and the page says why", async (bench) => {
  const live = await bench.open();
  await live.scene("vertex-stick-slip");
  await live.page.selectOption("#replay", "scene");
  await live.until(() => window.stiction.frame?.frame.contacts.length === 1);
  await live.page.selectOption("#replay", "live");
  await live.grab();
  await live.page.mouse.up();
  const released = live.page.locator("#released");
  await released.waitFor({ state: "visible" });
  assert.match(await released.innerText(), /^Released on one corner: it stays tilted, because/);
});

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
}, []);

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
  const isInSight = (/** @type {import("playwright-core").Page} */ seen) => seen.evaluate(() => {
    const strip = /** @type {Element} */ (document.querySelector("#cards")).getBoundingClientRect();
    const { left, right } = /** @type {Element} */ (document.querySelector(".card :checked")).getBoundingClientRect();
    return left >= strip.left && right <= strip.right;
  });
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
      const chosen = /** @type {HTMLInputElement} */ (document.querySelector(".card :checked"));
      return [chosen.value, document.activeElement === chosen];
    }),
    ["parallel-walls", true],
  );
  assert.ok(await isInSight(page));
  // Also in a gallery that is opened later.
  const other = await bench.openFirst({ viewport: { width: 390, height: 844 } });
  await other.page.click("#scenes-open");
  assert.ok(await isInSight(other.page));
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

liveTest("on a phone the cones of the opening are whole while it moves", async (bench) => {
  const live = await bench.openFirst({ viewport: { width: 390, height: 844 }, reducedMotion: "no-preference" });
  for (let time = 0.5; time < 5; time += 0.5) {
    await shown(live, time);
    const { contacts } = (await live.frame()).frame;
    for (const { point } of contacts) {
      const { x } = await live.pixel(...point);
      const half = (CONE * 0.6) / Math.hypot(1, 0.6);
      assert.ok(x - half > 0 && x + half < 390, `a cone at ${x} px after ${time} s`);
    }
  }
}, []);

liveTest("on a phone the captions cover neither the button nor the frame that shows who has the keys", async (bench) => {
  const live = await bench.openFirst({ viewport: { width: 390, height: 844 } });
  const boxes = (/** @type {string} */ places) => live.page.$$eval(places, (elements) => elements.map((element) => element.getBoundingClientRect())
    .filter(({ width }) => width > 0).map(({ left, top, right, bottom }) => ({ left, top, right, bottom })));
  await live.grab();
  await live.page.mouse.up();
  await live.page.locator("#released").waitFor({ state: "visible" });
  const [[stage], [reset]] = [await boxes("#stage"), await boxes("#reset")];
  for (const { left, top, right, bottom } of await boxes(".over > *, .foot > *")) {
    assert.ok(right < reset.left || top > reset.bottom, `${right} px, ${top} px`);
    // The frame is 2 px wide, 1 px inside.
    assert.ok(left >= stage.left + 3 && top >= stage.top + 3 && bottom < stage.bottom, `${left} px, ${top} px`);
  }
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
