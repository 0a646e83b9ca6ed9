// Several pages, a server that is killed, and clients that do not read: all others continue.

import assert from "node:assert/strict";
import { liveTest, PATIENCE, Program, stalled } from "./live.js";

/** Returns the texts of a page about a frame. @param {import("./live.js").Live} live */
const words = (live) =>
  live.page.evaluate(() =>
    ["#state-name", "#hand-pose", "#body-pose", "#wrench", "#place", "#differ", "#ticks"].map(
      (selector) => document.querySelector(selector)?.textContent,
    ),
  );

liveTest("two pages show the same; one holds the hand, and the other says who", async (bench) => {
  const first = await bench.open();
  const second = await bench.open();
  for (const live of [first, second]) await live.reads("#clients", /^2 pages$/);
  await first.page.check("#keep");
  await first.grab();
  const { hand } = (await first.frame()).frame;
  await first.handTo(hand[0], hand[1] - 0.03);
  await first.reads("#holder", /^Hand: this page$/);
  const number = (await first.state()).hand.client;
  await second.reads("#holder", new RegExp(`^Hand: page ${number}$`));
  await first.page.mouse.up();

  // Refused with a message, and nothing moves.
  const there = (await second.frame()).frame.hand;
  const at = await second.pixel(there[0], there[1]);
  await second.page.mouse.move(at.x, at.y);
  await second.page.mouse.down();
  await second.reads("#note", new RegExp(`^Page ${number} holds the hand\\.$`));
  await second.page.mouse.move(at.x + 60, at.y - 60, { steps: 10 });
  await second.page.mouse.up();
  await second.fresh();
  assert.deepEqual((await second.frame()).frame.hand, there);
  assert.equal((await second.state()).hand.client, number);

  // Both show a setting changed in one, and when paused both show the same record with the same texts.
  await second.page.selectOption("#number", "f64");
  await first.until(() => /** @type {HTMLSelectElement} */ (document.querySelector("#number")).value === "f64");
  await first.pause();
  await second.settled();
  assert.equal(await second.text("#pause-text"), "Go on");
  const [one, other] = [await first.frame(), await second.frame()];
  assert.equal(one.tick, other.tick);
  assert.deepEqual(one.frame, other.frame);
  assert.equal(one.frame.state, "edge");
  await second.until(
    (said) =>
      JSON.stringify(said) ===
      JSON.stringify(
        ["#state-name", "#hand-pose", "#body-pose", "#wrench", "#place", "#differ", "#ticks"].map(
          (selector) => document.querySelector(selector)?.textContent,
        ),
      ),
    await words(first),
  );
  await first.page.click("#pause");

  // After a release, the other page takes the hand; and when a page is closed, its hand is free.
  await first.page.click("#let-go");
  await second.reads("#holder", /^Hand: at rest$/);
  await second.grab();
  await second.reads("#holder", /^Hand: this page$/);
  const now = (await second.state()).hand.client;
  assert.notEqual(now, number);
  await first.reads("#holder", new RegExp(`^Hand: page ${now}$`));
  await second.handTo(hand[0] + 0.01, hand[1]);
  await first.until(
    ([x, near]) => Math.abs((window.stiction.frame?.frame.hand[0] ?? NaN) - x) < near,
    [hand[0] + 0.01, 2 * (await first.metresPerPixel())],
  );
  await second.page.close();
  await first.reads("#holder", /^Hand: at rest$/);
  await first.reads("#clients", /^1 page$/);
});

liveTest("a page whose server is killed says so, and comes back by itself", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const lost = page.locator("#lost");
  for (const round of [1, 2]) {
    await page.check("#keep");
    await live.grab();
    await page.mouse.up();
    assert.ok(await lost.isHidden());
    live.expects(/WebSocket connection to .* failed|ERR_CONNECTION_REFUSED/);
    await bench.program.kill();
    await lost.waitFor({ state: "visible" });
    assert.match(await lost.innerText(), /No connection/);
    await live.reads("#source", /^not connected$/);
    assert.equal(await page.evaluate(() => window.stiction.connected), false);
    // An impossible request is reported, and breaks nothing.
    await page.click("#pause");
    await live.reads("#note", /no connection/i);

    bench.program = await Program.start(["box-flat"], bench.program.port);
    await lost.waitFor({ state: "hidden" });
    await live.reads("#source", /^this computer/);
    await live.until(() => window.stiction.connected && window.stiction.state?.clients === 1);
    // The complete initial state of the new program: nobody holds the hand, and it runs.
    await live.reads("#holder", /^Hand: at rest$/);
    assert.equal((await live.state()).paused, false);
    await live.fresh();
    const { frame, counts } = await live.frame();
    assert.ok(Math.abs(counts.ticks / 1000 - frame.t) < 0.0015, `round ${round}`);
    await live.grab();
    await live.handTo(frame.hand[0], frame.hand[1] - 0.03);
    await live.until(() => window.stiction.frame?.frame.state === "edge");
    await page.mouse.up();
    await page.click("#let-go");
    await live.reads("#holder", /^Hand: at rest$/);
    await page.click("#reset");
    await live.until(() => window.stiction.frame?.frame.state === "non-contact" && window.stiction.frame.holding);
  }
});

/**
 * Reads everything pending, up to a frame of a tick, and then stops reading; returns the number of frames reported as lost to
 * the client.
 * @param {import("node:net").Socket} socket @param {number} tick @returns {Promise<number>}
 */
function skippedUpTo(socket, tick) {
  return new Promise((take, fail) => {
    let tail = "";
    const timer = setTimeout(() => fail(new Error(`no frame of tick ${tick} comes`)), PATIENCE);
    const read = (/** @type {Buffer} */ bytes) => {
      const text = tail + bytes.toString("latin1");
      tail = text.slice(-80);
      const last = [...text.matchAll(/"tick":(\d+),"skipped":(\d+),/g)].at(-1)?.map(Number) ?? [];
      if (!(last[1] >= tick)) return;
      clearTimeout(timer);
      socket.off("data", read);
      socket.pause();
      take(last[2]);
    };
    socket.on("data", read);
    socket.resume();
  });
}

liveTest("a client that never reads and a page that is busy stop nobody else", async (bench) => {
  const live = await bench.open();
  const busy = await bench.open();
  const socket = await stalled(bench.program);
  await live.reads("#clients", /^3 pages$/);
  const begin = await live.frame();
  // The page's main thread is busy until the others have finished, while the hand continues to move.
  const blocked = busy.page.evaluate(
    () =>
      new Promise((done) =>
        setTimeout(() => {
          const end = performance.now() + 8000;
          while (performance.now() < end);
          done(window.stiction.frame?.tick);
        }),
      ),
  );
  await live.grab();
  /**
   * Ticks for which the other page continues before the client reads once: increased until the system buffers no more for it.
   */
  let ticks = 9000;
  let skipped = 0;
  for (; skipped <= 100 && ticks < 200_000; ticks *= 2) {
    const from = (await live.frame()).tick;
    for (let k = 0; (await live.frame()).tick < from + ticks; k++) {
      await live.handTo(begin.frame.hand[0], begin.frame.hand[1] - (k % 2 ? 0.03 : 0));
      await live.fresh();
    }
    skipped = await skippedUpTo(socket, (await live.frame()).tick);
  }
  assert.ok(skipped > 100, `${skipped} frames`);
  await live.page.mouse.up();
  const tick = await blocked;
  const now = await live.frame();
  assert.ok(now.counts.ticks >= 9000);
  // The busy page showed old data; as soon as it can, it shows what the other one does.
  assert.ok(Number(tick) < now.tick);
  await busy.until((least) => (window.stiction.frame?.tick ?? 0) >= least, now.tick);
  await busy.fresh();
  socket.destroy();
  await live.reads("#clients", /^2 pages$/);
});
