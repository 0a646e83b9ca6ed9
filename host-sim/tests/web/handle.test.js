// Turning the hand by its handle and by the wheel, zooming by the wheel, the arrow to an object outside the window, and a hand
// that is free as soon as it is released.

import assert from "node:assert/strict";
import { Fingers, PHONE } from "./fingers.js";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/** One degree (rad). */
const DEGREE = Math.PI / 180;
/** Distance from the hand to the knob (px), as a user sees it. */
const ARM = 56;
/** Tolerance of the hand's angle: half a degree; a pixel at the knob is one degree. */
const EXACT = 0.5 * DEGREE;

/** Waits for the hand's angle. @param {Live} live @param {number} wanted rad @param {number} [near] */
const turned = (live, wanted, near = EXACT) =>
  live.until(([angle, most]) => Math.abs((window.stiction.frame?.frame.hand[2] ?? NaN) - angle) < most, [wanted, near]);

/** Returns a function from polar coordinates about the hand to points on the screen. @param {Live} live */
async function aboutHand(live) {
  const { hand } = (await live.frame()).frame;
  const { x, y } = await live.pixel(hand[0], hand[1]);
  return (/** @type {number} */ angle, /** @type {number} */ r) => ({
    x: x + r * Math.cos(angle),
    y: y - r * Math.sin(angle),
  });
}

liveTest("the handle turns the hand as far as the pointer goes about it, and leaves the hold as it was", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await live.steady();
  const [x, y, phi] = (await live.frame()).frame.hand;
  const at = await aboutHand(live);
  // Whole turns, there and back, also far from the knob.
  await page.mouse.move(at(phi, ARM).x, at(phi, ARM).y);
  await live.until(() => /** @type {HTMLElement} */ (document.querySelector("#stage")).dataset.over === "knob");
  await page.mouse.down();
  for (const [to, r] of /** @type {[number, number][]} */ ([
    [90, 80],
    [400, 60],
    [-30, 120],
  ])) {
    const from = ((await live.frame()).frame.hand[2] - phi) / DEGREE;
    const steps = Math.ceil(Math.abs(to - from) / 12);
    for (let k = 1; k <= steps; k++) {
      const place = at(phi + (from + ((to - from) * k) / steps) * DEGREE, r);
      await page.mouse.move(place.x, place.y);
    }
    await turned(live, phi + to * DEGREE);
  }
  await page.mouse.up();
  await live.fresh();
  // The position of the hand and its hold are unchanged.
  const { frame, holding } = await live.frame();
  assert.ok(holding);
  assert.deepEqual(frame.hand.slice(0, 2), [x, y]);

  // An open hand shows its handle while the pointer is at the object, holds while it turns, and opens again.
  await page.focus("#stage");
  await page.keyboard.press("Space");
  await live.until(() => window.stiction.frame?.holding === null);
  await live.steady();
  const [hx, hy, now] = (await live.frame()).frame.hand;
  const about = await aboutHand(live);
  const knob = about(now, ARM);
  await page.mouse.move(about(0, 0).x, about(0, 0).y);
  await live.drawn();
  await page.mouse.move(knob.x, knob.y, { steps: 5 });
  await live.until(() => /** @type {HTMLElement} */ (document.querySelector("#stage")).dataset.over === "knob");
  await page.mouse.down();
  await live.until(() => window.stiction.frame?.holding);
  const end = about(now + 20 * DEGREE, ARM);
  await page.mouse.move(end.x, end.y, { steps: 8 });
  await turned(live, now + 20 * DEGREE);
  await page.mouse.up();
  await live.until(() => window.stiction.frame?.holding === null);
  const [ex, ey] = (await live.frame()).frame.hand;
  // Within the precision of the position in f32.
  assert.ok(Math.hypot(ex - hx, ey - hy) < 1e-6);
});

liveTest("a finger turns the hand that holds by its handle", async (bench) => {
  const live = await bench.open(PHONE);
  const fingers = await Fingers.of(live.page);
  await live.steady();
  const { hand } = (await live.frame()).frame;
  const at = await aboutHand(live);
  await fingers.down(at(hand[2], ARM));
  await fingers.along((part) => [at(hand[2] + 50 * DEGREE * part, ARM)]);
  await turned(live, hand[2] + 50 * DEGREE);
  await fingers.lift();
  await live.fresh();
  const { frame, holding } = await live.frame();
  assert.ok(holding);
  assert.deepEqual(frame.hand.slice(0, 2), hand.slice(0, 2));
});

liveTest("the wheel turns the hand that holds, 5 degrees a notch; without a hold it zooms where the pointer is", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await live.steady();
  const phi = (await live.frame()).frame.hand[2];
  const scale = await live.metresPerPixel();
  const at = (await aboutHand(live))(1, 150);
  await page.mouse.move(at.x, at.y);
  for (let k = 0; k < 4; k++) await page.mouse.wheel(0, 100);
  await turned(live, phi - 20 * DEGREE, 0.01 * DEGREE);
  await page.keyboard.down("Shift");
  for (let k = 0; k < 4; k++) await page.mouse.wheel(0, -100);
  await page.keyboard.up("Shift");
  await turned(live, phi - 18 * DEGREE, 0.01 * DEGREE);
  assert.ok((await live.frame()).holding);
  // With ctrl it zooms even so.
  await page.keyboard.down("Control");
  await page.mouse.wheel(0, -100);
  await page.keyboard.up("Control");
  await live.until((old) => 1 / Math.abs(window.stiction.pixelOf(1, 0).x - window.stiction.pixelOf(0, 0).x) < 0.95 * old, scale);

  await page.focus("#stage");
  await page.keyboard.press("Space");
  await live.until(() => window.stiction.frame?.holding === null);
  const closer = await live.metresPerPixel();
  const { hand } = (await live.frame()).frame;
  const origin = await live.pixel(0, 0);
  await page.mouse.wheel(0, -200);
  await live.until((old) => 1 / Math.abs(window.stiction.pixelOf(1, 0).x - window.stiction.pixelOf(0, 0).x) < 0.9 * old, closer);
  const ratio = closer / (await live.metresPerPixel());
  // The point under the pointer stays there.
  const now = await live.pixel(0, 0);
  assert.ok(Math.abs(now.x - at.x - ratio * (origin.x - at.x)) < 0.5 && Math.abs(now.y - at.y - ratio * (origin.y - at.y)) < 0.5);
  assert.deepEqual((await live.frame()).frame.hand, hand);
});

liveTest("an arrow points to the object that is out of the window, and a press on it fits the scene", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const away = page.locator("#away");
  assert.ok(await away.isHidden());
  const box = await page.locator("#stage").boundingBox();
  assert.ok(box);
  // The window moves down and to the left, by more than its own size.
  const from = { x: box.x + 40, y: box.y + box.height - 25 };
  for (let k = 0; k < 3; k++) {
    await page.mouse.move(from.x, from.y);
    await page.mouse.down();
    await page.mouse.move(from.x + 0.8 * box.width, from.y - 0.6 * box.height, { steps: 3 });
    await page.mouse.up();
  }
  await away.waitFor({ state: "visible" });
  const [x, y] = (await live.frame()).frame.pose;
  const object = await live.pixel(x, y);
  const arrow = await away.boundingBox();
  assert.ok(arrow);
  const at = { x: arrow.x + arrow.width / 2, y: arrow.y + arrow.height / 2 };
  assert.ok(at.x > box.x && at.x < box.x + box.width && at.y > box.y && at.y < box.y + box.height);
  // It points there, and shows the distance.
  const angle = await page.evaluate(() => parseFloat(/** @type {HTMLElement} */ (document.querySelector("#away i")).style.rotate));
  const wanted = Math.atan2(object.y - at.y, object.x - at.x);
  assert.ok(Math.abs(angle - wanted) < 0.02, `${angle} instead of ${wanted}`);
  const metres = Math.hypot(object.x - at.x, object.y - at.y) * (await live.metresPerPixel());
  const said = Number((await live.text("#away-text")).match(/^([\d.]+) mm$/)?.[1]) / 1e3;
  assert.ok(Math.abs(said / metres - 1) < 0.02, `${said} m of ${metres} m`);
  await away.click();
  await away.waitFor({ state: "hidden" });
  await live.drawn();
  const back = await live.pixel(x, y);
  assert.ok(back.x > box.x && back.x < box.x + box.width && back.y > box.y && back.y < box.y + box.height);
});

liveTest("a hand that is let go is free for another page at once, by pointer and by key", async (bench) => {
  const first = await bench.open();
  const second = await bench.open();
  for (const live of [first, second]) await live.reads("#clients", /^2 pages$/);
  assert.ok(await first.page.locator("#let-go").isDisabled());
  for (const [giver, taker] of [
    [first, second],
    [second, first],
  ]) {
    await giver.grab();
    await taker.reads("#holder", /^Hand: page \d+$/);
    await giver.page.mouse.up();
    // Less than the 10 s after which a silent holder would lose it.
    const released = performance.now();
    await taker.reads("#holder", /^Hand: at rest$/);
    await taker.grab();
    await taker.reads("#holder", /^Hand: this page$/);
    assert.ok(performance.now() - released < 9000);
    await taker.page.mouse.up();
    await giver.reads("#holder", /^Hand: at rest$/);
  }
  await first.page.focus("#stage");
  await first.page.keyboard.press("Space");
  await second.reads("#holder", /^Hand: page \d+$/);
  await first.until(() => window.stiction.frame?.holding);
  await first.page.keyboard.press("Space");
  await second.reads("#holder", /^Hand: at rest$/);
});
