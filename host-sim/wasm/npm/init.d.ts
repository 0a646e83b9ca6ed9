/**
 * Loads the wasm, once, and returns what `stiction` exports. After a failure, the next call tries again.
 *
 * `wasm`: its place, its response to a request, its bytes, or the compiled module; by default the file of the package.
 */
export function init(
  wasm?: string | URL | Request | Response | Promise<Response> | BufferSource | WebAssembly.Module,
): Promise<typeof import("./index.js")>;
