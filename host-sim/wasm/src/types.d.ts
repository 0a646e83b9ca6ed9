/** Options in addition to the scene. */
export interface SolverOptions {
  /** The number type: by default `"f32"`; `"f64"` is the reference, `"fixed"` for chips without floating point. */
  number?: "f32" | "f64" | "fixed";
  /**
   * `"path"`, the default: events are found along the hand's straight line between two samples. `"frame"`: from the first
   * event on, the hand jumps to the sample.
   */
  evolution?: "path" | "frame";
  /** Units of work that a sample may take, 1 to 4294967295; unlimited by default. */
  budget?: number;
}

/** A contact of the body. */
export interface Contact {
  /** The vertex of the body that touches, by its number in the scene. */
  vertex?: number;
  /** The touched surface. */
  surface?: string;
  /** The touched obstacle, or the one whose corner touches. */
  obstacle?: string;
  /** The touched side of the obstacle. */
  side?: number;
  /** The corner of the obstacle that touches. */
  corner?: number;
  /** The side of the body that it touches. */
  body_side?: number;
  /** The position of the contact: x, y (m), world. */
  point: [number, number];
  /** Reaction N on the body along the normal, 0 or more (N). */
  normal: number;
  /** Friction T on the body along the tangent t = (n_y, -n_x) (N). */
  friction: number;
  /** 0 while it sticks, 1 or -1 while it slides along t or against it. */
  sliding: -1 | 0 | 1;
  /** The unit normal n towards the body, world; only in scenes with obstacles. */
  direction?: [number, number];
}

/** A sample of the hand, and the equilibrium that it leads to. SI units, world frame, angles unwrapped. */
export interface Frame {
  /** Time of the sample (s). */
  t: number;
  /** Hand: x, y (m), phi (rad); the last valid one if the sample was invalid. */
  hand: [number, number, number];
  /** The hand holds the body. */
  held: boolean;
  /** Body: x, y (m), theta (rad). */
  pose: [number, number, number];
  /** Depth coordinate (m). */
  depth: number;
  /** The contact state. */
  state: "non-contact" | "single-vertex" | "edge" | "two-vertex" | "corner" | "locked";
  /** The contacts. */
  contacts: Contact[];
  /** The wrench of the hand on the body: force x, y (N), moment about the holding point (N·m). */
  wrench: [number, number, number];
  /** Slips that ended with this sample. */
  slips: number;
  /** What happened, in order. */
  events: string[];
  /** What limited the answer; `"ok"`: nothing. */
  status: string;
  /** The fraction of the hand's displacement not yet followed, 0 to 1; only with a budget. */
  behind?: number;
  /** The load on a peg while it is in its hole: depth (m), forces (N) and moment (N·m) in the peg's frame. */
  insertion?: {
    depth: number; fx: number; fz: number; m: number; lambda: number | null; margin: number | null; verdict: string;
  };
}

/** The answers to n samples. SI units, world frame, angles unwrapped. */
export interface Answers {
  /** n times of samples (s). */
  t: Float64Array;
  /** n rows of the body: x, y (m), theta (rad). */
  pose: Float64Array;
  /** n rows of the hand's wrench on the body: force x, y (N), moment about the holding point (N·m). */
  wrench: Float64Array;
  /** n contact states, as numbers of `stateNames()`. */
  state: Uint8Array;
  /** n statuses, as numbers of `statusNames()`. */
  status: Uint8Array;
  /** n counts of the slips that ended with the sample. */
  slips: Uint32Array;
  /**
   * A row for each contact of each sample: number of the sample, x, y of the contact (m), reaction N (N), friction T (N),
   * sliding (-1, 0 or 1).
   */
  contacts: Float64Array;
}
