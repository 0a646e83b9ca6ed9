// For browsers, their workers and bundlers that support `new URL(..., import.meta.url)`, which locates the wasm. Nothing waits
// while this module is imported, so a worker can listen to messages from the beginning.

import { once } from "./once.js";

export const init = (wasm) => once(() => wasm ?? new URL("./stiction_bg.wasm", import.meta.url));
