// The Pico over USB, in its own emulator: the file of `stiction image` on an RP2040 of rp2040js, which shares nothing with the
// program's emulator. A computer finds the board, opens its line, and its poses have the same bits as the program's.

import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { fileURLToPath } from "node:url";
import { Decoder, encode, STATES } from "../../web/frame.js";
import { missingProgram, newFolder, runProgram } from "./live.js";
import { MS, UsbHost } from "./usb-host.js";

const workspace = fileURLToPath(new URL("../../../", import.meta.url));
/** The scene of the board after power-up. */
const SCENE = join(workspace, "firmware/scenes/board.toml");
/** Its identity on USB. Its serial number is that of the flash, which the emulator's empty ROM does not request. */
const IDENTITY = { vendor: 0x2e8a, product: 0x000a, texts: ["stiction", "stiction on Pico", "0".repeat(16)] };
/** Number of samples of the hand, and sample rate (Hz). */
const SAMPLES = 400;
const RATE = 1000;

/**
 * Returns a hand that presses the box 10 mm into the floor, drags it 50 mm to the right and tips it: x, y [m], phi [rad], as
 * f32.
 * @param {number} i
 */
function hand(i) {
  const part = i / (SAMPLES - 1);
  const down = Math.min(part / 0.25, 1);
  const along = Math.max(part - 0.25, 0) / 0.75;
  return [0.05 * along, 0.055 - 0.015 * down, 0.8 * along].map(Math.fround);
}

/** Returns the file for the drive, or null if something needed to build it is not installed. @param {string} folder */
async function image(folder) {
  const file = join(folder, "pico.uf2");
  try {
    // The sources are found there.
    await runProgram(["image", "pico", "--out", file], workspace);
  } catch (error) {
    if (process.env.CI !== "true" && String(error).includes("missing: ")) return null;
    throw error;
  }
  return new Uint8Array(readFileSync(file));
}

/** Returns the program's results for the same hand. @param {string} folder @param {number} budget of a step */
async function expected(folder, budget) {
  const rows = Array.from({ length: SAMPLES }, (_, i) => [i / RATE, ...hand(i)].join(","));
  writeFileSync(join(folder, "hand.csv"), `t,x,y,phi\n${rows.join("\n")}\n`);
  const how = ["--number", "fixed", "--budget", String(budget), "--quiet"];
  await runProgram(["run", SCENE, "--hand", "hand.csv", ...how, "--out", "trace.jsonl"], folder);
  const records = readFileSync(join(folder, "trace.jsonl"), "utf8").trim().split("\n");
  return records.map((record) => JSON.parse(record)).filter((record) => record.pose);
}

/** A board and the messages on its line. */
class Client {
  /** @param {UsbHost} host */
  constructor(host) {
    this.host = host;
    /** @type {any[]} */
    this.received = [];
    this.decoder = new Decoder((message) => this.received.push(message));
    host.take = (bytes) => this.decoder.push(bytes);
    this.sequence = 0;
  }

  /** @param {any} message */
  send(message) {
    this.host.send(encode({ sequence: this.sequence, time: 0, ...message }));
    this.sequence = (this.sequence + 1) % 256;
  }

  /** Waits for a message of a type. @param {string} type */
  wait(type) {
    this.host.until(() => this.received.some((message) => message.type === type), type);
    return this.received.find((message) => message.type === type);
  }

  /** Sends a command, which must succeed. @param {any} message */
  done(message) {
    this.received = [];
    this.send(message);
    assert.equal(this.wait("reply").reason, 0, message.type);
  }
}

/** Returns what a board reports about itself over its UART. @param {UsbHost} host */
function overUart(host) {
  /** Cycles per byte at 921600 baud. */
  const BYTE = Math.ceil((10 * 125e6) / 921_600);
  const [uart] = host.chip.uart;
  /** @type {any} */
  let info = null;
  const decoder = new Decoder((message) => {
    if (message.type === "info") info = message;
  });
  uart.onByte = (byte) => decoder.push(Uint8Array.of(byte));
  for (const byte of encode({ type: "hello", sequence: 0, time: 0 })) {
    uart.feedByte(byte);
    host.run(BYTE);
  }
  host.until(() => info, "answer over the UART");
  return info;
}

/**
 * Defines a test with a Pico that a computer has just found; `host` is that computer.
 * @param {string} name @param {(host: UsbHost, client: Client, folder: string) => void | Promise<void>} body
 */
function usbTest(name, body) {
  test(name, { skip: missingProgram }, async (context) => {
    const folder = newFolder();
    const file = await image(folder);
    if (!file) return context.skip("what builds the image is not installed");
    const host = new UsbHost(file);
    const client = new Client(host);
    assert.deepEqual(host.enumerate(), IDENTITY);
    await body(host, client, folder);
  });
}

usbTest("a Pico over USB has the bits of the program, however fast the samples come", async (host, client, folder) => {
  host.open(true);
  client.send({ type: "hello" });
  const info = client.wait("info");
  assert.deepEqual([info.name, info.number], ["pico", 1]);
  // At more ticks per second, poses and forces would not fit the line of a UART, against which a mode is checked.
  const [{ axis_x, axis_y }, tick_rate] = [info, 500];
  const every = { events: 1, pose_every: 1, forces_every: 1, health_every: 0 };
  client.done({ type: "mode", evolution: 0, stepping: 1, axis_x, axis_y, tick_rate, ...every });
  client.done({ type: "reset", what: 0 });

  // The budget of a step follows from the tick.
  client.received = [];
  client.send({ type: "hello" });
  const records = await expected(folder, client.wait("info").budget);
  assert.equal(records.length, SAMPLES);
  const states = new Set(records.map(({ state }) => state));
  assert.ok(states.has("edge") && states.has("single-vertex"), [...states].join());
  assert.ok(records.reduce((sum, { slips }) => sum + slips, 0) > 1);

  client.received = [];
  const from = client.sequence;
  // All simultaneously: the board takes them when it can, and the computer waits.
  for (let i = 0; i < SAMPLES; i++) {
    const [x, y, phi] = hand(i);
    client.send({ type: "hand", x, y, phi, turns: 0, depth: 0, held: 1 });
  }
  const received = (/** @type {string} */ type) => client.received.filter((message) => message.type === type);
  host.until(() => received("forces").length >= SAMPLES, `forces of ${SAMPLES} samples`);
  const [poses, forces] = [received("pose"), received("forces")];
  assert.deepEqual([poses.length, forces.length, client.decoder.faults], [SAMPLES, SAMPLES, {}]);
  poses.forEach((pose, i) => {
    const { wrench, pose: [x, y, theta], state } = records[i];
    assert.equal(pose.sample, (from + i) % 256);
    assert.deepEqual([pose.x, pose.y, pose.theta], [x, y, theta].map(Math.fround), `pose ${i}`);
    assert.equal(STATES[pose.state], state);
    const { wrench_x, wrench_y, wrench_m } = forces[i];
    assert.deepEqual([wrench_x, wrench_y, wrench_m], wrench.map(Math.fround), `wrench ${i}`);
  });
});

usbTest("the line is USB while a program has it open there, else the UART", (host, client) => {
  /** Checks that nothing comes over USB. @param {string} why */
  const silent = (why) => {
    // Messages already in transit.
    host.run(10 * MS);
    client.received = [];
    host.run(50 * MS);
    assert.deepEqual(client.received, [], why);
  };
  silent("nobody has opened the line");
  assert.equal(overUart(host).name, "pico");

  host.open(true);
  client.wait("pose");
  host.open(false);
  silent("it is closed");
  assert.equal(overUart(host).name, "pico");

  // The plug is pulled while the line is open.
  host.open(true);
  client.wait("pose");
  host.fallSilent();
  assert.equal(overUart(host).name, "pico");

  // Plugged in again, it waits until a program opens it.
  assert.deepEqual(host.plugAgain(), IDENTITY);
  silent("nobody has opened the line again");
  host.open(true);
  client.wait("pose");
});
