// A server that sends what a test wants: messages of the socket, in place of a solver's.

/** @typedef {import("./live.js").Live} Live */

/** A box of 0.10 m by 0.06 m on a floor: L = 0.1166 m, k_h L = 58.3 N. */
const PARAMETERS = { stiffness_translation: 500, stiffness_rotation: 0.5, static: 0.5, dynamic: 0.3, memory: null };
/** @type {Scene} */
const SCENE = {
  title: "box", body: [[-0.05, -0.03], [0.05, -0.03], [0.05, 0.03], [-0.05, 0.03]],
  surfaces: [{ name: "floor", normal: [0, 1], offset: 0, static: 0.5, dynamic: 0.3, memory: null }], obstacles: [],
  peg: null, weight: 0, grasp: [0, 0.02], reach: 0.02, start: [0, 0.03, 0], home: [0, 0.05, 0],
};
const HELLO = { type: "hello", version: 1, you: 1, program: "stiction", scenes: ["box"], source: { kind: "core" } };

/** Returns a frame of the box at rest on the floor. @returns {FrameMessage} */
export function restingFrame() {
  return {
    type: "frame", tick: 0, skipped: 0, holding: [0, 0.05], ghost: [0, 0.03, 0], echo: null, reference: null,
    frame: {
      t: 0, hand: [0, 0.05, 0], held: true, pose: [0, 0.03, 0], depth: 0, state: "edge", wrench: [0, 0, 0], slips: 0,
      contacts: [-0.05, 0.05].map((x, vertex) => ({
        vertex, surface: "floor", point: [x, 0], normal: 0, friction: 0, sliding: 0,
      })),
      events: [], status: "ok",
    },
    counts: { ticks: 0, missed: 0, slips: 0, transitions: {}, events: {} },
    slips: [], strip: [], step: { median: 1e-5, worst: 1e-4 }, board: null, position: null,
  };
}

/** @param {Partial<Scene>} scene @param {Partial<SceneParameters>} parameters */
const stateText = (scene, parameters) => JSON.stringify({
  type: "state", scene: { ...SCENE, ...scene }, parameters: { ...PARAMETERS, ...parameters }, number: "f32",
  evolution: "path", paused: false, speed: 1, recording: null, recording_file: null, recorded: null, replay: null,
  hand: { by: null, client: null }, clients: 1,
});

/** Sends frames to a page, each one a tick later than the previous one. */
export class Said {
  /** @param {(text: string) => void} send @param {Live} live */
  constructor(send, live) {
    this.send = send;
    this.live = live;
    this.tick = 0;
  }

  /**
   * Sends a state, which is valid until the next one.
   * @param {Partial<Scene>} [scene] @param {Partial<SceneParameters>} [parameters]
   */
  state(scene = {}, parameters = {}) {
    this.send(stateText(scene, parameters));
  }

  /** Sends a frame; waits until it is drawn and shown as text. @param {FrameMessage} message */
  async frame(message) {
    const tick = ++this.tick;
    const frame = { ...message.frame, t: tick / 1000 };
    const strip = message.strip.map(([, ...forces]) => [frame.t, ...forces]);
    const slips = message.slips.map((slip) => ({ ...slip, n: tick, t: frame.t }));
    this.send(JSON.stringify({ ...message, tick, frame, strip, slips }));
    await this.live.until((wanted) => window.stiction.frame?.tick === wanted, tick);
    // Texts are updated ten times per second, charts more often: a drawing after that time shows everything.
    await this.live.page.evaluate(() => new Promise((done) => {
      const begin = performance.now();
      const wait = () => (performance.now() - begin > 150 ? done(null) : requestAnimationFrame(wait));
      requestAnimationFrame(wait);
    }));
  }
}

/**
 * Opens a page whose socket ends here: it receives nothing from a solver.
 * @param {import("./live.js").Bench} bench @param {import("playwright-core").BrowserContextOptions} [options]
 */
export async function openSaid(bench, options) {
  /** @type {(text: string) => void} */
  let send = () => {};
  const live = await bench.openBy(options, (page) => page.routeWebSocket(/\/ws$/, (socket) => {
    send = (text) => socket.send(text);
    send(JSON.stringify(HELLO));
    send(stateText({}, {}));
    send(JSON.stringify(restingFrame()));
  }));
  return { live, said: new Said((text) => send(text), live) };
}
