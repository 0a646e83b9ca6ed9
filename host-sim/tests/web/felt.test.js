// Slips that are heard and felt, and the visible scene as files: a picture and a film.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { PHONE } from "./fingers.js";
import { liveTest } from "./live.js";

/** @typedef {import("./live.js").Live} Live */

/** Number of slips that are awaited. */
const SLIPS = 4;

/**
 * Returns the loudness of a slip of a length, or of a slide at a speed: the RMS amplitude over half a second.
 * @param {Live} live @param {{slip?: number, speed?: number, sliding?: number}} what in sizes of the body, and a second
 */
function loudness(live, what) {
  return live.page.evaluate(async ({ slip, speed = 0, sliding = 1 }) => {
    const { Felt } = await import(new URL("felt.js", document.baseURI).href);
    const context = new OfflineAudioContext(1, 24_000, 48_000);
    const felt = new Felt(context);
    const scene = /** @type {StateMessage} */ (window.stiction.state).scene;
    const size = Math.max(...scene.body.map(([x, y]) => Math.hypot(x, y)));
    const step = 0.016;
    const contact = { vertex: 0, point: [0, 0], normal: 1, friction: 0.3, sliding };
    const message = (/** @type {number} */ k) => ({
      frame: { t: k * step, pose: [k * step * speed * size, 0, 0], contacts: [contact] },
      slips: slip !== undefined && k === 1 ? [{ n: 1, t: step, point: [0, 0], direction: [0, 1], length: slip * size }] : [],
    });
    for (const k of [0, 1]) felt.take(message(k), scene);
    const samples = (await context.startRendering()).getChannelData(0);
    return Math.sqrt(samples.reduce((sum, y) => sum + y * y, 0) / samples.length);
  }, what);
}

liveTest("the longer a slip and the faster a slide, the louder; what is rounding is silent", async (bench) => {
  const live = await bench.open();
  const slips = [];
  for (const slip of [1e-5, 1e-4, 1e-3, 1e-2, 1e-1]) slips.push(await loudness(live, { slip }));
  for (let k = 1; k < slips.length; k++) assert.ok(slips[k] > 1.5 * slips[k - 1], String(slips));
  const slides = [];
  for (const speed of [0.02, 0.2, 2]) slides.push(await loudness(live, { speed }));
  for (let k = 1; k < slides.length; k++) assert.ok(slides[k] > 1.5 * slides[k - 1], String(slides));
  assert.ok(slides[2] > 0 && slides[0] > 0);
  for (const what of [{ slip: 5e-7 }, { speed: 0 }, { speed: 5e-7 }, { speed: 2, sliding: 0 }]) {
    assert.equal(await loudness(live, what), 0, JSON.stringify(what));
  }
});

/** Presses the box down and drags it until it has slipped this many times. @param {Live} live @param {number} count */
async function slip(live, count) {
  await live.grab();
  const { hand, pose } = (await live.frame()).frame;
  const { body } = (await live.state()).scene;
  await live.handTo(hand[0], hand[1] - pose[1] - Math.min(...body.map(([, y]) => y)) - 0.01);
  const before = (await live.frame()).counts.slips;
  for (let k = 0; (await live.frame()).counts.slips < before + count; k++) {
    assert.ok(k < 1000, "it does not slip");
    await live.drag(3, 0);
    await live.fresh();
  }
  await live.page.mouse.up();
  await live.until(() => window.stiction.frame?.holding === null);
  await live.fresh();
}

liveTest("slips are heard and felt while that is wanted, and not before", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await page.addInitScript(() => {
    const counts = { bursts: 0, contexts: 0, phone: 0, pad: 0 };
    Object.assign(window, { counts });
    const start = AudioBufferSourceNode.prototype.start;
    AudioBufferSourceNode.prototype.start = function (...args) {
      // The noise of sliding starts without a time.
      if (args.length > 0) counts.bursts++;
      return start.apply(this, /** @type {[number?, number?, number?]} */ (args));
    };
    window.AudioContext = class extends AudioContext {
      constructor() {
        super();
        counts.contexts++;
      }
    };
    navigator.vibrate = (pattern) => {
      if (Number(pattern) > 0) counts.phone++;
      return true;
    };
    const playEffect = async () => {
      counts.pad++;
      return "complete";
    };
    navigator.getGamepads = () => /** @type {any} */ ([null, { vibrationActuator: { playEffect } }]);
  });
  await page.reload();
  await live.until(() => window.stiction?.connected && window.stiction.framesDrawn > 0);
  const counts = () => page.evaluate(() => /** @type {any} */ (window).counts);
  const pressed = (/** @type {string} */ wanted) =>
    live.until((value) => document.querySelector("#sound")?.getAttribute("aria-pressed") === value, wanted);

  await pressed("false");
  await slip(live, 1);
  assert.deepEqual(await counts(), { bursts: 0, contexts: 0, phone: 0, pad: 0 });
  await page.click("#reset");
  await live.until(() => window.stiction.frame?.frame.state === "non-contact" && window.stiction.frame.holding);

  await page.click("#sound");
  await pressed("true");
  await live.until(() => /** @type {any} */ (window).counts.contexts === 1);
  await slip(live, SLIPS);
  // A tick may have more than one slip, and is one burst.
  const felt = await counts();
  const all = (await live.frame()).counts.slips;
  assert.ok(felt.bursts >= 1 && felt.bursts <= all && felt.bursts >= all - 2, `${felt.bursts} of ${all} slips`);
  assert.ok(felt.phone >= 1 && felt.phone <= felt.bursts && felt.pad === felt.phone, JSON.stringify(felt));

  // Off again, by its key.
  await page.click("#reset");
  await live.until(() => window.stiction.frame?.frame.state === "non-contact" && window.stiction.frame.holding);
  await page.focus("#stage");
  await page.keyboard.press("m");
  await pressed("false");
  await slip(live, 1);
  assert.deepEqual(await counts(), felt);
});

/** Size of pictures and films: 1080p. */
const SIZE = { width: 1920, height: 1080 };

/**
 * Presses a button, by mouse or by finger, and returns the downloaded file.
 * @param {Live} live @param {string} button @param {boolean} touches
 */
async function fileOf(live, button, touches) {
  const coming = live.page.waitForEvent("download");
  await (touches ? live.page.tap(button) : live.page.click(button));
  const download = await coming;
  return { name: download.suggestedFilename(), bytes: readFileSync(await download.path()) };
}

for (const [by, options] of /** @type {const} */ ([
  ["mouse", undefined],
  ["finger", PHONE],
])) {
  liveTest(`a picture and a film of the scene are saved, by ${by}`, async (bench) => {
    const live = await bench.open(options);
    const { page } = live;
    const touches = options !== undefined;
    await page.selectOption("#replay", "scene");
    await live.until(() => (window.stiction.frame?.counts.slips ?? 0) > 1);
    await page.evaluate(() => window.scrollTo(0, 0));

    const picture = await fileOf(live, "#picture", touches);
    assert.match(picture.name, /^box-flat-\d{8}-\d{6}\.png$/);
    assert.deepEqual([...picture.bytes.subarray(0, 8)], [0x89, 0x50, 0x4e, 0x47, 0x0d, 0x0a, 0x1a, 0x0a]);
    // Width and height in the first chunk, as in the specification of PNG.
    assert.deepEqual({ width: picture.bytes.readUInt32BE(16), height: picture.bytes.readUInt32BE(20) }, SIZE);

    await (touches ? page.tap("#film") : page.click("#film"));
    await live.until(() => document.querySelector("#film")?.getAttribute("aria-pressed") === "true");
    const from = await page.evaluate(() => performance.now());
    await live.until((begun) => performance.now() - begun > 1500, from);
    const film = await fileOf(live, "#film", touches);
    await live.until(() => document.querySelector("#film")?.getAttribute("aria-pressed") === "false");
    assert.match(film.name, /^box-flat-\d{8}-\d{6}\.webm$/);
    // EBML, and more than a single still picture.
    assert.deepEqual([...film.bytes.subarray(0, 4)], [0x1a, 0x45, 0xdf, 0xa3]);
    assert.ok(film.bytes.length > 10_000, `${film.bytes.length} bytes`);
    // A player shows it in its size, and for its real duration.
    const player = await page.context().newPage();
    const shown = await player.evaluate(async (data) => {
      const video = document.createElement("video");
      video.src = `data:video/webm;base64,${data}`;
      video.currentTime = 1e6;
      await new Promise((done) => video.addEventListener("seeked", done, { once: true }));
      return { width: video.videoWidth, height: video.videoHeight, seconds: video.currentTime };
    }, film.bytes.toString("base64"));
    await player.close();
    assert.deepEqual({ width: shown.width, height: shown.height }, SIZE);
    assert.ok(shown.seconds > 1 && shown.seconds < 20, `${shown.seconds} s`);
  });
}

liveTest("an animation of the scene is saved, which shows its slips in real time", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await page.selectOption("#replay", "scene");
  await live.until(() => (window.stiction.frame?.counts.slips ?? 0) > 1);
  await page.click("#animation");
  const from = await page.evaluate(() => performance.now());
  await live.until((begun) => performance.now() - begun > 1500, from);
  const { name, bytes } = await fileOf(live, "#animation", false);
  assert.match(name, /^box-flat-\d{8}-\d{6}\.gif$/);
  const { count, seconds, differ, width, height } = await page.evaluate(async (data) => {
    const decoder = new ImageDecoder({ data: Uint8Array.from(atob(data), (c) => c.charCodeAt(0)), type: "image/gif" });
    await decoder.tracks.ready;
    await decoder.completed;
    const { frameCount } = decoder.tracks.selectedTrack ?? { frameCount: 0 };
    const images = await Promise.all(Array.from({ length: frameCount }, (_, frameIndex) => decoder.decode({ frameIndex })));
    const pixels = await Promise.all([images[0], images[frameCount - 1]].map(async ({ image }) => {
      const rgba = new Uint8Array(image.allocationSize({ format: "RGBA" }));
      await image.copyTo(rgba, { format: "RGBA" });
      return rgba;
    }));
    return {
      count: frameCount, seconds: images.reduce((sum, { image }) => sum + (image.duration ?? 0), 0) / 1e6,
      differ: pixels[0].filter((value, i) => value !== pixels[1][i]).length,
      width: images[0].image.displayWidth, height: images[0].image.displayHeight,
    };
  }, bytes.toString("base64"));
  assert.deepEqual({ width, height }, { width: 960, height: 540 });
  assert.ok(count >= 5, `${count} images`);
  assert.ok(seconds > 1 && seconds < 10, `${seconds} s`);
  assert.ok(differ > 1000, `${differ} bytes differ`);
});

liveTest("a picture of the whole page is saved", async (bench) => {
  const live = await bench.open();
  await live.page.click("#whole-page");
  const { bytes } = await fileOf(live, "#picture", false);
  assert.deepEqual([...bytes.subarray(1, 4)], [0x50, 0x4e, 0x47]);
  assert.ok(bytes.readUInt32BE(16) > 300 && bytes.length > 10_000, `${bytes.length} bytes`);
});
