// Types of the messages to and from the page, for the type checker. Nothing here is served. SI units: m, rad, N, N·m, s; angles
// unwrapped.

type Vec = [number, number];
/** A position in the drawing (px). */
type Spot = { x: number; y: number };
type Ink = CanvasRenderingContext2D;
type View = import("./view.js").View;
type Stage = import("./stage.js").Stage;
type Grip = import("./grip.js").Grip;

/** A message of the wire, with the fields of its type. */
type Message = { type: string; sequence: number; time: number; [field: string]: any };

/** Sends a request to the feed; shows the reader the reason of a refusal. */
type Ask = (message: { type: string; [field: string]: unknown }) => Promise<boolean>;
type Pose = [number, number, number];
type StateName = "non-contact" | "single-vertex" | "edge" | "two-vertex" | "corner" | "locked";

interface Contact {
  /** The vertex of the object that touches, on a surface or on a side of an obstacle. */
  vertex?: number;
  surface?: string;
  obstacle?: string;
  side?: number;
  /** Instead of these, the corner of the obstacle, on a side of the object. */
  corner?: number;
  body_side?: number;
  /** In a scene with obstacles: the unit normal towards the object. */
  direction?: Vec;
  point: Vec;
  normal: number;
  friction: number;
  /** 1 or -1 if it slides along the tangent or against it, 0 if it sticks. */
  sliding: number;
}

/** A record of the trace. */
interface TraceFrame {
  t: number;
  hand: Pose;
  held: boolean;
  pose: Pose;
  depth: number;
  state: StateName;
  contacts: Contact[];
  wrench: Pose;
  slips: number;
  events: string[];
  status: string;
  /** Present while a peg is in its hole. */
  insertion?: Insertion;
}

/** The load on a peg by the walls of its hole, in the peg's frame. */
interface Insertion {
  depth: number;
  fx: number;
  fz: number;
  m: number;
  lambda: number | null;
  margin: number | null;
  verdict: "free" | "one-point" | "two-point" | "jammed" | "wedged";
}

interface Slip {
  n: number;
  t: number;
  point: Vec;
  /** The unit normal towards the object. */
  direction: Vec;
  length: number;
}

interface Reference {
  pose: Pose;
  state: StateName;
  error: Vec;
  worst: Vec;
  differ: number;
  since: number;
}

interface Counts {
  ticks: number;
  missed: number;
  slips: number;
  transitions: { [pair: string]: number };
  events: { [name: string]: number };
}

interface BoardHealth {
  rate: number;
  latency: number | null;
  late: number;
  lost: number;
  missed: number;
  faults: number;
  connected: boolean;
}

interface FrameMessage {
  type: "frame";
  tick: number;
  skipped: number;
  frame: TraceFrame;
  holding: Vec | null;
  ghost: Pose | null;
  /** F_z by Whitney's formulas, while a peg is in its hole. */
  small_angles?: { one_point: number | null; two_points: number | null };
  echo: number | null;
  reference: Reference | null;
  counts: Counts;
  slips: Slip[];
  strip: number[][];
  /** A board does not report its median. */
  step: { median: number | null; worst: number } | null;
  board: BoardHealth | null;
  position?: number | null;
}

interface Surface {
  name: string;
  normal: Vec;
  offset: number;
  static?: number;
  dynamic?: number;
  /** Null: the default of a scene without one. */
  memory?: number | null;
}

/** One corner: a pin, two: a thin wall. */
interface Obstacle {
  name: string;
  vertices: Vec[];
  static?: number;
  dynamic?: number;
  memory?: number | null;
}

/** What a contact touches: its normal towards the object at the contact, its friction. */
type Facing = { name: string; normal: Vec; static?: number; dynamic?: number };

/** Half the width of a peg; width, friction and length of its hole. */
interface Peg {
  radius: number;
  width: number;
  friction: number;
  length: number;
}

interface Scene {
  title: string;
  /** A board has none. */
  story?: string | null;
  body: Vec[];
  surfaces: Surface[];
  /** A board has none. */
  obstacles?: Obstacle[];
  /** Null: no peg and hole. */
  peg?: Peg | null;
  weight: number;
  grasp: Vec | null;
  reach: number;
  start: Pose;
  home: Pose;
}

interface SceneParameters {
  stiffness_translation: number;
  stiffness_rotation: number;
  static: number;
  dynamic: number;
  /** Null: the default of a scene without one. */
  memory: number | null;
  /** Weight of the object (N). */
  weight: number;
}

interface StateMessage {
  type: "state";
  scene: Scene;
  parameters: SceneParameters;
  number: string;
  evolution: string;
  paused: boolean;
  speed: number;
  recording: number | null;
  recording_file: string | null;
  recorded: { seconds: number; frames: number; file: string; earlier: boolean; problem: string | null } | null;
  replay: { what: string; seconds: number; demonstration?: boolean } | null;
  hand: { by: string | null; client: number | null };
  clients: number;
  /** Absent for a board over Web Serial. */
  scenes?: string[];
  scene_problem?: string | null;
}

interface Source {
  kind: "core" | "board";
  name?: string;
  number?: string;
  where?: string;
  emulated?: boolean;
}

interface HelloMessage {
  type: "hello";
  version: number;
  you: number;
  program: string;
  scenes: string[];
  /** In the same order: what there is to see. A board over Web Serial has none, and no pictures. */
  stories?: (string | null)[];
  source: Source;
}

/** The source of what the page shows: the server, or a board over Web Serial. */
interface Feed {
  /** Sends a sample of the hand. */
  hand(pose: Pose, held: boolean, sent: number): void;
  /** Sends any other message; resolves when it is done, rejects with a readable reason. */
  request(message: { type: string; [field: string]: unknown }): Promise<void>;
}

/** Scenes as files, which a board does not take. */
interface Files {
  /** Sends a file or requests one; returns the text of the answer. */
  file(path: "scene" | "edit" | "scene.toml", name: string, body: string | null): Promise<string>;
}

interface FeedEvents {
  hello(message: HelloMessage): void;
  state(message: StateMessage): void;
  frame(message: FrameMessage): void;
  /** True: connected. */
  connected(yes: boolean): void;
  error(message: string): void;
}

/** Values that tests read on `window.stiction`. */
interface Probe {
  readonly frame: FrameMessage | null;
  readonly state: StateMessage | null;
  readonly connected: boolean;
  readonly framesDrawn: number;
  readonly framesReceived: number;
  readonly latencies: readonly number[];
  readonly drawTimes: readonly number[];
  /** Returns the position of a point of the world (m) in the window of the browser (CSS px). */
  pixelOf(x: number, y: number): Spot;
}

interface Window {
  stiction: Probe;
}

// The part of uPlot that the page uses.

interface UPlotSeries {
  label?: string;
  scale?: string;
  stroke?: string | (() => string);
  fill?: string | (() => string);
  width?: number;
  dash?: number[];
  points?: {
    show?: boolean; size?: number; fill?: string | (() => string); stroke?: string | (() => string); width?: number;
  };
  paths?: (u: UPlot, series: number, from: number, to: number) => { stroke: Path2D; fill: null } | null;
}

interface UPlotOptions {
  width: number;
  height: number;
  legend?: { show: boolean };
  cursor?: object;
  padding?: (number | null)[];
  scales?: { [name: string]: { [option: string]: unknown } };
  axes?: { [option: string]: unknown }[];
  series: UPlotSeries[];
}

declare class UPlot {
  constructor(options: UPlotOptions, data: ArrayLike<number | null>[], target: HTMLElement);
  data: ArrayLike<number>[];
  /** The area between the axes. */
  over: HTMLElement;
  /** Position of the pointer, or of the moment shared with another plot: negative if there is none (CSS px). */
  cursor: { left: number };
  scales: { [name: string]: { min?: number | null; max?: number | null } };
  hooks: { setCursor?: ((plot: UPlot) => void)[] };
  posToVal(position: number, scale: string): number;
  width: number;
  height: number;
  setData(data: ArrayLike<number | null>[], rescale?: boolean): void;
  setScale(name: string, range: { min: number; max: number }): void;
  setSize(size: { width: number; height: number }): void;
  batch(work: () => void): void;
  redraw(rebuild?: boolean): void;
  valToPos(value: number, scale: string, canvas?: boolean): number;
  destroy(): void;
}

declare const uPlot: typeof UPlot;

// Web Serial, which is missing in the type checker's browser types.

interface SerialPort extends EventTarget {
  open(options: { baudRate: number; bufferSize?: number }): Promise<void>;
  close(): Promise<void>;
  readonly readable: ReadableStream<Uint8Array> | null;
  readonly writable: WritableStream<Uint8Array> | null;
}

interface Navigator {
  readonly serial?: { requestPort(): Promise<SerialPort> };
}
