// What is seen as a file: a picture of the scene as PNG, a film of it as WebM.

/** The kinds of a film, the first that the browser makes; not every one makes WebM. */
const KINDS = [["video/webm;codecs=vp9", "webm"], ["video/webm", "webm"], ["video/mp4", "mp4"]];
/** Bits of a film a second: lines and texts stay sharp. */
const RATE = 8e6;
/** A scene that rests is drawn as often as this, so that the film is as long as it took (ms). */
const REST = 100;
/** A file that is given to the browser is kept for so long (ms). */
const KEPT = 60_000;

/** Gives a file to the reader. @param {Blob} file @param {string} name */
function give(file, name) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(file);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), KEPT);
}

/**
 * A file's name: the scene, and the local time: box-flat-20260131-235959.png.
 * @param {Stage} stage @param {string} ending @param {Date} time
 */
function nameOf(stage, ending, time) {
  const scene = (stage.state?.scene.title ?? "scene").replace(/[^\p{L}\p{N}._-]+/gu, "-");
  const parts = [time.getMonth() + 1, time.getDate(), time.getHours(), time.getMinutes(), time.getSeconds()];
  const [month, day, ...clock] = parts.map((part) => String(part).padStart(2, "0"));
  return `${scene}-${time.getFullYear()}${month}${day}-${clock.join("")}.${ending}`;
}

/** A picture of the scene, with a pixel for each of the screen. @param {Stage} stage @param {(text: string) => void} tell */
export function takePicture(stage, tell) {
  const time = new Date();
  stage.draw();
  stage.canvas.toBlob((file) => {
    if (file) give(file, nameOf(stage, "png", time));
    else tell("The browser makes no picture of a scene of this size.");
  }, "image/png");
}

/** The film that is being made. @type {MediaRecorder | null} */
let film = null;

/**
 * Begins a film, or ends it and gives its file to the reader; the button shows which.
 * @param {Stage} stage @param {HTMLElement} button @param {(text: string) => void} tell
 */
export function toggleFilm(stage, button, tell) {
  if (!film) film = begun(stage, button, tell);
  else if (film.state !== "inactive") film.stop();
  button.setAttribute("aria-pressed", String(film.state === "recording"));
}

/** A film that has begun. @param {Stage} stage @param {HTMLElement} button @param {(text: string) => void} tell */
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
