// Every control of the page has its effect, judged by the solver's behaviour and by what the page then shows.

import assert from "node:assert/strict";
import { readdirSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { liveTest, newFolder } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

const PARAMETERS = /** @type {const} */ (["stiffness_translation", "stiffness_rotation", "static", "dynamic"]);
/** Least number of digits of a number on the page. */
const DIGITS = 3;

/** Waits until a parameter has changed; returns its value. @param {Live} live @param {string} name @param {number | null} old */
async function changed(live, name, old) {
  await live.until(([key, value]) => window.stiction.state?.parameters[key] !== value, /** @type {[string, number | null]} */ (
    [name, old]
  ));
  return (await live.state()).parameters[name];
}

/** Types into a field. @param {Live} live @param {string} name @param {string} text */
async function type(live, name, text) {
  await live.page.fill(`#type-${name}`, text);
  await live.page.press(`#type-${name}`, "Enter");
}

/** Presses the box onto the floor, with the mouse down. @param {Live} live @param {number} depth m */
async function press(live, depth) {
  await live.grab();
  const { hand } = (await live.frame()).frame;
  const { body, grasp } = (await live.state()).scene;
  await live.handTo(hand[0], (grasp?.[1] ?? 0) - Math.min(...body.map(([, y]) => y)) - depth);
  await live.until(() => window.stiction.frame?.frame.state === "edge");
}

for (const name of PARAMETERS) {
  liveTest(`the slider and the field of ${name}`, async (bench) => {
    const live = await bench.open();
    const { page } = live;
    const field = async () => Number(await page.inputValue(`#type-${name}`));
    const first = (await live.state()).parameters[name];
    await page.focus(`#slide-${name}`);
    /** @type {number[]} */
    const values = [];
    for (const key of ["End", "Home"]) {
      await page.keyboard.press(key);
      values.push(await changed(live, name, values.at(-1) ?? first));
      assert.equal(await field(), values.at(-1));
    }
    // With the mouse to the middle.
    const box = await page.locator(`#slide-${name}`).boundingBox();
    assert.ok(box);
    await page.mouse.click(box.x + box.width / 2, box.y + box.height / 2);
    values.push(await changed(live, name, values[1]));
    const [most, least, middle] = values;
    assert.ok(least < first && first < most, `${least} < ${first} < ${most}`);
    const between = name.startsWith("stiffness") ? Math.sqrt(least * most) : (least + most) / 2;
    assert.ok(Math.abs(middle / between - 1) < 0.05, `${middle} in the middle of ${least} and ${most}`);
    assert.ok(Math.abs((await field()) / middle - 1) < 10 ** -DIGITS);

    // A typed value is taken exactly, with a point or a comma, and the slider follows.
    const place = Number(await page.inputValue(`#slide-${name}`));
    const typed = name.startsWith("stiffness") ? 0.5 * first : 0.45;
    await type(live, name, String(typed).replace(".", ","));
    assert.equal(await changed(live, name, middle), typed);
    assert.ok(Number(await page.inputValue(`#slide-${name}`)) < place);
    // An invalid value is refused with a message, and the field shows the valid one again.
    for (const [text, words] of [
      ["much", /must be a number/],
      ["", /must be a number/],
      ["-1", /^(Static|Dynamic|Translational|Rotational) .* is -1; allowed: (more than 0|0 or more)\.$/],
      ["1e99", /^(Static|Dynamic|Translational|Rotational) .* is 1e99; allowed: at most 3\.4e38\.$/],
    ]) {
      await type(live, name, /** @type {string} */ (text));
      await live.reads("#note", /** @type {RegExp} */ (words));
      await live.until(
        ([key, value]) =>
          Number(/** @type {HTMLInputElement} */ (document.getElementById(`type-${key}`)).value) === value,
        [name, typed],
      );
      assert.equal((await live.state()).parameters[name], typed);
    }
  });
}

liveTest("the slider and the field of the memory length", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const field = () => page.inputValue("#type-memory");
  assert.equal((await live.state()).parameters.memory, null);
  assert.equal(await field(), "");
  await page.focus("#slide-memory");
  await page.keyboard.press("End");
  assert.equal(await changed(live, "memory", null), 0.01);
  assert.equal(await field(), "10000");
  await type(live, "memory", "25,5");
  assert.equal(await changed(live, "memory", 0.01), 25.5e-6);
  await type(live, "memory", "-1");
  await live.reads("#note", /allowed/);
  assert.equal((await live.state()).parameters.memory, 25.5e-6);
  await type(live, "memory", "");
  assert.equal(await changed(live, "memory", 25.5e-6), null);
});

/** Returns the sum of a component over contacts. @param {Contact[]} contacts @param {"normal" | "friction"} component */
const sum = (contacts, component) => contacts.reduce((total, contact) => total + contact[component], 0);

liveTest("the spring and the friction that are set are those that act; the hand keeps its hold", async (bench) => {
  const live = await bench.open();
  await live.page.check("#keep");
  const { body, grasp } = (await live.state()).scene;
  const touching = (grasp?.[1] ?? 0) - Math.min(...body.map(([, y]) => y));
  await press(live, 0.01);
  // The spring pulls sideways by less than static friction holds: 4 mm to 10 mm, with a coefficient of 0.5.
  const [x, y] = (await live.frame()).frame.hand;
  await live.handTo(x + 0.004, y);
  await live.page.mouse.up();
  await live.fresh();
  assert.ok((await live.frame()).holding);
  assert.equal((await live.frame()).counts.slips, 0);
  for (const stiffness of [1000, 250]) {
    await type(live, "stiffness_translation", String(stiffness));
    await live.until((k) => window.stiction.state?.parameters.stiffness_translation === k, stiffness);
    await live.fresh();
    const { contacts, hand, wrench } = (await live.frame()).frame;
    const normal = sum(contacts, "normal");
    // f32 has about seven digits for lengths that are ten times the depth.
    assert.ok(Math.abs(normal - stiffness * (touching - hand[1])) < 1e-4 * normal, `${normal} N at ${stiffness} N/m`);
    assert.ok(Math.abs(Math.abs(wrench[1]) - normal) < 1e-4 * normal);
  }
  // Too little friction to hold, with equal coefficients: it slides, and is within the cone again.
  await type(live, "static", "0.2");
  await live.until(
    () =>
      window.stiction.state?.parameters.static === 0.2 &&
      window.stiction.frame?.frame.contacts.some((contact) => contact.sliding !== 0),
  );
  assert.equal((await live.state()).parameters.dynamic, 0.2);
  await live.fresh();
  const { contacts } = (await live.frame()).frame;
  assert.ok(Math.abs(sum(contacts, "friction")) <= 0.2 * sum(contacts, "normal") * (1 + 1e-5));
  // More dynamic friction than static: the static one is raised as well.
  await type(live, "dynamic", "0.7");
  await live.until(() => window.stiction.state?.parameters.dynamic === 0.7);
  assert.equal((await live.state()).parameters.static, 0.7);

  await live.page.uncheck("#keep");
  await live.grab();
  await live.page.mouse.up();
  await live.until(() => window.stiction.frame?.holding === null);
  await live.reads("#hand-pose", /open/);
});

liveTest("after a reset the hand is at the beginning, also for a press that follows at once", async (bench) => {
  const live = await bench.open();
  await live.page.check("#keep");
  for (let round = 0; round < 3; round++) {
    await press(live, 0.01);
    await live.page.mouse.up();
    const { home } = (await live.state()).scene;
    const { x, y } = await live.pixel(home[0], home[1]);
    await live.page.mouse.move(x, y);
    await live.page.keyboard.press("r");
    await live.until(
      ([hx, hy]) => window.stiction.frame?.frame.hand[0] === hx && window.stiction.frame.frame.hand[1] === hy,
      home,
    );
    await live.page.mouse.down();
    await live.page.mouse.up();
    await live.fresh();
    const { frame, holding } = await live.frame();
    assert.deepEqual(frame.hand.slice(0, 2), home.slice(0, 2));
    assert.ok(holding);
  }
});

liveTest("every scene loads and is drawn", async (bench) => {
  const live = await bench.open();
  const scenes = new URL("../../scenes/", import.meta.url);
  const bundled = readdirSync(scenes)
    .filter((file) => file.endsWith(".toml"))
    .map((file) => file.replace(/\.toml$/, ""))
    .sort();
  const offered = await live.page.locator(".card").allTextContents();
  assert.deepEqual(offered.sort(), bundled);
  for (const name of bundled) {
    await live.scene(name);
    const state = await live.state();
    assert.ok(state.scene.body.length > 0);
    // The object, the ground's border and its solid side are visible.
    const { frame } = await live.frame();
    for (const role of ["body", "ink", "solid"]) assert.ok((await live.painted(role)) > 50, `${role} of ${name}`);
    const place = await live.pixel(frame.pose[0], frame.pose[1]);
    const box = await live.page.locator("#stage").boundingBox();
    assert.ok(
      box && place.x > box.x && place.x < box.x + box.width && place.y > box.y && place.y < box.y + box.height,
      name,
    );
  }
});

liveTest("the number type and the evolution", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  for (const number of ["f64", "fixed", "f32"]) {
    for (const evolution of ["frame", "path"]) {
      await page.selectOption("#number", number);
      await page.selectOption("#evolution", evolution);
      await live.until(
        ([n, e]) => window.stiction.state?.number === n && window.stiction.state.evolution === e,
        [number, evolution],
      );
      await live.reads("#trade-what", new RegExp(`^${number}, ${evolution} against`));
    }
  }
  // With f64 and path the solver equals its reference; with f32 it does not.
  await page.selectOption("#replay", "scene");
  for (const [number, exact] of /** @type {const} */ ([
    ["f64", true],
    ["f32", false],
  ])) {
    await page.selectOption("#number", number);
    await page.click("#reset");
    await live.until(
      (n) => window.stiction.state?.number === n && (window.stiction.frame?.counts.slips ?? 0) > 1,
      number,
    );
    const worst = (await live.frame()).reference?.worst ?? [];
    assert.equal(
      worst.every((error) => error === 0),
      exact,
      `${number}: ${worst}`,
    );
  }
});

liveTest("pause, step, slow motion, reset", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await page.selectOption("#replay", "scene");
  await live.until(() => window.stiction.frame && window.stiction.frame.frame.t > 0.3);
  await live.pause();
  assert.equal(await page.textContent("#pause-text"), "Go on");
  for (let k = 0; k < 3; k++) {
    const before = await live.frame();
    await page.click("#step");
    await live.until((tick) => window.stiction.frame?.tick !== tick, before.tick);
    await live.settled();
    const after = await live.frame();
    assert.equal(after.tick, before.tick + 1);
    assert.ok(Math.abs(after.frame.t - before.frame.t - 0.001) < 1e-9);
    // The text follows immediately, whatever its length.
    await live.until(
      (text) => document.querySelector("#body-pose")?.textContent?.startsWith(text),
      (1e3 * after.frame.pose[0])
        .toFixed(2)
        .replace(/^-?0\.00$/, "0.00")
        .replace("-", "−"),
    );
  }
  // A step while it runs pauses it.
  await page.click("#pause");
  await live.until(
    (tick) => !window.stiction.state?.paused && window.stiction.frame && window.stiction.frame.tick > tick,
    (await live.frame()).tick,
  );
  await page.click("#step");
  await live.until(() => window.stiction.state?.paused);
  await page.click("#pause");

  for (const speed of [0.1, 0.02]) {
    await page.selectOption("#speed", String(speed));
    await live.until((value) => window.stiction.state?.speed === value, speed);
    // How many a period makes is tested without a clock, as a slow computer makes up for periods that it was late for.
    await live.until((tick) => window.stiction.frame && window.stiction.frame.tick > tick, (await live.frame()).tick);
  }
  await page.selectOption("#speed", "1");
  await page.selectOption("#replay", "live");
  await live.until(() => window.stiction.state?.replay === null);
  await page.click("#reset");
  const { start, home } = (await live.state()).scene;
  await live.until(
    ([x, y]) =>
      window.stiction.frame && window.stiction.frame.frame.hand[0] === x && window.stiction.frame.frame.hand[1] === y,
    home,
  );
  const { frame, counts } = await live.frame();
  assert.ok(
    frame.pose.every((value, k) => Math.abs(value - start[k]) < 1e-6),
    String(frame.pose),
  );
  assert.equal(counts.slips, 0);
  assert.ok(Math.abs(counts.ticks / 1000 - frame.t) < 0.0015);
});

liveTest("zoom in, out, fit", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const fitted = await live.metresPerPixel();
  const ratios = [];
  for (const button of ["#zoom-in", "#zoom-in", "#zoom-out", "#zoom-out", "#zoom-out", "#zoom-fit"]) {
    await page.click(button);
    await live.drawn();
    ratios.push(fitted / (await live.metresPerPixel()));
  }
  const [once, twice, back, none, out, fit] = ratios;
  assert.ok(once > 1.1 && twice > once && out < 0.9, String(ratios));
  // Close to the floor, far from the middle of the body: the window stays there.
  for (let k = 0; k < 8; k++) await page.click("#zoom-in");
  await live.drawn();
  const close = await live.metresPerPixel();
  assert.ok(fitted / close > 5, String(fitted / close));
  for (let k = 0; k < 5; k++) await live.fresh();
  assert.equal(await live.metresPerPixel(), close);
  await page.click("#zoom-fit");
  for (const [a, b] of [
    [twice, once * once],
    [back, once],
    [none, 1],
    [out, 1 / once],
    [fit, 1],
  ]) {
    assert.ok(Math.abs(a / b - 1) < 0.01, String(ratios));
  }
});

liveTest("every layer of the drawing can be left out", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await page.selectOption("#replay", "scene");
  await live.until(() => (window.stiction.frame?.counts.slips ?? 0) > 1);
  await live.pause();
  const picture = () =>
    page.evaluate(
      () =>
        new Promise((take) =>
          requestAnimationFrame(() =>
            requestAnimationFrame(() =>
              take(/** @type {HTMLCanvasElement} */ (document.querySelector("#stage")).toDataURL()),
            ),
          ),
        ),
    );
  const whole = await picture();
  const layers = page.locator("input[data-layer]");
  assert.equal(await layers.count(), 5);
  for (const layer of await layers.all()) {
    await layer.uncheck();
    assert.notEqual(await picture(), whole, String(await layer.getAttribute("data-layer")));
    await layer.check();
    assert.equal(await picture(), whole, String(await layer.getAttribute("data-layer")));
  }
});

liveTest("the theme is changed and remembered", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const look = () =>
    page.evaluate(() => ({
      theme: document.documentElement.dataset.theme,
      page: getComputedStyle(document.body).backgroundColor,
      paper: getComputedStyle(/** @type {Element} */ (document.querySelector("#stage"))).backgroundColor,
    }));
  const light = await look();
  assert.equal(light.theme, "light");
  await page.click("#theme");
  await live.drawn();
  const dark = await look();
  assert.equal(dark.theme, "dark");
  assert.notEqual(dark.page, light.page);
  assert.notEqual(dark.paper, light.paper);
  assert.ok((await live.painted("paper")) > 10_000);
  await page.reload();
  await live.until(() => window.stiction?.connected && window.stiction.framesDrawn > 0);
  assert.deepEqual(await look(), dark);
  await page.click("#theme");
  await live.drawn();
  assert.deepEqual(await look(), light);
});

liveTest("the help opens and closes", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const help = page.locator("#help");
  await page.click("#help-open");
  assert.ok(await help.isVisible());
  await page.click("#help-close");
  assert.ok(await help.isHidden());
  await page.click("#help-open");
  await page.keyboard.press("Escape");
  assert.ok(await help.isHidden());
});

liveTest("let others hold gives the hand up", async (bench) => {
  const live = await bench.open();
  await live.page.check("#keep");
  await live.grab();
  await live.page.mouse.up();
  await live.reads("#holder", /this page/);
  await live.page.click("#let-go");
  await live.until(() => window.stiction.state?.hand.by === null);
  await live.reads("#holder", /at rest/);
});

liveTest("the chart shows the surface that is picked", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  assert.ok(await page.locator("#chart-surface").isHidden());
  await live.scene("corner-stick-slip");
  const names = (await live.state()).scene.surfaces.map(({ name }) => name);
  assert.deepEqual(await page.locator("#chart-surface option").allTextContents(), names);
  await page.selectOption("#replay", "scene");
  await live.until(() => {
    const contacts = window.stiction.frame?.frame.contacts ?? [];
    return new Set(contacts.map(({ surface }) => surface)).size > 1;
  });
  await live.pause();
  for (const name of [names[1], names[0]]) {
    await page.selectOption("#chart-surface", { label: name });
    const { tick } = await live.frame();
    await page.click("#step");
    await live.until((old) => window.stiction.frame && window.stiction.frame.tick > old, tick);
    const forces = (await live.frame()).frame.contacts
      .filter(({ surface }) => surface === name)
      .map(({ normal }) => normal);
    const normal = forces.reduce((total, force) => total + force, 0);
    assert.ok(normal > 0);
    await live.until((value) => {
      const shown = Number(document.querySelector("#now-n")?.textContent?.match(/[\d.]+/)?.[0]);
      return Math.abs(shown / value - 1) < 0.01;
    }, normal);
  }
});

liveTest("the hand follows the scene's path, an uploaded one, or nobody", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  const folder = newFolder();
  const { home } = (await live.state()).scene;
  assert.deepEqual(await page.locator("#replay option:disabled").allTextContents(), ["the recording", "uploaded path"]);
  await page.selectOption("#replay", "scene");
  await live.until(
    () => window.stiction.state?.replay?.what === "scene" && (window.stiction.frame?.position ?? 0) > 0.2,
  );
  await live.reads("#place", /^0\.\d of \d+\.\d s$/);
  await live.until((y) => window.stiction.frame && window.stiction.frame.frame.hand[1] < y - 0.005, home[1]);
  // Nobody holds the hand that a replay moves.
  await page.mouse.click(300, 300);
  await page.selectOption("#replay", "live");
  await live.until(() => window.stiction.state?.replay === null);
  const there = (await live.frame()).frame.hand;
  await live.fresh();
  await live.reads("#place", /^live/);
  assert.ok(Math.abs((await live.frame()).frame.hand[1] - there[1]) < 0.02);

  // A path of one second up by 20 mm.
  const rows = Array.from({ length: 101 }, (_, k) => `${k / 100},0.01,${0.07 + 0.0002 * k},0`);
  const good = join(folder, "upward.csv");
  writeFileSync(good, `t,x,y,phi\n${rows.join("\n")}\n`);
  await page.setInputFiles("#file", good);
  await live.reads("#note", /^upward\.csv: 101 records, 1\.0 s\.$/);
  await live.until(() => window.stiction.state?.replay?.what === "upward.csv" && window.stiction.frame?.position === 1);
  const { hand } = (await live.frame()).frame;
  assert.ok(Math.hypot(hand[0] - 0.01, hand[1] - 0.09) < 1e-6, String(hand));
  assert.match(await live.page.locator("#replay option:checked").innerText(), /upward\.csv/);

  // A malformed one is refused: the message names the line and what is allowed, and nothing changes.
  live.expects(/status of 400|status 400: .*upload/);
  for (const [row, line] of [
    ["1.01,wide,0.09,0", 103],
    ["0.5,0,0.09,0", 103],
  ]) {
    const bad = join(folder, "bad.csv");
    writeFileSync(bad, `t,x,y,phi\n${rows.join("\n")}\n${row}\n`);
    const answer = page.waitForResponse(/upload/);
    await page.setInputFiles("#file", bad);
    assert.equal((await answer).status(), 400);
    const note = await live.reads("#note", /bad\.csv cannot be used/);
    assert.match(note, new RegExp(`\\b${line}\\b`));
    assert.match(note, /allowed/);
    assert.equal((await live.state()).replay?.what, "upward.csv");
  }
});
