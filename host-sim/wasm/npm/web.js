// For browsers, their workers and bundlers that support `new URL(..., import.meta.url)`, which locates the wasm.

import init from "./stiction.js";

await init({ module_or_path: new URL("./stiction_bg.wasm", import.meta.url) });

export { Solver, sceneNames, scenePath, sceneText, stateNames, statusNames } from "./stiction.js";
