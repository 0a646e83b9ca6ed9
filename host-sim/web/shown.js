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

/** A film, from when it is made until it is ended. */
export class Film {
  /** @param {Stage} stage @param {(why: string | null) => void} ended with what is wrong, or null */
  constructor(stage, ended) {
    const time = new Date();
    const [type, ending] = KINDS.find(([kind]) => MediaRecorder.isTypeSupported(kind)) ?? ["", "webm"];
    /** @type {Blob[]} */
    const parts = [];
    this.stream = stage.canvas.captureStream();
    this.recorder = new MediaRecorder(this.stream, { mimeType: type, videoBitsPerSecond: RATE });
    this.timer = window.setInterval(() => stage.ask(), REST);
    /** @type {string | null} */
    let problem = null;
    this.recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
    this.recorder.addEventListener("error", () => { problem = "The browser cannot go on with the film."; });
    this.recorder.addEventListener("stop", () => {
      clearInterval(this.timer);
      this.stream.getTracks().forEach((track) => track.stop());
      const file = new Blob(parts, { type: type.split(";")[0] });
      if (file.size > 0) give(file, nameOf(stage, ending, time));
      ended(problem);
    });
    this.recorder.start();
    stage.ask();
  }

  /** Ends it; the file comes by itself. */
  end() {
    if (this.recorder.state !== "inactive") this.recorder.stop();
  }
}
