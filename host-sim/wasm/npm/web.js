// For browsers, their workers and bundlers, which know `new URL(..., import.meta.url)`, by which the wasm is found.

import init from "./stiction.js";

await init({ module_or_path: new URL("./stiction_bg.wasm", import.meta.url) });

export { Solver, sceneNames, scenePath, sceneText, stateNames, statusNames } from "./stiction.js";
