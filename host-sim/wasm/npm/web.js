// For browsers, their workers and bundlers, which know `new URL(..., import.meta.url)`, by which the wasm is found.

import init from "./stiction.js";

await init();

export { Solver, sceneNames, scenePath, sceneText, stateNames, statusNames } from "./stiction.js";
