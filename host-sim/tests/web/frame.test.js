// The page's decoder and encoder of the wire format against every example of core/wire/FRAME.md.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { crc32, decode, Decoder, encode, Fault, statusName, stuff, unstuff } from "../../web/frame.js";

const document = readFileSync(new URL("../../../core/wire/FRAME.md", import.meta.url), "utf8");
const examples = [...document.split("## 10. Examples")[1].matchAll(/```text\n([\s\S]*?)```/g)].map(([, text]) => read(text));

/** Returns an example: its bytes, and the message that they encode. */
function read(text) {
  const lines = text.trim().split("\n");
  const first = lines.findIndex((line) => line.includes("="));
  const bytes = Uint8Array.from(lines.slice(0, first).join(" ").split(" "), (hex) => parseInt(hex, 16));
  const fields = lines
    .slice(first)
    .map((line) => line.split(" = "))
    .map(([name, value]) => [
      name,
      value.startsWith('"') ? JSON.parse(value) : value.includes(",") ? value.split(", ").map(Number) : number(value),
    ]);
  const message = collect(fields);
  return { bytes, message };
}

/** Makes a message from its fields: contact_0, contact_1, ... become a list. */
function collect(fields) {
  const message = {};
  for (const [name, value] of fields) {
    const [, item, index] = name.match(/^(vertex|surface|obstacle|corner|contact|event)_(\d+)$/) ?? [];
    if (item) (message[item] ??= [])[index] = value;
    else message[name] = value;
  }
  // A list without items has no lines.
  if (message.type === "scene") for (const item of ["surface", "obstacle", "corner"]) message[item] ??= [];
  return message;
}

/** Converts a number that may be a text; leaves other values. */
function number(value) {
  return (
    { nan: NaN, inf: Infinity, "-inf": -Infinity }[value] ??
    (value === "" || Number.isNaN(Number(value)) ? value : Number(value))
  );
}

/** Rounds every number that is not whole to the nearest f32, as on the wire. */
function single(value) {
  if (Array.isArray(value)) return value.map(single);
  if (typeof value === "number") return Number.isInteger(value) ? value : Math.fround(value);
  if (typeof value !== "object") return value;
  return Object.fromEntries(Object.entries(value).map(([name, one]) => [name, single(one)]));
}

test("there is an example of every type", () => {
  assert.equal(new Set(examples.map(({ message }) => message.type)).size, 18);
});

for (const { bytes, message } of examples) {
  test(`${message.type}, sequence ${message.sequence}`, () => {
    assert.deepEqual(single(decode(bytes.subarray(0, -1))), single(message));
    assert.deepEqual([...encode(message)], [...bytes]);
  });
}

test("a stream in pieces, with noise before it, is every message of it", () => {
  const stream = [[0x55, 0x12, 0x00], ...examples.map(({ bytes }) => [...bytes])].flat();
  for (const size of [1, 2, 7, 64, stream.length]) {
    const types = [];
    const decoder = new Decoder((message) => types.push(message.type));
    for (let at = 0; at < stream.length; at += size) decoder.push(Uint8Array.from(stream.slice(at, at + size)));
    assert.deepEqual(
      types,
      examples.map(({ message }) => message.type),
    );
    assert.deepEqual(decoder.faults, { cobs: 1 });
  }
});

test("a status that is not known may be out of balance", () => {
  assert.deepEqual([0, 5, 6, 7, 8, 9, 15].map(statusName), ["ok", "held-last", "jammed", "twist", "behind", "ambiguous", "ambiguous"]);
});

test("the checksum of 123456789", () => {
  assert.equal(crc32(new TextEncoder().encode("123456789")), 0xcbf43926);
});

test("COBS and back, of every length around its blocks", () => {
  for (const length of [0, 1, 2, 253, 254, 255, 256, 507, 508, 509, 600]) {
    for (const zero of [0, 1, 17, 254, 300, 1e9]) {
      const bytes = Uint8Array.from({ length }, (_, i) => ((i + 1) % zero === 0 ? 0 : (i % 255) + 1));
      const stuffed = stuff(bytes);
      assert.equal(stuffed.indexOf(0), stuffed.length - 1);
      assert.deepEqual([...unstuff(stuffed.subarray(0, -1))], [...bytes]);
    }
  }
});

test("a flipped bit is never a message", () => {
  for (const { bytes } of examples) {
    for (let bit = 0; bit < 8 * (bytes.length - 1); bit++) {
      const bad = Uint8Array.from(bytes.subarray(0, -1));
      bad[bit >> 3] ^= 1 << (bit & 7);
      assert.throws(() => decode(bad), Fault);
    }
  }
});

test("faults are reported in their order", () => {
  const why = (body) => {
    const frame = new Uint8Array(body.length + 4);
    frame.set(body);
    new DataView(frame.buffer).setUint32(body.length, crc32(frame.subarray(0, -4)), true);
    try {
      decode(stuff(frame).subarray(0, -1));
    } catch (fault) {
      return fault.why;
    }
    return "none";
  };
  const head = (type) => [4, type, 0, 0, 0, 0, 0];
  assert.equal(why([1, ...head(0x06).slice(1)]), "version");
  assert.equal(why(head(0x33)), "unknown-type");
  assert.equal(why([...head(0x06), 1]), "length");
  assert.equal(why([...head(0x08), 2]), "value");
  assert.equal(why(head(0x06)), "none");
  const forces = (sliding) => [...head(0x90), ...Array(28).fill(0), 1, ...Array(27).fill(0), sliding];
  assert.deepEqual([0, 1, 255, 2, 254].map((sliding) => why(forces(sliding))), ["none", "none", "none", "value", "value"]);
  const scene = (flag) => [...head(0x04), 0, 1, ...Array(59).fill(0), flag, 0, 0, 0, 0];
  assert.deepEqual([0, 1, 2].map((flag) => why(scene(flag))), ["none", "none", "value"]);
  const pose = (flags, events) => [...head(0x81), ...Array(16).fill(0), flags, 0, events, 0];
  assert.deepEqual([why(pose(0x3f, 0xe7)), why(pose(0x40, 0)), why(pose(0, 0x08))], ["none", "value", "value"]);
  assert.throws(() => decode(Uint8Array.of(9, 1)), { why: "cobs" });
  assert.throws(() => decode(new Uint8Array(2000).fill(1)), { why: "too-long" });
});
