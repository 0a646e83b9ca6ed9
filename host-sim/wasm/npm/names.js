// What the package exports, once the wasm is loaded.

export { Solver, sceneNames, scenePath, sceneText, stateNames, statusNames } from "./stiction.js";
