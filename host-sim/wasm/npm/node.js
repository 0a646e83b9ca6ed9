// For Node.js, which reads the wasm from its file.

import { readFileSync } from "node:fs";
import { initSync } from "./stiction.js";

initSync({ module: readFileSync(new URL("stiction_bg.wasm", import.meta.url)) });

export * from "./names.js";
