export { Solver, sceneNames, scenePath, sceneText, stateNames, statusNames } from "./stiction.js";
export type { Answers, Contact, Frame, SolverOptions } from "./stiction.js";
