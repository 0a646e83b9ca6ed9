// The libraries in web/ equal those of their packages, byte for byte.

import assert from "node:assert/strict";
import { existsSync, readFileSync } from "node:fs";
import { test } from "node:test";

const ours = new URL("../../web/", import.meta.url);
const theirs = new URL("node_modules/", import.meta.url);

for (const [file, origin] of [
  ["uplot/uplot.min.js", "uplot/dist/uPlot.iife.min.js"],
  ["uplot/uplot.min.css", "uplot/dist/uPlot.min.css"],
  ["uplot/LICENSE", "uplot/LICENSE"],
  ["gifenc/gifenc.js", "gifenc/dist/gifenc.esm.js"],
  ["gifenc/LICENSE", "gifenc/LICENSE.md"],
]) {
  const package_ = new URL(origin, theirs);
  test(`${file} is the package's`, { skip: existsSync(package_) ? false : "not installed: type npm ci" }, () => {
    assert.deepEqual(readFileSync(new URL(file, ours)), readFileSync(package_));
  });
}
