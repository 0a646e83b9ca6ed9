// The page: connects views and controls to one feed, which is the server, a board on Web Serial, or, if no server runs the
// solver, the page itself.

import { Controls } from "./controls.js";
import { Demonstration } from "./demonstration.js";
import { Diagram } from "./diagram.js";
import { byId, setText } from "./dom.js";
import { Grip } from "./grip.js";
import { Keys } from "./keys.js";
import { Link } from "./link.js";
import { startPanels } from "./panels.js";
import { Pointers } from "./pointer.js";
import { Readout } from "./readout.js";
import { asItCame, withoutNoise } from "./sizes.js";
import { Stage } from "./stage.js";
import { startTheme } from "./theme.js";
import { startTips } from "./tips.js";
import { Transport } from "./transport.js";

/** Duration of a note (ms). */
const NOTE = 6000;
/** Zoom factor of a key or button. */
const ZOOM = 1.3;

startTheme();
startTips();
startPanels();
const stage = new Stage(byId("stage", HTMLCanvasElement));
const diagram = new Diagram(byId("diagram"));
/** The strip charts, from the first drawing on. @type {import("./charts.js").Charts | null} */
let charts = null;
const readout = new Readout(stage);
/** The board on Web Serial, instead of the server. @type {import("./board.js").Board | null} */
let board = null;
/**
 * The last messages of the server, for when the board disconnects.
 * @type {{hello: HelloMessage | null, state: StateMessage | null}}
 */
const server = { hello: null, state: null };
/** The panel of a peg in its hole. @type {typeof import("./insertion.js").panel | null} */
let insertion = null;
/** Sound and vibration, while they are on. @type {import("./felt.js").Felt | null} */
let felt = null;
/** Points to the object outside the window, once it has been there. @type {Promise<import("./away.js").Away> | null} */
let away = null;
let connected = false;
let framesReceived = 0;

/** No server runs the solver. */
const isAlone = document.body.dataset.alone !== undefined;
/** The address, if it describes what the page shows. @type {import("./address.js").Address | null} */
let address = null;

/** @type {() => Feed} */
const feed = () => board ?? source;
/** Returns true if this browser can use a serial port. */
const canSerial = () => navigator.serial !== undefined;
const grip = new Grip(feed, note, handRefusal, () => { byId("hint").hidden = true; });
const controls = new Controls(feed, note, () => demonstration.play());
const demonstration = new Demonstration((message) => feed().request(message), () => !address?.busy, note);
const transport = new Transport((message) => controls.ask(message), note);

/**
 * Returns the handlers of incoming messages; those of the server apply only while no board is connected.
 * @param {boolean} serial @returns {FeedEvents}
 */
function eventsFor(serial) {
  const current = () => serial === (board !== null);
  return {
    hello(message) {
      if (!serial) server.hello = message;
      if (!current()) return;
      readout.setHello(message);
      controls.setHello(message);
      demonstration.hello = message;
    },
    state(message) {
      if (!serial) server.state = message;
      if (current()) showState(message);
    },
    frame(message) {
      if (current()) showFrame(message);
    },
    connected(yes) {
      if (serial) {
        if (!yes) leaveBoard();
      } else {
        connected = yes;
      }
      readout.setConnected(connected || board !== null, board !== null);
      if (!yes) charts?.clear();
    },
    error: note,
  };
}

/** @param {StateMessage} message */
function showState(message) {
  stage.setState(message);
  charts?.setState(message);
  controls.show(message);
  transport.show(message);
  readout.setState(message);
  const { client } = message.hand;
  byId("let-go", HTMLButtonElement).disabled = board !== null || client === null || client !== server.hello?.you;
  address?.setState(message);
  byId("scene-problem").hidden = !message.scene_problem;
  setText(byId("scene-problem"), message.scene_problem ?? "");
  showPeg(message.scene);
  if (message.replay) byId("hint").hidden = true;
  demonstration.setState(message);
}

/** @param {Scene} scene */
async function showPeg(scene) {
  if (scene.peg) insertion = (await import("./insertion.js")).panel;
  insertion?.setScene(stage.state?.scene ?? scene);
}

/** @param {FrameMessage} received */
function showFrame(received) {
  const message = withoutNoise(received, stage.state);
  framesReceived++;
  insertion?.take(message);
  charts?.take(message);
  transport.count();
  stage.setFrame(message);
  if (stage.state) felt?.take(message, stage.state.scene);
  grip.take(message);
  demonstration.take(message);
}

/** Returns why the hand is not available, or null. */
function handRefusal() {
  if (board) return null;
  const { hello, state } = server;
  if (state?.replay?.demonstration) return null;
  if (state?.replay) return "The hand follows a path. Choose “live” to move it yourself.";
  const other = state?.hand.by != null && state.hand.client !== hello?.you;
  if (!other) return null;
  const { by, client } = state.hand;
  return client === null ? `The hand comes by ${by}.` : `Page ${client} holds the hand.`;
}

/** Shows a note for a while; an empty one hides the last one. @param {string} text */
function note(text) {
  const element = byId("note");
  setText(element, text);
  element.hidden = text === "";
  clearTimeout(noteTimer);
  noteTimer = window.setTimeout(() => { element.hidden = true; }, NOTE);
}
let noteTimer = 0;

/** Loads the charts, which the first drawing does not need, and marks that this has been made. */
async function loadCharts() {
  performance.mark("first-drawing");
  const { startCharts } = await import("./charts.js");
  charts = await startCharts();
  if (stage.state) charts.setState(stage.state);
  stage.ask();
}
/** @type {Promise<void> | null} */
let loadingCharts = null;

stage.also.push(() => {
  const { message, state } = stage;
  if (!message || !state) return;
  loadingCharts ??= loadCharts();
  if (!stage.view.shows(state.scene.body, message.frame.pose)) {
    away ??= import("./away.js").then(({ Away }) => new Away(stage));
  }
  diagram.show(message);
  transport.take(message);
  const words = readout.update(), lines = charts?.draw() ?? false, peg = insertion?.draw() ?? false;
  if (words || lines || peg) stage.ask();
});

/** Connects to a board or disconnects it. */
async function toggleBoard() {
  if (board) {
    await board.stop();
    return;
  }
  if (!canSerial()) {
    note("This browser has no Web Serial. Chromium, Chrome and Edge on a desktop have it.");
    return;
  }
  const baud = Number(byId("baud", HTMLSelectElement).value);
  const { Board } = await import("./board.js");
  const next = new Board(eventsFor(true), stage.state);
  board = next;
  charts?.clear();
  try {
    await next.start(baud);
    showBoardButton();
  } catch (why) {
    const error = /** @type {Error} */ (why);
    await next.stop(error.name === "NotFoundError" ? "No port was chosen." : error.message);
  }
}

/** Returns to the server. */
function leaveBoard() {
  board = null;
  showBoardButton();
  if (server.hello) {
    readout.setHello(server.hello);
    controls.setHello(server.hello);
    demonstration.hello = server.hello;
  }
  if (server.state) showState(server.state);
}

/** Handles the scene as a file. @param {string} what a button @param {File} [file] a dropped one */
async function useFiles(what, file) {
  const { use } = await import("./files.js");
  if (stage.state && !board) use(what, file, { stage, feed: source, tell: note, transport: isAlone ? null : transport });
}

/** Shows what the board's button does at present. */
function showBoardButton() {
  const button = byId("serial", HTMLButtonElement);
  setText(button, board ? "Leave the board" : "Board by Web Serial");
  button.setAttribute("aria-disabled", String(!canSerial()));
  for (const id of ["pause", "step", "speed", "record", "replay", "upload", "scenes", "edit", "open-scene", "save-scene",
    "defaults"]) {
    /** @type {HTMLButtonElement | HTMLSelectElement | HTMLFieldSetElement} */ (byId(id)).disabled = board !== null;
  }
  byId("no-serial").hidden = canSerial();
  byId("baud-label").hidden = !canSerial();
}

/** @param {boolean} keep the hand stays closed when the pointer lets go */
function setKeep(keep) {
  grip.keep = keep;
  byId("keep", HTMLInputElement).checked = keep;
}

/** Switches sound and vibration on or off. */
async function toggleSound() {
  const { toggle } = await import("./felt.js");
  felt = toggle(felt, byId("sound"));
}

const help = byId("help", HTMLDialogElement);
const toggleHelp = () => (help.open ? help.close() : help.showModal());
new Pointers(stage, grip, (kind, friction) => controls.set(kind, friction));
new Keys(stage, grip, {
  "p": () => controls.pause(), ".": () => controls.step(), "r": () => controls.reset(), "c": () => transport.record(),
  "k": () => setKeep(!grip.keep), "f": () => stage.fit(), "0": () => stage.fit(),
  "+": () => stage.zoom(ZOOM), "=": () => stage.zoom(ZOOM), "-": () => stage.zoom(1 / ZOOM),
  "t": () => byId("theme").click(), "m": () => toggleSound(), "?": toggleHelp, "h": toggleHelp,
});
byId("keep").addEventListener("change", () => setKeep(byId("keep", HTMLInputElement).checked));
byId("zoom-in").addEventListener("click", () => stage.zoom(ZOOM));
byId("zoom-out").addEventListener("click", () => stage.zoom(1 / ZOOM));
byId("zoom-fit").addEventListener("click", () => stage.fit());
byId("sound").addEventListener("click", () => toggleSound());
const wholePage = byId("whole-page");
wholePage.hidden = !navigator.mediaDevices?.getDisplayMedia;
wholePage.addEventListener("click", () => wholePage.setAttribute("aria-pressed", String(wholePage.ariaPressed !== "true")));
byId("film").hidden = typeof MediaRecorder === "undefined";
for (const id of ["picture", "film", "animation"]) byId(id).addEventListener("click", async () => {
  const { animate, film, takePicture, toggle } = await import("./shown.js");
  const shown = { stage, button: byId(id), tell: note }, ofPage = wholePage.ariaPressed === "true";
  try {
    await (id === "picture" ? takePicture(shown, ofPage) : toggle(shown, id === "film" ? film(ofPage) : animate));
  } catch (why) {
    note(`The browser does not give the picture. ${/** @type {Error} */ (why).message}`);
  }
});
byId("help-open").addEventListener("click", () => help.showModal());
byId("help-close").addEventListener("click", () => help.close());
for (const id of ["edit", "open-scene", "save-scene"]) byId(id).addEventListener("click", () => useFiles(id));
window.addEventListener("dragover", (event) => event.preventDefault());
window.addEventListener("drop", (event) => {
  event.preventDefault();
  useFiles("drop", event.dataTransfer?.files[0]);
});
byId("let-go").addEventListener("click", () => controls.ask({ type: "let-go" }));
byId("serial").addEventListener("click", () => toggleBoard());
for (const box of /** @type {NodeListOf<HTMLInputElement>} */ (document.querySelectorAll("input[data-layer]"))) {
  box.addEventListener("change", () => showLayer(box));
}

/** Shows or hides a layer, according to its box. @param {HTMLInputElement} box */
function showLayer(box) {
  stage.layers[/** @type {import("./stage.js").Layer} */ (box.dataset.layer)] = box.checked;
  stage.ask();
}
showBoardButton();

Object.defineProperty(window, "stiction", {
  value: Object.freeze({
    get frame() { return asItCame(stage.message); },
    get state() { return stage.state; },
    get connected() { return connected; },
    get framesDrawn() { return stage.framesDrawn; },
    get framesReceived() { return framesReceived; },
    get latencies() { return stage.latencies.list(); },
    get drawTimes() { return stage.drawTimes.list(); },
    /** @param {number} x @param {number} y */
    pixelOf(x, y) { return stage.pixelOf(x, y); },
  }),
});

/** The feed while no board is connected. @type {Feed & Partial<Files>} */
const source = isAlone ? await startAlone() : new Link(eventsFor(false));

/** Starts the solver in the page itself, and the address that describes what it shows. */
async function startAlone() {
  const [{ Alone }, { Address }] = await Promise.all([import("./alone.js"), import("./address.js")]);
  const alone = new Alone(eventsFor(false));
  address = new Address(stage, (message) => controls.ask(message), alone, (layer, shown) => {
    const box = /** @type {HTMLInputElement} */ (document.querySelector(`input[data-layer="${layer}"]`));
    box.checked = shown;
    showLayer(box);
  }, note);
  return alone;
}
