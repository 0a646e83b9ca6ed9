// The editor of the scene: what is drawn, dragged, typed, undone and saved reaches the solver, with the program and without.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { Host, missingPage } from "./alone.js";
import { Live, liveTest, newFolder, openParts, Program, runProgram, shared } from "./live.js";

/** Returns the position of a handle of the editor (CSS px). @param {Live} live @param {string} key */
async function spotOf(live, key) {
  const box = await live.page.locator(`[data-handle="${key}"]`).boundingBox();
  assert.ok(box, key);
  return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
}

/**
 * Drags a handle.
 * @param {Live} live @param {string} key @param {number} dx px @param {number} dy px
 * @param {number} steps what is in between is tried, too
 */
async function pull(live, key, dx, dy, steps = 5) {
  const { x, y } = await spotOf(live, key);
  await live.page.mouse.move(x, y);
  await live.page.mouse.down();
  await live.page.mouse.move(x + dx, y + dy, { steps });
  await live.page.mouse.up();
}

/** Drops a file onto the page. @param {Live} live @param {string} name @param {string} text */
function drop(live, name, text) {
  return live.page.evaluate(([called, content]) => {
    const data = new DataTransfer();
    data.items.add(new File([content], called));
    document.body.dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }));
  }, [name, text]);
}

/** Saves the scene; returns its text. @param {Live} live */
async function save(live) {
  const coming = live.page.waitForEvent("download");
  await live.page.click("#save-scene");
  const download = await coming;
  return { name: download.suggestedFilename(), text: readFileSync(await download.path(), "utf8") };
}

/**
 * Draws a polygon with the pen.
 * @param {Live} live @param {[number, number][]} corners as seen from the middle of the stage (px)
 */
async function drawPolygon(live, corners) {
  const box = await live.page.locator("#stage").boundingBox();
  assert.ok(box);
  for (const [dx, dy] of corners) await live.page.mouse.click(box.x + box.width / 2 + dx, box.y + box.height / 2 + dy);
  await live.page.keyboard.press("Enter");
}

liveTest("a click on its first point closes a polygon", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await page.click("#edit");
  for (const corners of [3, 4, 5, 6]) {
    await page.click('.editor-bar [aria-label="Draw the object\'s polygon"]');
    const box = await page.locator("#stage").boundingBox();
    assert.ok(box);
    const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
    for (let k = 0; k < corners; k++) {
      const angle = (2 * Math.PI * k) / corners;
      await page.mouse.click(x + 60 * Math.cos(angle), y + 60 * Math.sin(angle));
    }
    // A hand presses for longer than a drawing takes.
    await page.mouse.move(x + 60, y);
    await page.mouse.down();
    await live.drawn();
    await page.mouse.up();
    await live.until((count) => window.stiction.state?.scene.body.length === count, corners);
    assert.equal(await page.locator(".pen").count(), 0);
  }
});

liveTest("the page says what becomes of lines that cross, and of a single point", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await page.click("#edit");
  for (const [corners, count, words] of /** @type {[[number, number][], number, RegExp][]} */ ([
    [[[-60, -80], [60, -20], [60, -80], [-60, -20]], 4, /^The lines cross\. The polygon is the convex one around the points\.$/],
    [[[0, -60]], 1, /^The object is a point\.$/],
    [[[60, -80], [-60, -80], [-60, -20], [50, -20], [0, -30]], 4, /^The polygon is convex: 1 of the points is left out\.$/],
  ])) {
    await page.click('.editor-bar [aria-label="Draw the object\'s polygon"]');
    await drawPolygon(live, corners);
    await live.reads("#note", words);
    await live.until((wanted) => window.stiction.state?.scene.body.length === wanted, count);
  }
});

liveTest("a polygon that is drawn a little into floor, wall and obstacle is moved out of them, and one that is deep is refused in words", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  live.expects(/status 400: .*\/edit\?/);
  live.expects(/error: Failed to load resource: .*400/);
  await page.click("#edit");
  const box = await page.locator("#stage").boundingBox();
  assert.ok(box);
  const [floor] = (await live.state()).scene.surfaces;
  const ground = (await live.pixel(0, floor.offset)).y - box.y - box.height / 2;
  await page.click('.editor-bar [aria-label="Add an obstacle"]');
  await drawPolygon(live, [[120, ground], [120, ground - 90], [170, ground - 90], [170, ground]]);
  await live.until(() => window.stiction.state?.scene.obstacles?.length === 1);
  const draw = () => page.click('.editor-bar [aria-label="Draw the object\'s polygon"]');
  const before = JSON.stringify((await live.state()).scene.body);
  await draw();
  await drawPolygon(live, [[0, ground + 5], [0, ground - 60], [127, ground - 60], [127, ground + 8]]);
  await live.until((body) => JSON.stringify(window.stiction.state?.scene.body) !== body, before);
  const { scene } = await live.state();
  const low = Math.min(...scene.body.map(([, y]) => y + scene.start[1]));
  const right = Math.max(...scene.body.map(([x]) => x + scene.start[0]));
  const wall = Math.min(...(scene.obstacles ?? []).flatMap(({ vertices }) => vertices.map(([x]) => x)));
  const near = 1e-6;
  assert.ok(low >= floor.offset && low < floor.offset + near, `${low} at a floor of ${floor.offset}`);
  assert.ok(right <= wall && right > wall - near, `${right} at a wall of ${wall}`);

  // What is much deeper is meant: it is refused, and what is changed meanwhile is not lost.
  await draw();
  await drawPolygon(live, [[-60, ground + 40], [-60, ground - 40], [60, ground - 40], [60, ground + 40]]);
  await live.reads(".editor-problem", /^The object reaches \d+(\.\d+)? mm into “floor”\. Move one of the two/);
  await page.click('.editor-bar [aria-label="Add a surface"]');
  await page.focus('[data-handle="surface-0"]');
  for (let k = 0; k < 12; k++) await page.keyboard.press("ArrowDown");
  await live.until(() => window.stiction.state?.scene.surfaces.length === 2);
});

/**
 * Edits a scene from its polygon to its file, which is opened again.
 * @param {Live} live @returns {Promise<string>} the saved text
 */
async function edits(live) {
  const { page } = live;
  await page.click("#edit");
  await page.click('.editor-bar [aria-label="Draw the object\'s polygon"]');
  // A pentagon and a point inside it, which is no corner of a convex polygon.
  await drawPolygon(live, [[-80, 40], [-60, -40], [0, -70], [10, 0], [70, -30], [60, 40]]);
  await live.until(() => window.stiction.state?.scene.body.length === 5);
  await live.reads("#note", /1 of the points is left out/);
  const drawn = (await live.state()).scene;
  assert.deepEqual(drawn.title, "my-box-flat");

  // A corner follows the mouse by the same displacement.
  const metres = await live.metresPerPixel();
  const corner = drawn.body[0];
  await pull(live, "body-0", -20, 0);
  await live.until(([x, y, near]) => {
    const [u, v] = window.stiction.state?.scene.body[0] ?? [Infinity, Infinity];
    return Math.abs(u - x) < near && Math.abs(v - y) < near;
  }, [corner[0] - 20 * metres, corner[1], metres]);

  // A surface moves along its normal.
  const { offset } = drawn.surfaces[0];
  await pull(live, "surface-0", 7, 30);
  await live.until(([wanted, near]) => Math.abs((window.stiction.state?.scene.surfaces[0].offset ?? Infinity) - wanted) < near,
    [offset - 30 * metres, metres]);
  assert.deepEqual((await live.state()).scene.surfaces[0].normal, [0, 1]);

  // A shape that is not convex is refused and marked, and nothing is applied.
  const before = (await live.state()).scene.body;
  await pull(live, "body-2", 0, 200, 1);
  await live.reads(".editor-problem", /body\.vertices/);
  assert.ok(await page.locator('[data-handle^="body"].bad').count() > 0);
  assert.deepEqual((await live.state()).scene.body, before);
  await page.keyboard.press("Control+z");
  await live.until(() => document.querySelector(".editor-problem")?.textContent === "");

  // Friction is typed, undone and redone.
  await (await page.waitForSelector('[data-handle="surface-0"]')).focus();
  const rough = page.locator('.editor-card [data-field="static"]');
  await rough.fill("0.77");
  await rough.press("Enter");
  await live.until(() => window.stiction.state?.scene.surfaces[0].static === 0.77);
  await page.click('.editor-bar [aria-label="Undo"]');
  await live.until(() => window.stiction.state?.scene.surfaces[0].static !== 0.77);
  await page.click('.editor-bar [aria-label="Redo"]');
  await live.until(() => window.stiction.state?.scene.surfaces[0].static === 0.77);

  // An obstacle is drawn, moved by the keyboard, and gets another corner by a double click.
  await page.click('.editor-bar [aria-label="Add an obstacle"]');
  await drawPolygon(live, [[150, 20], [200, 20], [200, 60], [150, 60]]);
  await live.until(() => window.stiction.state?.scene.obstacles?.length === 1);
  const left = (await live.state()).scene.obstacles?.[0].vertices[0][0] ?? NaN;
  await page.locator('[data-handle="obstacle-0"]').focus();
  await page.keyboard.press("ArrowRight");
  await live.until((x) => (window.stiction.state?.scene.obstacles?.[0].vertices[0][0] ?? x) > x, left);
  const box = await page.locator('[data-handle="obstacle-0"]').boundingBox();
  assert.ok(box);
  await page.mouse.dblclick(box.x + 2, box.y + 17);
  await live.until(() => window.stiction.state?.scene.obstacles?.[0].vertices.length === 5);

  // Its file is the same scene.
  const wanted = (await live.state()).scene;
  const { name, text } = await save(live);
  assert.equal(name, "my-box-flat.toml");
  await page.click(".editor-bar .main");
  await live.until(() => !document.querySelector(".editor-bar"));
  await drop(live, "saved.toml", text);
  await live.until(() => window.stiction.state?.scene.title === "saved");
  assert.deepEqual((await live.state()).scene, { ...wanted, title: "saved" });
  assert.ok(await page.locator('#scenes input[value="my-box-flat"]').count() === 1);

  // A file with a mistake is refused with its line, and the present scene continues.
  await drop(live, "broken.toml", text.replace(/weight = .*/, 'weight = "much"'));
  await live.reads("#note", /broken\.toml, line \d+: `body\.weight`/);
  assert.equal((await live.state()).scene.title, "saved");
  // The message does not stay over a scene that is opened afterwards.
  await drop(live, "saved.toml", text);
  await page.waitForSelector("#note", { state: "hidden", timeout: 3000 });
  return text;
}

liveTest("a scene is drawn, changed, undone, saved, opened and run", async (bench) => {
  const live = await bench.open();
  live.expects(/status 400: .*\/(edit|scene)\?/);
  live.expects(/error: Failed to load resource: .*400/);
  const text = await edits(live);
  const folder = newFolder();
  writeFileSync(join(folder, "saved.toml"), text);
  await runProgram(["run", "saved.toml", "--quiet"], folder);
  // A scene of the reader has its picture after the page is loaded again, also while another one is shown.
  const own = (await live.state()).scene.title;
  await live.scene("box-flat");
  await live.page.reload();
  await live.until(() => window.stiction?.connected && window.stiction.framesDrawn > 0);
  await live.page.locator(`[data-scene="${own}"]`).scrollIntoViewIfNeeded();
  await live.page.waitForSelector(`[data-scene="${own}"] svg`);
  await live.scene(own);
  // Changes by the sliders are undone by a reset, and by the button without one.
  await live.page.fill("#type-static", "0.2");
  await live.page.press("#type-static", "Enter");
  await live.until(() => window.stiction.state?.parameters.static === 0.2);
  await live.page.click("#defaults");
  await live.until(() => window.stiction.state?.parameters.static === 0.77);
});

test("a file that is edited is shown anew, a broken one is reported with its line", { skip: shared().missing }, async () => {
  const folder = newFolder();
  const file = join(folder, "mine.toml");
  const text = (/** @type {string} */ weight) => `[body]\nrectangle = [0.1, 0.06]\nstart = [0.0, 0.1, 0.0]\nweight = ${weight}\n` +
    "[spring]\ntranslation = 500.0\nrotation = 0.5\n";
  writeFileSync(file, text("1.0"));
  const program = await Program.start([file]);
  const page = await shared().get().newPage();
  const live = new Live(page, program.origin);
  try {
    await page.goto(`${program.origin}/`);
    await live.until(() => window.stiction?.state?.scene.weight === 1);
    writeFileSync(file, text("2.0"));
    await live.until(() => window.stiction.state?.scene.weight === 2);
    writeFileSync(file, text("heavy"));
    await live.reads("#scene-problem", /mine\.toml, line 4:/);
    assert.equal((await live.state()).scene.weight, 2);
    writeFileSync(file, text("3.0"));
    await live.until(() => window.stiction.state?.scene.weight === 3 && document.querySelector("#scene-problem")?.textContent === "");
    live.check();
  } finally {
    await page.close();
    await program.kill();
  }
});

test("the page without a server edits, saves and opens scenes", { skip: missingPage || shared().missing }, async () => {
  const host = await Host.start();
  const context = await shared().get().newContext({ viewport: { width: 1280, height: 800 }, colorScheme: "light" });
  const live = new Live(await context.newPage(), host.origin);
  try {
    await openParts(live.page);
    await live.page.goto(`${host.origin}/`);
    await live.until(() => window.stiction?.connected && window.stiction.framesDrawn > 0);
    await live.scene("box-flat");
    await edits(live);
    for (const own of ["my-box-flat", "saved"]) await live.page.waitForSelector(`[data-scene="${own}"] svg path`, { state: "attached" });
    // A link shows the scene that was drawn to everyone who opens it, in a browser that has never seen it.
    const { scene, parameters } = await live.state();
    await live.until((title) => location.hash.includes(`scene=${title}&file=`), scene.title);
    const link = await live.page.evaluate(() => location.href);
    const elsewhere = await shared().get().newContext();
    const other = new Live(await elsewhere.newPage(), host.origin);
    await other.page.goto(link);
    await other.until((title) => window.stiction?.state?.scene.title === title, scene.title);
    assert.deepEqual((await other.state()).scene, scene);
    assert.deepEqual((await other.state()).parameters, parameters);
    other.check();
    await elsewhere.close();
    live.check();
  } finally {
    await context.close();
    await host.kill();
  }
});
