// For browsers, their workers and bundlers: the wasm is loaded before the importing module runs.

import { init } from "./init.js";

await init();

export * from "./names.js";
