// The worker of a page without a server: it runs the solver in real time. The output of wasm-bindgen precedes this script. It starts
// with the solver for scenes without obstacles, a third of the whole, and loads the whole one when a scene needs it.
// Timers of a busy browser are some ms late, and sleep for at least 4 ms if they follow one another. Waiting for a value that never
// changes ends on time. Between two waits the worker sends itself a message, so that the page's messages are handled.

/** Messages and files that wait until a solver is loaded. @type {(string | FileRequest)[]} */
let waiting = [];
/** @type {SolverPage | null} */
let page = null;
/** The whole solver, if this is a part of it. @type {{script: string, wasm: string} | undefined} */
let whole;
/** Never changes. Shared memory of WebAssembly exists even if SharedArrayBuffer is hidden. */
const still = new Int32Array(new WebAssembly.Memory({ shared: true, initial: 1, maximum: 1 }).buffer);

self.addEventListener("message", ({ data }) => {
  if (typeof data === "string" || "file" in data) take(data);
  else start(data);
});

/** Starts the solver and its clock. @param {{wasm: string | ArrayBuffer, whole?: {script: string, wasm: string}}} files */
async function start(files) {
  try {
    whole = files.whole;
    await wasm_bindgen({ module_or_path: files.wasm });
    page = new wasm_bindgen.Page();
    self.postMessage([page.hello()]);
    takeWaiting();
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
  else if (whole && isBeyond(page, said)) grow(whole, page, said).catch(stop);
  else if (typeof said === "string") page.take(said);
  else answer(page, said);
}

/** What only the whole solver can do: obstacles, and scenes of the page's own. @param {SolverPage} part @param {string | FileRequest} said */
function isBeyond(part, said) {
  return typeof said === "string" ? part.isBeyond(said) : said.path !== "scene.toml";
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

function takeWaiting() {
  const all = waiting;
  waiting = [];
  all.forEach(take);
}

/**
 * The whole solver continues where the part of it stopped, with this message or file. Messages that arrive
 * meanwhile wait.
 * @param {{script: string, wasm: string}} files @param {SolverPage} part @param {string | FileRequest} said
 */
async function grow(files, part, said) {
  whole = undefined;
  page = null;
  importScripts(files.script);
  await stiction_whole({ module_or_path: files.wasm });
  page = new stiction_whole.Page();
  for (const message of part.handedOver()) page.take(message);
  page.take(part.handedShown());
  part.free();
  take(said);
  takeWaiting();
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
