// The scene, or the whole page, as a file: a picture as PNG, a film as WebM, an animation as GIF. And as a small picture for the
// gallery.

/** Size of a picture or a film (px): 1080p. */
const SIZE = { width: 1920, height: 1080 };
/** Kinds of films, in order of preference; not every browser makes WebM. */
const KINDS = [["video/webm;codecs=vp9", "webm"], ["video/webm", "webm"], ["video/mp4", "mp4"]];
/** Bit rate of a film (bit/s): lines and texts stay sharp. */
const RATE = 8e6;
/** Interval of the images of a film (ms): a slip is seen in the one after it. */
const INTERVAL = 1000 / 30;
/**
 * Size of an animation (px), the interval of its images and its longest duration (ms). An image takes some 40 ms to compute, and a
 * minute of them as much memory as a browser gives.
 */
const SMALL = { width: 960, height: 540 };
const STEP = 100;
const LONGEST = 30_000;
/** Colours of an image of a GIF. */
const COLORS = 256;
/** Picture in the gallery: its size, the room around the object, spacing and depth of the hatching (px). */
const CARD = { width: 120, height: 72, room: 12, spacing: 6, depth: 5 };
/** Lifetime of a file offered to the browser (ms). */
const LIFETIME = 60_000;

/**
 * What is shown to the reader, and the button that was pressed.
 * @typedef {{stage: Stage, button: HTMLElement, tell: (text: string) => void}} Shown
 * @typedef {{end: () => void}} Running
 */

/** What is being recorded, by its button. @type {Map<HTMLElement, Running>} */
const running = new Map();

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
 * @param {Stage} stage @param {string} ending
 */
function nameOf(stage, ending) {
  const time = new Date();
  const scene = (stage.state?.scene.title ?? "scene").replace(/[^\p{L}\p{N}._-]+/gu, "-");
  const parts = [time.getMonth() + 1, time.getDate(), time.getHours(), time.getMinutes(), time.getSeconds()];
  const [month, day, ...clock] = parts.map((part) => String(part).padStart(2, "0"));
  return `${scene}-${time.getFullYear()}${month}${day}-${clock.join("")}.${ending}`;
}

/** A canvas of its own. @param {{width: number, height: number}} size */
function newCanvas(size) {
  const canvas = Object.assign(document.createElement("canvas"), size);
  return { canvas, ctx: /** @type {Ink} */ (canvas.getContext("2d", { alpha: false, willReadFrequently: true })) };
}

/** The page as a stream of images, after the browser has asked the reader. */
const streamOfPage = () => navigator.mediaDevices.getDisplayMedia(/** @type {DisplayMediaStreamOptions} */ (
  { video: { ...SIZE, frameRate: 1000 / INTERVAL }, preferCurrentTab: true }));

/** Saves a picture of the scene, or of the page. @param {Shown} shown @param {boolean} ofPage */
export async function takePicture({ stage, tell }, ofPage) {
  const name = nameOf(stage, "png");
  const { canvas, ctx } = newCanvas(SIZE);
  if (ofPage) {
    const stream = await streamOfPage();
    const video = Object.assign(document.createElement("video"), { srcObject: stream, muted: true });
    await video.play();
    Object.assign(canvas, { width: video.videoWidth, height: video.videoHeight });
    ctx.drawImage(video, 0, 0);
    stream.getTracks().forEach((track) => track.stop());
  } else {
    stage.paint(ctx);
  }
  canvas.toBlob((file) => {
    if (file) give(file, name);
    else tell("The browser makes no picture of this size.");
  }, "image/png");
}

/**
 * Begins a film or an animation, or ends it and offers its file to the reader; the button shows which.
 * @param {Shown} shown @param {(shown: Shown, ended: () => void) => Running | Promise<Running>} begin
 */
export async function toggle(shown, begin) {
  const { button } = shown;
  const now = running.get(button);
  if (now) {
    now.end();
    return;
  }
  const show = (/** @type {boolean} */ on) => button.setAttribute("aria-pressed", String(on));
  running.set(button, await begin(shown, () => {
    running.delete(button);
    show(false);
  }));
  show(true);
}

/** Films the scene, or the page. @param {boolean} ofPage */
export const film = (ofPage) => async (/** @type {Shown} */ { stage, tell }, /** @type {() => void} */ ended) => {
  const [mimeType, ending] = KINDS.find(([kind]) => MediaRecorder.isTypeSupported(kind)) ?? ["", "webm"];
  const name = nameOf(stage, ending);
  const { canvas, ctx } = newCanvas(SIZE);
  const stream = ofPage ? await streamOfPage() : canvas.captureStream();
  const timer = window.setInterval(() => { if (!ofPage) stage.paint(ctx); }, INTERVAL);
  /** @type {Blob[]} */
  const parts = [];
  const recorder = new MediaRecorder(stream, { mimeType, videoBitsPerSecond: RATE });
  recorder.addEventListener("dataavailable", ({ data }) => parts.push(data));
  recorder.addEventListener("error", () => tell("The browser cannot go on with the film."));
  recorder.addEventListener("stop", () => {
    clearInterval(timer);
    stream.getTracks().forEach((track) => track.stop());
    ended();
    const file = new Blob(parts, { type: mimeType.split(";")[0] });
    if (file.size > 0) give(file, name);
  });
  recorder.start();
  return { end: () => { if (recorder.state !== "inactive") recorder.stop(); } };
};

/** Animates the scene. @param {Shown} shown @param {() => void} ended */
export async function animate({ stage, tell }, ended) {
  const { GIFEncoder, quantize, applyPalette } = await import("./gifenc/gifenc.js");
  const name = nameOf(stage, "gif");
  const { ctx } = newCanvas(SMALL);
  const gif = GIFEncoder();
  const begin = performance.now();
  let shown = begin;
  const timer = window.setInterval(() => {
    stage.paint(ctx);
    const { data } = ctx.getImageData(0, 0, SMALL.width, SMALL.height);
    const palette = quantize(data, COLORS, { format: "rgb444" });
    const now = performance.now();
    // Where the images take longer than their interval, the animation still has its real duration.
    gif.writeFrame(applyPalette(data, palette, "rgb444"), SMALL.width, SMALL.height, { palette, delay: Math.max(STEP, now - shown) });
    shown = now;
    if (now - begin < LONGEST) return;
    tell(`The animation ends after ${LONGEST / 1000} s.`);
    end();
  }, STEP);
  const end = () => {
    clearInterval(timer);
    ended();
    gif.finish();
    give(new Blob([gif.bytes()], { type: "image/gif" }), name);
  };
  return { end };
}

/**
 * Returns the picture of a scene for the gallery, as SVG: the world and the object at the start, like the pictures of the program.
 * @param {Scene} scene
 */
export function sketch({ body, start: [x, y, theta], home, surfaces, obstacles }) {
  const c = Math.cos(theta), s = Math.sin(theta);
  const corners = body.map(([u, v]) => /** @type {Vec} */ ([x + c * u - s * v, y + s * u + c * v]));
  const [[left, right], [low, high]] = [0, 1].map((axis) => {
    const places = [...corners, home].map((point) => point[axis]);
    return [Math.min(...places), Math.max(...places)];
  });
  const { width, height, room, spacing, depth } = CARD;
  const fits = Math.min((width - 2 * room) / (right - left), (height - 2 * room) / (high - low));
  // A point that is held has no size.
  const scale = Number.isFinite(fits) ? fits : 1;
  const [middleX, middleY] = [(left + right) / 2, (low + high) / 2];
  /** @param {number[]} point @returns {Vec} */
  const at = ([u, v]) => [width / 2 + scale * (u - middleX), height / 2 - scale * (v - middleY)];
  const line = (/** @type {number[][]} */ points) => `M${points.map((point) => point.map((n) => n.toFixed(1)).join(" ")).join("L")}`;
  const path = (/** @type {string} */ d, /** @type {string} */ style = "") => `<path d="${d}" ${style}/>`;
  let borders = "", hatch = "", behind = "";
  for (const { normal: [nx, ny], offset } of surfaces) {
    const gap = nx * middleX + ny * middleY - offset;
    const [px, py] = at([middleX - gap * nx, middleY - gap * ny]);
    /** A point along the surface and behind it (px). @param {number} along @param {number} back */
    const place = (along, back) => [px + along * ny - back * nx, py + along * nx + back * ny];
    borders += line([place(-width, 0), place(width, 0)]);
    for (let k = -width; k < width; k += spacing) hatch += line([place(k, 0), place(k - 0.8 * depth, depth)]);
    // What is buried in another surface is not seen.
    behind += line([place(-width, depth), place(width, depth), place(width, 3 * width), place(-width, 3 * width)]);
  }
  const solids = (obstacles ?? []).map(({ vertices }) => `${line(vertices.map(at))}Z`).join("");
  const [hx, hy] = at(home);
  return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${width} ${height}" fill="none" stroke="currentColor" stroke-width="1.5"
    stroke-linejoin="round" stroke-linecap="round">${path(hatch, 'stroke="var(--hatch)" stroke-width=".7"')}${path(borders)}
    ${path(behind, 'fill="var(--paper)" stroke="none"')}${path(solids, 'fill="var(--solid)"')}
    ${path(`${line(corners.map(at))}Z`, `fill="var(--body-fill)" stroke="var(--body)" stroke-width="${[7, 4][body.length - 1] ?? 2}"`)}
    <circle cx="${hx}" cy="${hy}" r="3" fill="currentColor"/></svg>`;
}
