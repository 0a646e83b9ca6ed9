// For Node.js, which reads the wasm from its file.

import { readFile } from "node:fs/promises";
import { once } from "./once.js";

export const init = (wasm) => once(() => wasm ?? readFile(new URL("stiction_bg.wasm", import.meta.url)));
