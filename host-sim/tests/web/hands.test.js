// The page without a mouse: by the keyboard alone, and by fingers.

import assert from "node:assert/strict";
import { Fingers, PHONE } from "./fingers.js";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/** What Tab has to reach: all enabled controls, in the order of the document. */
const CONTROLS = "button, select, input, a[href], [tabindex='0']";

/**
 * Returns the focused element: its id or another name, its region, and whether the focus is visible.
 * @param {Live} live
 */
function focused(live) {
  return live.page.evaluate(() => {
    const element = /** @type {HTMLElement} */ (document.activeElement);
    const style = getComputedStyle(element);
    const { top, bottom, left, right } = element.getBoundingClientRect();
    const region = element.closest("header, section, dialog, main, body");
    return {
      name: element.id || element.dataset.layer || element.tagName,
      region: region?.getAttribute("aria-label") ?? region?.getAttribute("aria-labelledby") ?? region?.tagName,
      seen: style.outlineStyle !== "none" && parseFloat(style.outlineWidth) >= 2 && element.matches(":focus-visible"),
      inWindow: bottom > 0 && right > 0 && top < window.innerHeight && left < window.innerWidth,
    };
  });
}

/** Presses Tab until the focus is on an element. @param {Live} live @param {string} id */
async function tabTo(live, id) {
  for (let k = 0; k < 200; k++) {
    if ((await focused(live)).name === id) return;
    await live.page.keyboard.press("Tab");
  }
  assert.fail(`Tab never comes to ${id}`);
}

/** Holds a key down until a condition is true. @param {Live} live @param {string} key @param {() => unknown} what */
async function hold(live, key, what) {
  await live.page.keyboard.down(key);
  await live.until(what);
  await live.page.keyboard.up(key);
}

liveTest("Tab comes to every control, in order, and the focus is seen", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  // With a recording its links are visible, and with a replay the scrubber.
  await page.click("#record");
  await live.until(() => (window.stiction.state?.recording ?? 0) > 0.1);
  await page.click("#record");
  await page.selectOption("#replay", "recording");
  await live.until(() => window.stiction.state?.replay);
  await page.reload();
  await live.until(
    () => window.stiction?.connected && window.stiction.state?.replay && window.stiction.framesDrawn > 0,
  );

  const wanted = await page.evaluate(
    (selector) =>
      [.../** @type {NodeListOf<HTMLElement>} */ (document.querySelectorAll(selector))]
        .filter(
          (element) =>
            element.checkVisibility() &&
            !element.closest("dialog:not([open])") &&
            // In a group of radio buttons Tab reaches the selected one.
            !element.matches(":disabled, [type=radio]:not(:checked)"),
        )
        .map((element) => element.id || element.dataset.layer || element.tagName),
    CONTROLS,
  );
  assert.ok(wanted.length > 30, String(wanted));
  /** @type {string[]} */
  const reached = [];
  const regions = [];
  for (const _ of wanted) {
    await page.keyboard.press("Tab");
    const { name, region, seen, inWindow } = await focused(live);
    assert.ok(seen, `the focus on ${name} is not seen`);
    assert.ok(inWindow, `${name} is not in the window`);
    reached.push(name);
    if (region !== regions.at(-1)) regions.push(region);
  }
  assert.deepEqual(reached, wanted);
  assert.equal(new Set(regions).size, regions.length, `a region is left and entered again: ${regions}`);
  assert.deepEqual(regions.slice(0, 3), ["HEADER", "Scenes", "Scene"]);
  // And back.
  await page.keyboard.press("Shift+Tab");
  assert.equal((await focused(live)).name, wanted.at(-2));
});

liveTest(
  "the keyboard alone holds the object, presses it down, slides it and lets go; records, picks a scene, helps",
  async (bench) => {
    const live = await bench.open();
    const { page } = live;
    const { keyboard } = page;
    await tabTo(live, "stage");
    // The box is held from the beginning: let go, and grasp it again.
    await keyboard.press("Space");
    await live.until(() => window.stiction.frame?.holding === null);
    await keyboard.press("Space");
    await live.until(() => window.stiction.frame?.holding);
    await live.reads("#holder", /this page/);

    await keyboard.press("c");
    await live.until(() => window.stiction.state?.recording !== null);
    await live.reads("#record-text", /^End/);
    await hold(live, "ArrowDown", () => {
      const { state, contacts } = /** @type {FrameMessage} */ (window.stiction.frame).frame;
      return state === "edge" && contacts.reduce((sum, { normal }) => sum + normal, 0) > 4;
    });
    await hold(live, "ArrowRight", () => (window.stiction.frame?.counts.slips ?? 0) >= 3);
    const { frame } = await live.frame();
    assert.ok(frame.pose[0] > 0.001, String(frame.pose));
    await hold(live, "ArrowUp", () => window.stiction.frame?.frame.state === "non-contact");
    // Counter-clockwise, back, and again, slowly.
    for (const [keys, sense] of /** @type {[string[], number][]} */ ([
      [["q"], 1],
      [["e"], -1],
      [["Shift", "Q"], 1],
    ])) {
      const before = (await live.frame()).frame.hand[2];
      for (const key of keys) await keyboard.down(key);
      await live.until(
        ([angle, sign]) => sign * ((window.stiction.frame?.frame.hand[2] ?? NaN) - angle) > 0.01,
        [before, sense],
      );
      for (const key of keys.reverse()) await keyboard.up(key);
    }
    await keyboard.press("Space");
    await live.until(() => window.stiction.frame?.holding === null);
    await keyboard.press("c");
    await live.until(() => window.stiction.state?.recording === null && window.stiction.state.recorded);

    // The recording is downloaded and replayed.
    await tabTo(live, "get-trace.jsonl");
    const coming = page.waitForEvent("download");
    await keyboard.press("Enter");
    assert.equal((await coming).suggestedFilename(), "trace.jsonl");
    await tabTo(live, "replay");
    await keyboard.type("the rec");
    await live.until(() => window.stiction.state?.replay?.what === "recording");
    await tabTo(live, "scrubber");
    await keyboard.press("End");
    await live.until(
      () => Math.abs((window.stiction.frame?.position ?? NaN) - (window.stiction.state?.replay?.seconds ?? NaN)) < 0.01,
    );
    await tabTo(live, "replay");
    await keyboard.type("live");
    await live.until(() => window.stiction.state?.replay === null);

    await tabTo(live, "scene-box-flat");
    await keyboard.press("ArrowRight");
    await live.until(() => window.stiction.state?.scene.title === "corner-stick-slip" && window.stiction.frame);

    await keyboard.press("Escape");
    await tabTo(live, "help-open");
    await keyboard.press("Enter");
    const help = page.locator("#help");
    await help.waitFor({ state: "visible" });
    // The focus is in the help, and returns when it closes.
    assert.ok(await page.evaluate(() => document.activeElement?.closest("#help")));
    await keyboard.press("Escape");
    await help.waitFor({ state: "hidden" });
    assert.equal((await focused(live)).name, "help-open");
    for (const state of /** @type {const} */ (["visible", "hidden"])) {
      await keyboard.press("?");
      await help.waitFor({ state });
    }

    // The other letters.
    await tabTo(live, "stage");
    await keyboard.press("p");
    await live.until(() => window.stiction.state?.paused);
    await live.settled();
    const { tick } = await live.frame();
    await keyboard.press(".");
    await live.until((next) => window.stiction.frame?.tick === next, tick + 1);
    await keyboard.press("p");
    await live.until(() => !window.stiction.state?.paused);
    const scale = await live.metresPerPixel();
    await keyboard.press("+");
    await live.drawn();
    assert.ok((await live.metresPerPixel()) < scale);
    await keyboard.press("-");
    await keyboard.press("f");
    await live.drawn();
    assert.ok(Math.abs((await live.metresPerPixel()) / scale - 1) < 0.01);
    await keyboard.press("k");
    assert.ok(await page.isChecked("#keep"));
    await keyboard.press("t");
    assert.equal(await page.evaluate(() => document.documentElement.dataset.theme), "dark");
    await hold(live, "d", () => {
      const { state } = window.stiction;
      return state && Math.abs((window.stiction.frame?.frame.hand[0] ?? NaN) - state.scene.home[0]) > 0.005;
    });
    await keyboard.press("r");
    await live.until(() => {
      const { state, frame: now } = window.stiction;
      return state && now && now.frame.hand[0] === state.scene.home[0];
    });
  },
);

liveTest("a sample that waits is not later than a reset", async (bench) => {
  const { page } = await bench.open();
  const types = await page.evaluate(async () => {
    /** @type {string[]} */
    const sent = [];
    const { Link } = await import(new URL("link.js", document.baseURI).href);
    const link = Object.assign(Object.create(Link.prototype), {
      open: new Map(), nextId: 1, lastSample: -Infinity, waiting: null,
      send: (/** @type {{type: string}} */ message) => sent.push(message.type),
    });
    for (const x of [0, 1, 2]) link.hand([x, 0, 0], true, 0);
    link.request({ type: "reset" }).catch(() => {});
    await new Promise((done) => setTimeout(done, 50));
    return sent;
  });
  assert.deepEqual(types, ["hand", "hand", "reset"]);
});

liveTest("a brisk grab holds where the press was: the body goes as far as the pointer", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await page.focus("#stage");
  await page.keyboard.press("Space");
  await live.until(() => window.stiction.frame?.holding === null);
  await live.steady();
  const before = (await live.frame()).frame.pose;
  const pixel = await live.metresPerPixel();
  const at = await live.pixel(before[0], before[1]);
  await page.mouse.move(at.x, at.y);
  await page.mouse.down();
  const way = 150;
  for (let x = 30; x <= way; x += 30) {
    await page.mouse.move(at.x + x, at.y);
    await new Promise((done) => setTimeout(done, 10));
  }
  await live.until((x) => Math.abs((window.stiction.frame?.frame.hand[0] ?? NaN) - x) < 1e-6, before[0] + way * pixel);
  await live.fresh();
  const { pose } = (await live.frame()).frame;
  await page.mouse.up();
  assert.ok(Math.abs(pose[0] - before[0] - way * pixel) < 0.1 * pixel, `${pose[0] - before[0]} m of ${way * pixel} m`);
});

liveTest("one finger drags, two turn it as they turn, two off the object zoom", async (bench) => {
  const live = await bench.open(PHONE);
  const { page } = live;
  const fingers = await Fingers.of(page);
  const handNear = (/** @type {Pose} */ wanted, /** @type {number} */ near) =>
    live.until(
      ([x, y, turn, reach]) => {
        const hand = window.stiction.frame?.frame.hand ?? [NaN, NaN, NaN];
        return Math.hypot(hand[0] - x, hand[1] - y) < reach && Math.abs(hand[2] - turn) < 0.01;
      },
      [...wanted, near],
    );

  const [hx, hy, phi] = (await live.frame()).frame.hand;
  const pixel = await live.metresPerPixel();
  const start = await live.pixel(hx, hy);
  await fingers.down(start);
  await live.until(() => window.stiction.state?.hand.by === "page" && window.stiction.frame?.holding);
  await fingers.glide({ x: start.x + 20, y: start.y - 12 });
  await handNear([hx + 20 * pixel, hy + 12 * pixel, phi], 2 * pixel);
  // The second finger moves by a quarter of a right angle about the first one, which stays: counter-clockwise.
  const [one] = fingers.points;
  const about = (/** @type {Spot} */ { x, y }, /** @type {number} */ r, /** @type {number} */ angle) => ({
    x: x + r * Math.cos(angle),
    y: y - r * Math.sin(angle),
  });
  const angle = Math.PI / 8;
  await fingers.down(one, about(one, 100, 0));
  await fingers.along((part) => [one, about(one, 100, angle * part)]);
  await handNear([hx + 20 * pixel, hy + 12 * pixel, phi + angle], 2 * pixel);
  // Both rotate about their middle, clockwise by a right angle: the hand turns by the same angle, and stays at the first
  // finger.
  const middle = about(one, 50, angle);
  const twist = -Math.PI / 2;
  const ends = (/** @type {number} */ part) =>
    [Math.PI, 0].map((side) => about(middle, 50, angle + side + twist * part));
  await fingers.along(ends);
  const { x, y } = ends(1)[0];
  await handNear([hx + (x - start.x) * pixel, hy - (y - start.y) * pixel, phi + angle + twist], 2 * pixel);
  assert.ok((await live.frame()).holding);
  await fingers.lift();
  await live.until(() => window.stiction.frame?.holding === null);

  // Off the object two fingers zoom, and the hand stays.
  await live.steady();
  const before = (await live.frame()).frame.hand;
  const scale = await live.metresPerPixel();
  const box = await page.locator("#stage").boundingBox();
  assert.ok(box);
  const corner = { x: box.x + 30, y: box.y + box.height - 25 };
  await fingers.down(corner);
  await fingers.down(corner, { x: corner.x + 60, y: corner.y });
  await fingers.glide(corner, { x: corner.x + 78, y: corner.y });
  await fingers.lift();
  await live.drawn();
  const ratio = scale / (await live.metresPerPixel());
  assert.ok(ratio > 1.1 && ratio < 1.45, `zoomed by ${ratio}`);
  assert.deepEqual((await live.frame()).frame.hand, before);
});
