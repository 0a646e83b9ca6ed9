// What the package exports, once the wasm is loaded.

import { Solver } from "./stiction.js";

export { Solver, sceneNames, scenePath, sceneText, stateNames, statusNames } from "./stiction.js";

const { free } = Solver.prototype;

/** Frees the solver; after that, every use of it says so: the code of wasm-bindgen alone would speak of a null pointer. */
Solver.prototype.free = function () {
  free.call(this);
  Object.defineProperty(this, "__wbg_ptr", {
    get() {
      throw new Error("this solver was freed by `free()`, allowed: a new one, `new Solver(scene)`");
    },
  });
};
