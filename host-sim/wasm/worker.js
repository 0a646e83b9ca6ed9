// The worker of a page without a server: it runs the solver in real time. The output of wasm-bindgen precedes this script.
// Timers of a busy browser are some ms late, and sleep for at least 4 ms if they follow one another. Waiting for a value that never
// changes ends on time. Between two waits the worker sends itself a message, so that the page's messages are handled.

/** Messages and files that wait until the solver is loaded. @type {(string | FileRequest)[]} */
let waiting = [];
/** @type {SolverPage | null} */
let page = null;
/** Never changes. Shared memory of WebAssembly exists even if SharedArrayBuffer is hidden. */
const still = new Int32Array(new WebAssembly.Memory({ shared: true, initial: 1, maximum: 1 }).buffer);

self.addEventListener("message", ({ data }) => {
  if (typeof data === "string" || "file" in data) take(data);
  else start(data);
});

/** Starts the solver and its clock. @param {{wasm: string | ArrayBuffer}} files */
async function start({ wasm }) {
  try {
    await wasm_bindgen({ module_or_path: wasm });
    page = new wasm_bindgen.Page();
    self.postMessage([page.hello()]);
    waiting.forEach(take);
    waiting = [];
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => turn(port2);
    port2.postMessage(0);
  } catch (why) {
    stop(why);
  }
}

/** A message of the page, or a file. @param {string | FileRequest} said */
function take(said) {
  if (!page) waiting.push(said);
  else if (typeof said === "string") page.take(said);
  else answer(page, said);
}

/** Answers what is asked of a file. @param {SolverPage} page @param {FileRequest} request */
function answer(page, { file, path, name, body }) {
  try {
    const text = path === "scene.toml" ? page.sceneFile()
      : JSON.stringify({ scene: path === "edit" ? page.putEdit(name, body) : page.putScene(name, body) });
    self.postMessage({ file, text });
  } catch (why) {
    self.postMessage({ file, problem: why instanceof Error ? why.message : String(why) });
  }
}

/** Executes the ticks that are due. @param {MessagePort} port */
function turn(port) {
  try {
    const messages = page?.turn() ?? [];
    if (messages.length > 0) self.postMessage(messages);
    Atomics.wait(still, 0, 0, page?.untilDue() ?? 1);
    port.postMessage(0);
  } catch (why) {
    stop(why);
  }
}

/** @param {unknown} why */
function stop(why) {
  page = null;
  self.postMessage({ problem: String(why) });
}
