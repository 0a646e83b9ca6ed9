// The page with its own solver: from a web host and from a file it does what the served page does, at 1 kHz, and its address
// describes what it shows.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { brotliCompressSync } from "node:zlib";
import { filesOfFirstDrawing, folder, Host, missingPage, oneFile } from "./alone.js";
import { Live, openParts, shared } from "./live.js";

const WINDOW = { width: 1280, height: 800 };

/**
 * Defines a test with its own page, at an address of the host or in a single file.
 * @param {string} name @param {(live: Live, open: (hash: string, reducedMotion?: "no-preference") => Promise<Live>) => Promise<void>} work
 * @param {{file?: boolean}} [options]
 */
function aloneTest(name, work, { file = false } = {}) {
  const browser = shared();
  test(name, { skip: missingPage || browser.missing }, async () => {
    const host = await Host.start();
    /** @type {Live[]} */
    const pages = [];
    const open = async (/** @type {string} */ hash, /** @type {"reduce" | "no-preference"} */ reducedMotion = "reduce") => {
      const context = await browser.get().newContext({ viewport: WINDOW, colorScheme: "light", reducedMotion });
      const live = new Live(await context.newPage(), file ? "null" : host.origin);
      pages.push(live);
      await openParts(live.page);
      await live.page.goto(`${file ? oneFile : `${host.origin}/`}${hash}`);
      await live.until(() => window.stiction?.connected && window.stiction.framesDrawn > 0 && document.querySelector("#chart-steps canvas"));
      return live;
    };
    try {
      await work(await open(""), open);
      for (const live of pages) live.check();
    } finally {
      for (const { page } of pages) await page.context().close();
      await host.kill();
    }
  });
}

for (const file of [false, true]) {
  const where = file ? "in one file" : "from a web host";
  aloneTest(`${where} the object is held, dragged and slips`, async (live) => {
    await live.grab();
    await live.drag(0, 110);
    await live.drag(140, 0);
    await live.drag(-140, 0);
    await live.until(() => (window.stiction.frame?.counts.slips ?? 0) > 0);
    await live.page.mouse.up();
    const { frame, reference, counts } = await live.frame();
    assert.ok(frame.contacts.length > 0 && counts.ticks > 0);
    assert.ok(reference && reference.error[0] < 1e-4, JSON.stringify(reference));
  }, { file });

  aloneTest(`${where} scenes with obstacles, number types, replay and slow motion work`, async (live) => {
    await live.page.selectOption("#number", "fixed");
    await live.until(() => window.stiction.state?.number === "fixed");
    for (const scene of ["peg-in-hole", "ladder", "hook"]) await live.scene(scene);
    assert.equal((await live.state()).number, "fixed");
    await live.scene("ladder");
    await live.page.selectOption("#replay", "scene");
    await live.until(() => window.stiction.state?.replay && (window.stiction.frame?.position ?? 0) > 0.1);
    await live.page.selectOption("#replay", "live");
    await live.pause();
    const { tick } = await live.frame();
    await live.page.click("#step");
    await live.until((before) => window.stiction.frame?.tick === before + 1, tick);
  }, { file });
}

aloneTest("what needs the program is not shown, and is refused", async (live) => {
  for (const id of ["record", "upload", "recording-section", "let-go"]) {
    assert.equal(await live.page.isVisible(`#${id}`), false, id);
  }
  await live.page.keyboard.press("c");
  await live.reads("#note", /no recordings.*allowed: stiction view/);
});

aloneTest("a cone that is dragged takes its slider with it", async (live) => {
  await live.grab();
  await live.drag(0, 110);
  await live.until(() => window.stiction.frame?.frame.contacts.length === 2);
  await live.page.keyboard.press("k");
  await live.page.mouse.up();
  await live.steady();
  const [{ point }] = (await live.frame()).frame.contacts;
  const foot = await live.pixel(...point);
  // 92 px, the length of a cone's side, at the angle of the dynamic friction.
  const size = 92 / Math.hypot(1, (await live.state()).parameters.dynamic);
  await live.page.mouse.move(foot.x - size * (await live.state()).parameters.dynamic, foot.y - size);
  await live.until(() => /** @type {HTMLElement} */ (document.querySelector("#stage")).dataset.over === "dynamic");
  await live.page.mouse.down();
  await live.page.mouse.move(foot.x - 60, foot.y - 75, { steps: 6 });
  await live.page.mouse.up();
  await live.until(() => Math.abs((window.stiction.state?.parameters.dynamic ?? 0) - 0.8) < 0.02);
  await live.fresh();
  for (const name of /** @type {const} */ (["static", "dynamic"])) {
    const [place, most] = await live.page.$eval(`#slide-${name}`, (slider) => {
      const { value, max } = /** @type {HTMLInputElement} */ (slider);
      return [Number(value), Number(max)];
    });
    assert.ok(Math.abs((1.5 * place) / most - 0.8) < 0.03, `${name}: ${place} of ${most}`);
  }
});

aloneTest("the address shows another page the same scene, parameters and window", async (live, open) => {
  await live.scene("ladder");
  await live.page.fill("#type-stiffness_translation", "820");
  await live.page.press("#type-stiffness_translation", "Enter");
  await live.page.selectOption("#number", "f64");
  await live.page.selectOption("#evolution", "frame");
  await live.page.uncheck('[data-layer="trails"]');
  await live.page.click("#zoom-in");
  await live.until(() => /k_h=820/.test(location.hash) && /view=/.test(location.hash) && /hide=trails/.test(location.hash));
  const hash = await live.page.evaluate(() => location.hash);
  const other = await open(hash);
  await other.until(() => {
    const { number, evolution, parameters } = window.stiction.state ?? {};
    return number === "f64" && evolution === "frame" && parameters?.stiffness_translation === 820;
  });
  await other.until((wanted) => location.hash === wanted, hash);
  await other.drawn();
  const [mine, theirs] = [await live.state(), await other.state()];
  assert.deepEqual(theirs.scene, mine.scene);
  assert.deepEqual(theirs.parameters, mine.parameters);
  assert.deepEqual([theirs.number, theirs.evolution], ["f64", "frame"]);
  const [a, b] = [await live.pixel(0.1, 0.1), await other.pixel(0.1, 0.1)];
  assert.ok(Math.hypot(a.x - b.x, a.y - b.y) < 0.5, JSON.stringify([a, b]));
  assert.equal(await other.page.isChecked('[data-layer="trails"]'), false);
});

for (const file of [false, true]) {
  const where = file ? "in one file" : "from a web host";
  aloneTest(`${where} the scene of the address is shown in motion until a key is pressed, and every scene has its picture`, async (live, open) => {
    await live.seesAllCards();
    const other = await open("#scene=ladder&weight=1.5", "no-preference");
    await other.until(() => window.stiction.state?.replay?.demonstration && (window.stiction.frame?.position ?? 0) > 0.5);
    const { scene, parameters } = await other.state();
    assert.deepEqual([scene.title, scene.weight, parameters.weight], ["ladder", 1.5, 1.5]);
    await other.page.keyboard.press("Shift");
    await other.until(() => window.stiction.state?.replay === null);
    assert.match(await other.page.evaluate(() => location.hash), /weight=1\.5/);
  }, { file });
}

aloneTest("an address that cannot be followed is reported", async (live) => {
  await live.page.evaluate(() => { location.hash = "#scene=nowhere"; });
  await live.reads("#note", /no scene "nowhere", allowed: /);
  await live.page.evaluate(() => { location.hash = "#scene=ladder&mu_s=much"; });
  await live.reads("#note", /mu_s=much in the address: allowed is a number/);
  assert.equal((await live.state()).scene.title, "ladder");
  for (const [hash, words] of /** @type {const} */ ([
    ["#foo=1", /^foo in the address: allowed are scene, file, k_h, .*hide\.$/],
    ["#scene=ladder&number=f16", /^number=f16 in the address: allowed are f32, f64, fixed\.$/],
    ["#scene=mine&file=H4sIAAAAAAAAA", /^The address is cut off or damaged: the scene in it cannot be read\.$/],
    ["#scene=mine&file=H4sIAAAAAAAAA1M", /^The address is cut off or damaged: the scene in it cannot be read\.$/],
  ])) {
    await live.page.evaluate((text) => { location.hash = text; }, hash);
    await live.reads("#note", words);
  }
  assert.equal((await live.state()).scene.title, "ladder");
});

aloneTest("a path of the hand is refused with what is allowed", async (live) => {
  const coming = live.page.waitForEvent("filechooser");
  await live.page.click("#open-scene");
  await (await coming).setFiles({ name: "hand.txt", mimeType: "text/plain", buffer: Buffer.from("0 0 0") });
  await live.reads("#note", /^hand\.txt: paths of the hand .*Allowed here: a scene \(\.toml\)\.$/);
});

aloneTest("an address that changes while another one is followed is followed next", async (live) => {
  await live.page.evaluate(() => {
    new MutationObserver((_, observer) => {
      observer.disconnect();
      location.hash = "#scene=ladder&k_h=820";
    }).observe(/** @type {Node} */ (document.getElementById("note")), { childList: true, characterData: true, subtree: true });
    location.hash = "#scene=nowhere";
  });
  await live.until(() => window.stiction.state?.parameters?.stiffness_translation === 820);
  assert.equal((await live.state()).scene.title, "ladder");
  await live.until(() => location.hash === "#scene=ladder&k_h=820");
});

// The solver in three number types is nine tenths of it; a line of 10 Mbit/s brings it in 0.4 s.
aloneTest("the page with its solver weighs at most 470 kB, and shows its first frame from these files alone", async (live) => {
  const sizes = (await filesOfFirstDrawing(live)).map((name) => brotliCompressSync(readFileSync(join(folder, name))).length);
  const sum = sizes.reduce((all, size) => all + size, 0);
  assert.ok(sum <= 470_000, `${sum} bytes`);
});
