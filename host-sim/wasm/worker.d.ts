// Declarations of what wasm-bindgen defines before worker.js, for the type checker.

/** As in `src/page.rs`. */
interface SolverPage {
  hello(): string;
  take(text: string): void;
  turn(): string[];
  untilDue(): number;
  putScene(name: string, text: string): string;
  putEdit(name: string, json: string): string;
  sceneFile(): string;
}

/** A script of wasm-bindgen. */
interface Bound {
  (from: { module_or_path: string | ArrayBuffer }): Promise<unknown>;
  Page: new () => SolverPage;
}

declare const wasm_bindgen: Bound;

/** What the page asks of a file: as VIEW.md has the paths of a server. */
type FileRequest = { file: number; path: string; name: string; body: string };
