// The chart library in web/uplot equals that of its package, byte for byte.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";

const ours = new URL("../../web/uplot/", import.meta.url);
const theirs = new URL("node_modules/uplot/", import.meta.url);
const skip = existsSync(theirs) ? false : "not installed: type npm ci";

for (const [file, origin] of [
  ["uplot.min.js", "dist/uPlot.iife.min.js"],
  ["uplot.min.css", "dist/uPlot.min.css"],
  ["LICENSE", "LICENSE"],
]) {
  test(`${file} is the package's`, { skip }, () => {
    assert.deepEqual(readFileSync(new URL(file, ours)), readFileSync(new URL(origin, theirs)));
  });
}
