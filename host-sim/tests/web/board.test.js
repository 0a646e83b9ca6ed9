// A board over Web Serial, without a program in between: a serial port of the browser behind which a board answers as specified
// in core/wire/FRAME.md. The box slides on the floor without friction.

import assert from "node:assert/strict";
import { test } from "node:test";
import { Board } from "../../web/board.js";
import { Decoder } from "../../web/frame.js";
import { liveTest } from "./live.js";

/** Largest translational stiffness that the board accepts (N/m). */
const STIFFEST = 9000;
/** Height of the hand above the lower edge of the box (m), half the box's height, and its spring (N/m). */
const GRASP = 0.05;
const HALF = 0.03;
const STIFFNESS = 500;

/** Adds the port to a page that is about to be opened. @param {import("playwright-core").Page} page */
function plugIn(page) {
  return page.addInitScript(
    ([stiffest, grasp, half, stiffness]) => {
      const port = Object.assign(new EventTarget(), {
        open: async () => {},
        close: async () => clearInterval(port.timer),
        timer: 0,
        /** @type {ReadableStream | null} */ readable: null,
        /** @type {WritableStream | null} */ writable: null,
      });
      /** All commands that the board received. @type {any[]} */
      const commands = [];
      Object.assign(window, { commands });

      const requestPort = async () => {
        const { Decoder, encode } = await import(/** @type {any} */ ("/frame.js"));
        /** @type {ReadableStreamDefaultController} */
        let out;
        let sequence = 0;
        let hand = { x: 0, y: grasp + half, phi: 0, held: 1, sequence: 0 };
        port.readable = new ReadableStream({ start: (controller) => void (out = controller) });
        const say = (/** @type {object} */ message) => {
          sequence = (sequence + 1) % 256;
          out.enqueue(encode({ sequence, time: Math.round(performance.now() * 1000) % 2 ** 32, ...message }));
        };
        const decoder = new Decoder((/** @type {any} */ message) => {
          if (message.type === "hand") {
            hand = message;
            return;
          }
          commands.push(message);
          if (message.type === "hello") {
            say({
              type: "info",
              major: 1,
              minor: 2,
              patch: 3,
              number: 0,
              vertices: 16,
              surfaces: 8,
              corners: 0,
              actuators: 0,
              longest_frame: 378,
              fastest_tick: 5000,
              budget: 4294967295,
              stiffest_k_h: stiffest,
              stiffest_k_theta: Infinity,
              k_h: stiffness,
              k_theta: 0.5,
              mu_s: 0.5,
              mu_d: 0.3,
              has_memory: 0,
              memory: 0,
              evolution: 0,
              stepping: 0,
              axis_x: 0,
              axis_y: 1,
              events: 1,
              tick_rate: 1000,
              pose_every: 1,
              forces_every: 0,
              health_every: 1000,
              name: "the-board",
            });
            return;
          }
          const refused = message.type === "parameters" && message.k_h > stiffest;
          const command = { parameters: 3, scene: 4, mode: 5, reset: 8 }[/** @type {string} */ (message.type)];
          say({
            type: "reply",
            command,
            command_sequence: message.sequence,
            reason: refused ? 5 : 0,
            subject: 0,
            index: 0,
            index2: 0,
            value: 0,
            limit: NaN,
            allowed: refused ? `${stiffest} or less` : "",
          });
        });
        port.writable = new WritableStream({ write: (bytes) => decoder.push(bytes) });
        let count = 0;
        port.timer = window.setInterval(() => {
          const y = Math.max(half, hand.y - grasp + half);
          const normal = stiffness * (y - hand.y + grasp - half);
          const { x, phi } = hand;
          say({
            type: "pose",
            state: normal > 0 ? 2 : 0,
            x,
            y,
            theta: phi,
            depth: 0,
            status: 0,
            held: hand.held,
            force_off: 0,
            turns: 0,
            events: 0,
            sample: hand.sequence,
          });
          const contact =
            normal > 0
              ? [
                  [0, 255, 0, 0, 1, x - 0.05, 0, normal / 2, 0, 0],
                  [1, 255, 0, 0, 1, x + 0.05, 0, normal / 2, 0, 0],
                ]
              : [];
          say({
            type: "forces",
            wrench_x: 0,
            wrench_y: -normal,
            wrench_m: 0,
            hand_x: 0,
            hand_y: 0,
            hand_m: 0,
            turns: 0,
            contact,
          });
          if (count++ % 60 === 0) {
            say({
              type: "health",
              drive: 0,
              ticks: 8 * count,
              missed_ticks: 0,
              samples: count,
              late_samples: 0,
              lost_frames: 0,
              unsent: 0,
              worst_step: 24500,
              worst_tick: 41000,
              too_long: 0,
              cobs: 0,
              crc: 0,
              version: 0,
              unknown_type: 0,
              length: 0,
              value: 0,
            });
          }
        }, 8);
        return port;
      };
      Object.defineProperty(navigator, "serial", { value: { requestPort }, configurable: true });
    },
    [STIFFEST, GRASP, HALF, STIFFNESS],
  );
}

liveTest("a board by Web Serial gets the scene and the hand, and its poses are shown", async (bench) => {
  const live = await bench.open();
  const { page } = live;
  await plugIn(page);
  await page.reload();
  await live.until(() => window.stiction?.connected && window.stiction.framesDrawn > 0);
  await page.click("#serial");
  await live.reads("#source", /^board the-board, f32, Web Serial, 921600 baud$/);
  await live.reads("#serial", /^Leave the board$/);
  await live.reads("#program", /^firmware 1\.2\.3$/);
  const commands = () => page.evaluate(() => /** @type {any} */ (window).commands);
  assert.deepEqual(
    (await commands()).map(({ type }) => type),
    ["hello", "scene", "mode"],
  );
  const [, scene] = await commands();
  const { body } = (await live.state()).scene;
  assert.deepEqual(
    scene.vertex.map((vertex) => vertex.map(Math.fround)),
    body.map((vertex) => vertex.map(Math.fround)),
  );
  for (const id of ["pause", "step", "speed", "record", "replay", "upload", "scene-box-flat", "number", "slide-weight", "type-weight"]) {
    assert.ok(await page.locator(`#${id}`).isDisabled(), id);
  }

  // The hand goes down by keys, and the board's box onto the floor.
  await page.focus("#stage");
  await page.keyboard.down("ArrowDown");
  await live.until(
    () => (window.stiction.frame?.frame.contacts ?? []).reduce((sum, { normal }) => sum + normal, 0) > 2,
  );
  await page.keyboard.up("ArrowDown");
  await live.reads("#state-name", /^edge$/);
  const { frame } = await live.frame();
  assert.equal(frame.contacts.length, 2);
  assert.equal(frame.contacts[0].surface, (await live.state()).scene.surfaces[0].name);
  assert.ok(Math.abs(frame.pose[1] - HALF) < 1e-6);
  await live.reads("#now-n", /^N [1-9]/);
  await live.reads("#board-link", /^connected, \d+ poses\/s$/);
  await live.until(() => window.stiction.latencies.length > 5);

  // A refusal is shown in the board's words; an accepted value is applied.
  await page.fill("#type-stiffness_translation", String(STIFFEST + 500));
  await page.keyboard.press("Enter");
  await live.reads("#note", new RegExp(`allowed: ${STIFFEST} or less`));
  await live.until(
    (value) =>
      Number(/** @type {HTMLInputElement} */ (document.querySelector("#type-stiffness_translation")).value) === value,
    STIFFNESS,
  );
  await page.fill("#type-stiffness_translation", "600");
  await page.keyboard.press("Enter");
  await live.until(() => window.stiction.state?.parameters.stiffness_translation === 600);
  assert.equal((await commands()).at(-1).k_h, 600);

  // Back to the program, whose hand and body have not moved meanwhile.
  await page.click("#serial");
  await live.reads("#source", /^this computer/);
  await live.reads("#serial", /^Board by Web Serial$/);
  await live.until(() => window.stiction.frame?.frame.state === "non-contact");
  assert.ok(await page.locator("#pause").isEnabled());
});

/** Returns a board without a page, the messages sent to it, and a function to answer them. @param {any} [state] */
function wired(state = null) {
  const board = new Board({ hello() {}, state() {}, frame() {}, connected() {}, error() {} }, state);
  /** @type {any[]} */
  const sent = [];
  const decoder = new Decoder((message) => sent.push(message));
  board.writer = /** @type {any} */ ({ write: async (bytes) => decoder.push(bytes) });
  const answer = (message, reason = 0) =>
    board.take({
      type: "reply", sequence: 0, time: 0, command_sequence: message.sequence, reason, allowed: "",
    });
  /** Waits until this many messages have been sent to the board. */
  const untilSent = async (count) => {
    while (sent.length < count) await new Promise((done) => setTimeout(done, 5));
  };
  return { board, sent, answer, untilSent };
}

test("an answer counts for its own command alone, and commands go one after another", async () => {
  const { board, sent, answer, untilSent } = wired();
  const first = board.request({ type: "set", parameters: { stiffness_translation: 600 } });
  const second = board.request({ type: "set", parameters: { stiffness_rotation: 0.7 } });
  const third = board.request({ type: "reset" });
  // The first answer is late: the command is repeated, and both are answered.
  await untilSent(2);
  assert.deepEqual(sent.map(({ type, k_h }) => [type, k_h]), Array(2).fill(["parameters", 600]));
  answer(sent[0]);
  await first;
  await untilSent(3);
  assert.deepEqual([sent[2].k_h, Math.fround(0.7)], [600, sent[2].k_theta]);
  answer(sent[1]);
  answer(sent[2], 5);
  await assert.rejects(second, /refuses the parameters/);
  await untilSent(4);
  assert.equal(sent[3].type, "reset");
  answer(sent[1]);
  answer(sent[2], 5);
  answer(sent[3]);
  await third;
  const { parameters } = board.model;
  assert.deepEqual([parameters.stiffness_translation, parameters.stiffness_rotation], [600, 0.5]);
});

test("frictions of surfaces are set together, and are those of the scene then", async () => {
  const surface = (name, friction) => ({
    name, normal: [0, 1], offset: 0, static: friction, dynamic: friction / 2, memory: null,
  });
  const parameters = { stiffness_translation: 500, stiffness_rotation: 0.5, static: 0.5, dynamic: 0.25, memory: null };
  const scene = { body: [[0, 0]], surfaces: [surface("floor", 0.5), surface("wall", 0.25)], home: [0, 0, 0] };
  const { board, sent, answer, untilSent } = wired({ scene, parameters });
  for (const change of [{ stiffness_translation: 600 }, { static: 0.6 }, { dynamic: 0.1 }]) {
    await assert.rejects(board.request({ type: "set", parameters: change }), /frictions of their own; allowed/);
  }
  assert.equal(sent.length, 0);
  const done = board.request({ type: "set", parameters: { static: 0.75, dynamic: 0.5 } });
  await untilSent(1);
  assert.deepEqual([sent[0].mu_s, sent[0].mu_d], [0.75, 0.5]);
  answer(sent[0]);
  await done;
  const state = board.model.state();
  assert.deepEqual([state.parameters.static, state.parameters.dynamic], [0.75, 0.5]);
  for (const { static: mu_s, dynamic: mu_d } of state.scene.surfaces) assert.deepEqual([mu_s, mu_d], [0.75, 0.5]);
  // Now that they are equal, one of them can be set alone.
  const next = board.request({ type: "set", parameters: { dynamic: 0.25 } });
  await untilSent(2);
  assert.deepEqual([sent[1].mu_s, sent[1].mu_d], [0.75, 0.25]);
  answer(sent[1]);
  await next;
  for (const memory of [0.5, null]) {
    const before = sent.length;
    const done = board.request({ type: "set", parameters: { memory } });
    await untilSent(before + 1);
    const last = sent[before];
    assert.deepEqual([last.has_memory, last.memory, last.mu_d], [memory === null ? 0 : 1, memory ?? 0, 0.25]);
    answer(last);
    await done;
    assert.deepEqual(board.model.state().scene.surfaces.map((surface) => surface.memory), [memory, memory]);
  }
});

test("a scene tells the memory length of every surface, or that it has none", () => {
  const surface = (memory) => ({ name: "wall", normal: [0, 1], offset: 0, static: 0.5, dynamic: 0.25, memory });
  const scene = { body: [[0, 0]], surfaces: [surface(0.25), surface(null)], start: [0, 0, 0], home: [0, 0, 0] };
  const parameters = { stiffness_translation: 500, stiffness_rotation: 0.5, static: 0.5, dynamic: 0.25, memory: 0.25 };
  const { board } = wired({ scene, parameters });
  assert.deepEqual(board.model.sceneMessage().surface.map((one) => one.slice(5)), [[1, 0.25], [0, 0]]);
});
