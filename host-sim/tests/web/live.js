// A browser, the program and its pages, for the tests of the live page. All faults of a page are collected, and a test fails on
// unexpected ones: messages on the console, errors, failed requests, requests to any other server.

import assert from "node:assert/strict";
import { spawn } from "node:child_process";
import { randomBytes } from "node:crypto";
import { accessSync, constants, existsSync, mkdtempSync, readFileSync, rmSync } from "node:fs";
import { connect } from "node:net";
import { tmpdir } from "node:os";
import { delimiter, join, resolve } from "node:path";
import { createInterface } from "node:readline";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { chromium } from "playwright-core";

/** Timeout of every wait (ms). */
export const PATIENCE = 60_000;
/** The window of a page, unless a test requests another one (px). */
const WINDOW = { width: 1280, height: 800 };

/** Returns the first executable file of a name in PATH. @param {string} name */
function inPath(name) {
  return (process.env.PATH ?? "")
    .split(delimiter)
    .map((folder) => join(folder, name))
    .find((file) => {
      try {
        accessSync(file, constants.X_OK);
        return true;
      } catch {
        return false;
      }
    });
}

/** Returns Chromium: from the environment, in PATH, or installed by playwright; undefined if there is none. */
function findChromium() {
  const own = () => (existsSync(chromium.executablePath()) ? chromium.executablePath() : undefined);
  return process.env.CHROMIUM ?? ["chromium", "chromium-browser", "google-chrome"].map(inPath).find(Boolean) ?? own();
}

const workspace = fileURLToPath(new URL("../../../", import.meta.url));
const browserFile = findChromium();
const target = process.env.CARGO_TARGET_DIR ?? join(workspace, "target");
const programFile = resolve(process.env.STICTION ?? join(target, "debug", "stiction"));

/** Reason why tests without a page cannot run here, or false. */
export const missingProgram = existsSync(programFile)
  ? false
  : `no ${programFile}: set STICTION, or type cargo build`;
/** Reason why the tests cannot run here, or false. */
const missing = browserFile ? missingProgram : "no Chromium: set CHROMIUM, or install it";
if (missing && process.env.CI === "true") throw new Error(missing);

/** Folders that are removed at the end of the process. @type {string[]} */
const folders = [];
process.on("exit", () => folders.forEach((folder) => rmSync(folder, { recursive: true, force: true })));

/** Makes a folder that is removed at the end of the process. */
export function newFolder() {
  const folder = mkdtempSync(join(tmpdir(), "stiction-page-"));
  folders.push(folder);
  return folder;
}

/** Starts Chromium. */
export function startBrowser() {
  return chromium.launch({ executablePath: browserFile, args: ["--no-sandbox", "--auto-accept-this-tab-capture"] });
}

/** A running `stiction view`. */
export class Program {
  /** @param {string[]} args @param {number} port */
  constructor(args, port) {
    const own = ["--listen", `127.0.0.1:${port}`, "--recordings", "recordings"];
    this.child = spawn(programFile, ["view", ...own, ...args], {
      cwd: newFolder(),
      stdio: ["ignore", "pipe", "pipe"],
    });
    this.gone = new Promise((done) => this.child.once("exit", done));
    /** Its error output. */
    this.said = "";
    this.child.stderr.on("data", (text) => {
      this.said += text;
    });
    this.origin = "";
    this.port = port;
  }

  /** @param {string[]} [args] by default the scene of most tests @param {number} [port] by default a free one */
  static async start(args = ["box-flat"], port = 0) {
    const program = new Program(args, port);
    const lines = createInterface(program.child.stdout);
    const line = await Promise.race([
      new Promise((take) => lines.once("line", take)),
      program.gone.then(() => program.said),
    ]);
    const [url] = /** @type {string} */ (line).match(/^http:\/\/\S+/) ?? [];
    assert.ok(url, line);
    program.origin = new URL(url).origin;
    program.port = Number(new URL(url).port);
    return program;
  }

  /** Kills it, as a crash would. */
  async kill() {
    this.child.kill("SIGKILL");
    await this.gone;
  }

  /** Resident memory (bytes), or null if the system does not report it. */
  get memory() {
    try {
      const [, kilobytes] = readFileSync(`/proc/${this.child.pid}/status`, "utf8").match(/^VmRSS:\s+(\d+) kB/m) ?? [];
      return kilobytes ? 1024 * Number(kilobytes) : null;
    } catch {
      return null;
    }
  }
}

/**
 * Connects a client of the socket that requests all frames repeatedly and reads none: a client that sends nothing is
 * disconnected. The program disconnects this one, too, when nothing has been read for half a minute.
 * @param {Program} program
 */
export async function stalled(program) {
  const socket = connect(program.port, "127.0.0.1");
  const key = randomBytes(16).toString("base64");
  socket.write(
    `GET /ws HTTP/1.1\r\nHost: 127.0.0.1:${program.port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n` +
      `Sec-WebSocket-Key: ${key}\r\nSec-WebSocket-Version: 13\r\n\r\n`,
  );
  const head = String(await new Promise((take) => socket.once("data", take)));
  assert.match(head, /^HTTP\/1\.1 101/);
  socket.pause();
  const text = Buffer.from('{"type":"rate","value":1000}');
  const ask = () => {
    const mask = randomBytes(4);
    socket.write(
      Buffer.concat([Buffer.from([0x81, 0x80 | text.length]), mask, text.map((byte, i) => byte ^ mask[i % 4])]),
    );
  };
  ask();
  const again = setInterval(ask, 5000);
  // The disconnection may come while a request is on its way.
  socket.on("error", () => {});
  socket.once("close", () => clearInterval(again));
  return socket;
}

/**
 * Runs the program to its end; returns its output.
 * @param {string[]} args @param {string} folder
 */
export async function runProgram(args, folder) {
  const child = spawn(programFile, args, { cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
  let output = "";
  child.stdout.on("data", (text) => {
    output += text;
  });
  child.stderr.on("data", (text) => {
    output += text;
  });
  const code = await new Promise((done) => child.once("close", done));
  assert.equal(code, 0, output);
  return output;
}

/** The frames and states that a page received, unmodified. */
class Received {
  constructor() {
    /** @type {any[]} */
    this.messages = [];
    this.bytes = 0;
    /** Whether to keep the messages; otherwise only their size is counted. */
    this.keep = false;
  }

  /** @param {string | Buffer} payload */
  take(payload) {
    this.bytes += payload.length;
    if (this.keep) this.messages.push(JSON.parse(String(payload)));
  }
}

/** An open page. */
export class Live {
  /** @param {import("playwright-core").Page} page @param {string} origin */
  constructor(page, origin) {
    this.page = page;
    this.origin = origin;
    this.received = new Received();
    /** @type {string[]} */
    this.faults = [];
    /** @type {RegExp[]} */
    this.expected = [];
    /** Position of the mouse during a drag (CSS px). @type {Spot | null} */
    this.pointer = null;
    page.setDefaultTimeout(PATIENCE);
    this.listen();
  }

  /** Collects all faults. */
  listen() {
    const { page } = this;
    page.on("console", (message) => {
      if (["error", "warning"].includes(message.type())) this.faults.push(`${message.type()}: ${message.text()}`);
    });
    page.on("pageerror", (error) => this.faults.push(`error: ${error.stack ?? error.message}`));
    page.on("crash", () => this.faults.push("the page crashed"));
    page.on("requestfailed", (request) => {
      const error = request.failure()?.errorText;
      // The browser itself gives up what a page still loads when the page is reloaded.
      if (error !== "net::ERR_ABORTED") this.faults.push(`failed: ${request.url()}: ${error}`);
    });
    page.on("response", (response) => {
      if (response.status() >= 400) this.faults.push(`status ${response.status()}: ${response.url()}`);
    });
    page.on("request", (request) => this.stays(request.url()));
    page.on("websocket", (socket) => {
      this.stays(socket.url().replace(/^ws/, "http"));
      socket.on("framereceived", ({ payload }) => this.received.take(payload));
    });
  }

  /** Checks that a request goes to the program, and nowhere else. @param {string} url */
  stays(url) {
    // Data made by the page itself cause no request.
    if (/^(data|blob):/.test(url)) return;
    if (new URL(url).origin !== this.origin) this.faults.push(`elsewhere: ${url}`);
  }

  /** Declares a fault that this test provokes. @param {RegExp} fault */
  expects(fault) {
    this.expected.push(fault);
  }

  /** Fails on unexpected faults. */
  check() {
    assert.deepEqual(
      this.faults.filter((fault) => !this.expected.some((known) => known.test(fault))),
      [],
    );
  }

  /**
   * Waits until a condition is true in the page.
   * @template T @param {string | ((arg: T) => unknown)} what @param {T} [arg]
   */
  async until(what, arg) {
    return (await this.page.waitForFunction(/** @type {any} */ (what), arg, { timeout: PATIENCE })).jsonValue();
  }

  /** Scrolls through the gallery: every scene has its picture. */
  async seesAllCards() {
    const cards = await this.page.locator(".card").all();
    assert.ok(cards.length > 0);
    for (const card of cards) {
      await card.scrollIntoViewIfNeeded();
      await card.locator("svg").waitFor({ state: "attached" });
    }
  }

  /** Waits for a text. @param {string} selector @param {RegExp} pattern */
  async reads(selector, pattern) {
    await this.until(
      ([place, source]) => new RegExp(source).test(document.querySelector(place)?.textContent ?? ""),
      [selector, pattern.source],
    );
    return this.text(selector);
  }

  /** Returns the text of an element. @param {string} selector */
  async text(selector) {
    return (await this.page.textContent(selector)) ?? "";
  }

  /** Returns the newest frame message. @returns {Promise<FrameMessage>} */
  frame() {
    return this.page.evaluate(() => /** @type {FrameMessage} */ (window.stiction.frame));
  }

  /** Returns the newest state message. @returns {Promise<StateMessage>} */
  state() {
    return this.page.evaluate(() => /** @type {StateMessage} */ (window.stiction.state));
  }

  /** Waits for frames made after now: two, as one may be in transit. */
  async fresh() {
    const from = await this.page.evaluate(() => window.stiction.framesReceived);
    await this.until((count) => window.stiction.framesReceived >= count + 2, from);
  }

  /** Waits until no other tick has come for a while: while paused, that is the last one. */
  async settled() {
    await this.until(() => {
      const page = /** @type {any} */ (window);
      const tick = window.stiction.frame?.tick;
      if (page.settling?.tick !== tick) page.settling = { tick, since: performance.now() };
      return performance.now() - page.settling.since > 200;
    });
  }

  /** Waits until the scene has been drawn again completely: twice, as a drawing may be in progress. */
  async drawn() {
    const from = await this.page.evaluate(() => window.stiction.framesDrawn);
    await this.until((count) => window.stiction.framesDrawn >= count + 2, from);
  }

  /** Waits until the window on the scene is at rest: it follows the object smoothly. */
  async steady() {
    await this.until(() => {
      const page = /** @type {any} */ (window);
      const { x, y } = window.stiction.pixelOf(0, 0);
      if (page.steadying?.x !== x || page.steadying.y !== y) page.steadying = { x, y, since: performance.now() };
      return performance.now() - page.steadying.since > 100;
    });
  }

  /** Pauses; the newest frame is then the last one. */
  async pause() {
    await this.page.click("#pause");
    await this.until(() => window.stiction.state?.paused);
    await this.settled();
  }

  /** Starts another scene from its beginning. @param {string} name */
  async scene(name) {
    await this.page.click(`.card:has(input[value="${name}"])`);
    await this.until((title) => window.stiction.state?.scene.title === title && window.stiction.frame, name);
    await this.fresh();
  }

  /** Returns the position of a point of the world (CSS px). @param {number} x @param {number} y */
  pixel(x, y) {
    return this.page.evaluate(([wx, wy]) => window.stiction.pixelOf(wx, wy), [x, y]);
  }

  /**
   * Presses on the object at a point of the world, or where the hand is, until it is held there.
   * @param {Vec} [point]
   */
  async grab(point) {
    await this.steady();
    const [x, y] = point ?? (await this.frame()).frame.hand;
    this.pointer = await this.pixel(x, y);
    await this.page.mouse.move(this.pointer.x, this.pointer.y);
    await this.page.mouse.down();
    await this.until(
      ([wx, wy, near]) => {
        const { holding, frame } = window.stiction.frame ?? {};
        return (
          window.stiction.state?.hand.by === "page" &&
          holding &&
          frame &&
          Math.hypot(frame.hand[0] - wx, frame.hand[1] - wy) < near
        );
      },
      [x, y, 2 * (await this.metresPerPixel())],
    );
  }

  /** Drags the hand to a point of the world, within the resolution of pixels. @param {number} x @param {number} y */
  async handTo(x, y) {
    const near = 1.5 * (await this.metresPerPixel());
    for (let attempt = 0; attempt < 20; attempt++) {
      await this.fresh();
      const [hx, hy] = (await this.frame()).frame.hand;
      if (Math.hypot(hx - x, hy - y) <= near) return;
      // The window follows the object: only the displacement counts, not the position.
      const [from, to] = [await this.pixel(hx, hy), await this.pixel(x, y)];
      await this.drag(to.x - from.x, to.y - from.y);
    }
    assert.fail(`the hand does not come to ${x}, ${y}`);
  }

  /** Moves the pressed mouse. @param {number} dx px @param {number} dy px */
  async drag(dx, dy) {
    assert.ok(this.pointer);
    this.pointer = { x: this.pointer.x + dx, y: this.pointer.y + dy };
    const steps = Math.ceil(Math.max(1, Math.hypot(dx, dy) / 2));
    await this.page.mouse.move(this.pointer.x, this.pointer.y, { steps });
  }

  /** Returns the size of a pixel in the world (m). */
  async metresPerPixel() {
    return this.page.evaluate(() => 1 / Math.abs(window.stiction.pixelOf(1, 0).x - window.stiction.pixelOf(0, 0).x));
  }

  /**
   * Returns the number of pixels of the scene with the colour of a role.
   * @param {string} role as in style.css
   */
  painted(role) {
    return this.page.evaluate((name) => {
      const stage = /** @type {HTMLCanvasElement} */ (document.querySelector("#stage"));
      const copy = /** @type {OffscreenCanvasRenderingContext2D} */ (
        new OffscreenCanvas(stage.width, stage.height).getContext("2d", { willReadFrequently: true })
      );
      copy.drawImage(stage, 0, 0);
      const { data } = copy.getImageData(0, 0, stage.width, stage.height);
      const probe = document.body.appendChild(document.createElement("i"));
      probe.style.color = `var(--${name})`;
      const [r, g, b] = getComputedStyle(probe).color.match(/\d+/g)?.map(Number) ?? [];
      probe.remove();
      let count = 0;
      for (let i = 0; i < data.length; i += 4) {
        if (Math.abs(data[i] - r) + Math.abs(data[i + 1] - g) + Math.abs(data[i + 2] - b) < 9) count++;
      }
      return count;
    }, role);
  }

  /** Downloads a file of the recording by its link. @param {string} name */
  async download(name) {
    const coming = this.page.waitForEvent("download");
    await this.page.click(`[id="get-${name}"]`);
    const download = await coming;
    assert.equal(download.suggestedFilename(), name);
    return readFileSync(await download.path(), "utf8");
  }
}

/** Opens the gallery and the details, as in a browser that remembers them. @param {import("playwright-core").Page} page */
export const openParts = (page) =>
  page.addInitScript(() => {
    for (const name of ["details", "scenes"]) localStorage.setItem(`stiction-${name}`, "open");
  });

/** The environment of a test. */
export class Bench {
  /** @param {import("playwright-core").Browser} browser @param {Program} program */
  constructor(browser, program) {
    this.browser = browser;
    this.program = program;
    /** @type {Live[]} */
    this.pages = [];
  }

  /**
   * Opens a page of the program in a window of its own, and waits until it shows something. Its reader prefers reduced motion:
   * no demonstration moves the hand.
   * @param {import("playwright-core").BrowserContextOptions} [options]
   */
  async open(options) {
    return this.openBy(options, async () => {});
  }

  /** Opens a page as somebody sees it who has never seen it before. @param {import("playwright-core").BrowserContextOptions} [options] */
  async openFirst(options) {
    return this.openBy(options, async () => {}, true);
  }

  /**
   * Opens a page after preparing it, before it requests anything.
   * @param {import("playwright-core").BrowserContextOptions | undefined} options
   * @param {(page: import("playwright-core").Page) => Promise<void>} before
   * @param {boolean} isFirst whether this browser has never shown the page: the gallery and the details are closed
   */
  async openBy(options, before, isFirst = false) {
    const context = await this.browser.newContext({ viewport: WINDOW, colorScheme: "light", reducedMotion: "reduce", ...options });
    const live = new Live(await context.newPage(), this.program.origin);
    this.pages.push(live);
    if (!isFirst) await openParts(live.page);
    await before(live.page);
    await live.page.goto(`${this.program.origin}/`);
    await live.until(() => window.stiction?.connected && window.stiction.framesDrawn > 0 && document.querySelector("#chart-steps canvas"));
    return live;
  }

  /** Closes everything, and fails on faults. */
  async close() {
    for (const { page } of this.pages) await page.context().close();
    await this.program.kill();
  }

  /** Fails on faults. */
  check() {
    for (const live of this.pages) live.check();
    assert.equal(this.program.said, "");
  }
}

/** The browser of a file's tests. @type {import("playwright-core").Browser | null} */
let browser = null;

/** Starts the browser before the first test of a file, and closes it after the last one. */
function shareBrowser() {
  if (!browserFile || isShared) return;
  isShared = true;
  before(async () => {
    browser = await startBrowser();
  });
  after(() => browser?.close());
}
let isShared = false;

/** Returns the browser, for tests without a program. */
export function shared() {
  shareBrowser();
  const get = () => {
    assert.ok(browser);
    return browser;
  };
  return { missing: browserFile ? false : "no Chromium: set CHROMIUM, or install it", get };
}

/**
 * Defines a test in the browser, with a program of its own.
 * @param {string} name @param {(bench: Bench) => Promise<void>} work @param {string[]} [args] of `stiction view`
 */
export function liveTest(name, work, args = ["box-flat"]) {
  shareBrowser();
  test(name, { skip: missing }, async () => {
    assert.ok(browser);
    const bench = new Bench(browser, await Program.start(args));
    try {
      await work(bench);
      bench.check();
    } finally {
      await bench.close();
    }
  });
}
