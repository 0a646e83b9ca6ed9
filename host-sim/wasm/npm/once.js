// Loads the wasm, once for all who ask.

import load from "./stiction.js";
import * as names from "./names.js";

let loaded;

/** Returns the package's exports. `wasm` returns what wasm-bindgen compiles. After a failure, the next call tries again. */
export function once(wasm) {
  loaded ??= load({ module_or_path: wasm() }).then(
    () => names,
    (why) => {
      loaded = undefined;
      throw why;
    },
  );
  return loaded;
}
