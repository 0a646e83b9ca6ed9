// The visible scene as a file: a picture as PNG, a film as WebM.

/** Kinds of films, in order of preference; not every browser makes WebM. */
const KINDS = [["video/webm;codecs=vp9", "webm"], ["video/webm", "webm"], ["video/mp4", "mp4"]];
/** Bit rate of a film (bit/s): lines and texts stay sharp. */
const RATE = 8e6;
/** Interval of drawings of a scene at rest (ms), so that the film has its real duration. */
const REST = 100;
/** Lifetime of a file offered to the browser (ms). */
const LIFETIME = 60_000;

/** Offers a file to the reader. @param {Blob} file @param {string} name */
function give(file, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), LIFETIME);
}

/**
 * Returns a file's name from the scene and the local time: box-flat-20260131-235959.png.
 * @param {Stage} stage @param {string} ending @param {Date} time
 */
function nameOf(stage, ending, time) {
  const scene = (stage.state?.scene.title ?? "scene").replace(/[^\p{L}\p{N}._-]+/gu, "-");
  const parts = [time.getMonth() + 1, time.getDate(), time.getHours(), time.getMinutes(), time.getSeconds()];
  const [month, day, ...clock] = parts.map((part) => String(part).padStart(2, "0"));
  return `${scene}-${time.getFullYear()}${month}${day}-${clock.join("")}.${ending}`;
}

/** Saves a picture of the scene, with the pixels of the screen. @param {Stage} stage @param {(text: string) => void} tell */
export function takePicture(stage, tell) {
  const time = new Date();
  stage.draw();
  stage.canvas.toBlob((file) => {
    if (file) give(file, nameOf(stage, "png", time));
    else tell("The browser makes no picture of a scene of this size.");
  }, "image/png");
}

/** The film being recorded. @type {MediaRecorder | null} */
let film = null;

/**
 * Begins a film, or ends it and offers its file to the reader; the button shows which.
 * @param {Stage} stage @param {HTMLElement} button @param {(text: string) => void} tell
 */
export function toggleFilm(stage, button, tell) {
  if (!film) film = begun(stage, button, tell);
  else if (film.state !== "inactive") film.stop();
  button.setAttribute("aria-pressed", String(film.state === "recording"));
}

/** Starts a film. @param {Stage} stage @param {HTMLElement} button @param {(text: string) => void} tell */
function begun(stage, button, tell) {
  const time = new Date();
  const [mimeType, ending] = KINDS.find(([kind]) => MediaRecorder.isTypeSupported(kind)) ?? ["", "webm"];
  /** @type {Blob[]} */
  const parts = [];
  const stream = stage.canvas.captureStream();
  const recorder = new MediaRecorder(stream, { mimeType, videoBitsPerSecond: RATE });
  const timer = window.setInterval(() => stage.ask(), REST);
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  recorder.addEventListener("error", () => tell("The browser cannot go on with the film."));
  recorder.addEventListener("stop", () => {
    clearInterval(timer);
    stream.getTracks().forEach((track) => track.stop());
    film = null;
    button.setAttribute("aria-pressed", "false");
    const file = new Blob(parts, { type: mimeType.split(";")[0] });
    if (file.size > 0) give(file, nameOf(stage, ending, time));
  });
  recorder.start();
  stage.ask();
  return recorder;
}
