// The worker of a page without a server: the solver in real time. What wasm-bindgen made stands before this.
// A browser wakes a worker that sleeps 4 ms later at the earliest, unless it was woken by something else than a timer before:
// so a message stands between two timers, which then wait for 1 ms.

/* global wasm_bindgen */

/** Messages that came before the solver was there. @type {string[]} */
const early = [];
/** @type {import("./types").Page | null} */
let page = null;

self.addEventListener("message", ({ data }) => {
  if (typeof data !== "string") start(data.wasm);
  else if (page) page.take(data);
  else early.push(data);
});

/** Starts the solver, and its time. @param {string | ArrayBuffer} wasm */
async function start(wasm) {
  try {
    await wasm_bindgen({ module_or_path: wasm });
    const solver = new wasm_bindgen.Page();
    page = solver;
    self.postMessage([solver.hello()]);
    early.forEach((text) => solver.take(text));
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = () => setTimeout(() => turn(solver, port2), 1);
    port2.postMessage(0);
  } catch (why) {
    stop(why);
  }
}

/** Makes the ticks that are due. @param {import("./types").Page} solver @param {MessagePort} port */
function turn(solver, port) {
  try {
    const messages = solver.turn();
    if (messages.length > 0) self.postMessage(messages);
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
