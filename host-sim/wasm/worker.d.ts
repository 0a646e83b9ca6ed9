// Declarations of what wasm-bindgen defines before worker.js, for the type checker.

/** As in `src/page.rs`. */
interface SolverPage {
  hello(): string;
  take(text: string): void;
  turn(): string[];
  untilDue(): number;
  isBeyond(text: string): boolean;
  handedOver(): string[];
  free(): void;
}

/** A script of wasm-bindgen. */
interface Bound {
  (from: { module_or_path: string | ArrayBuffer }): Promise<unknown>;
  Page: new () => SolverPage;
}

declare const wasm_bindgen: Bound;
declare const stiction_whole: Bound;
