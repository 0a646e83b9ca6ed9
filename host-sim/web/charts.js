// Strip charts of the last seconds: reactions between their friction limits, slip lengths, time per step. They share a time
// axis, are drawn together, and a pointer over one of them shows the same moment in all.

import { byId, digits, duration, setText, whole } from "./dom.js";
import { unitsOf } from "./sizes.js";
import { colors, onTheme } from "./theme.js";
import { Strip } from "./strip.js";

/** Resolution of the time that a browser gives a page (s). */
const CLOCK = 1e-4;
/** Width of the window in real time (s); in slow motion it shows less of the solver's time. */
const WINDOW = 2;
/** Number of ticks in memory: those in the window and a few more. */
const TICKS = 9000;
/** Number of slips in memory. */
const SLIPS = 2000;
/** Number of step times in memory, and the time between two of them (s). */
const STEPS = 400;
const STEP_SPACING = 0.05;
/** Pause between two drawings (ms). */
const PAUSE = 66;
/** Name under which the charts share the pointer's position. */
const SHARED = "stiction-time";
/** Largest distance of a slip from the moment under the pointer (px). */
const NEAR = 4;
/** Least distance of two ticks of the reactions (px): a line of text. */
const TICK = 17;
/** Room at an axis, in characters. */
const ROOM = 6;

/** Loads the library that draws the charts, unless the page contains it, and starts them. */
export async function startCharts() {
  if (!("uPlot" in globalThis)) {
    const script = document.createElement("script");
    script.src = "uplot/uplot.min.js";
    await new Promise((loaded, failed) => {
      Object.assign(script, { onload: loaded, onerror: failed });
      document.head.append(script);
    });
  }
  return new Charts();
}

export class Charts {
  constructor() {
    this.surface = 0;
    /** Until the reader chooses a surface, one that is pressed is shown. */
    this.follows = true;
    this.mu = { static: 0, dynamic: 0 };
    /** t, N, T, ± mu_s N, ± mu_d N */
    this.forces = new Strip(7, TICKS);
    /** t, longest slip of a tick (m) */
    this.slips = new Strip(2, SLIPS);
    /** t, median and worst in µs */
    this.steps = new Strip(3, STEPS);
    this.newestSlip = -1;
    this.time = 0;
    this.window = WINDOW;
    this.picker = byId("chart-surface", HTMLSelectElement);
    this.picker.addEventListener("change", () => {
      this.follows = false;
      this.pick(Number(this.picker.value));
    });
    /** Units of the scene. @type {ReturnType<typeof unitsOf>} */
    this.units = { length: { name: "mm", per: 1e3 }, force: { name: "N", per: 1 }, moment: { name: "N·m", per: 1 } };
    this.plots = [forcePlot(() => this.units.force), slipPlot(() => this.units.length), stepPlot()];
    this.data = [this.forces, this.slips, this.steps];
    this.moments = this.plots.map(({ over }) => over.appendChild(document.createElement("span")));
    for (const moment of this.moments) moment.className = "moment";
    for (const plot of this.plots) plot.hooks.setCursor = [() => this.tell()];
    this.drawn = 0;
    /** There are data that the charts do not show yet. */
    this.stale = false;
    /** @type {FrameMessage | null} */
    this.message = null;
    /** Surfaces, then obstacles. @type {(Surface | Obstacle)[]} */
    this.solids = [];
    /** @type {StateMessage | null} */
    this.state = null;
    onTheme(() => this.plots.forEach((plot) => plot.redraw(false)));
  }

  /** Takes a state: the surfaces and obstacles to choose from and their friction. @param {StateMessage} state */
  setState(state) {
    this.state = state;
    this.units = unitsOf(state);
    setText(byId("unit-force"), this.units.force.name);
    setText(byId("unit-slip"), this.units.length.name);
    // Without data, too, the scales are those of the scene's units.
    this.stale = true;
    this.window = WINDOW * Math.min(1, Math.max(0.01, state.speed));
    const solids = [...state.scene.surfaces, ...state.scene.obstacles ?? []];
    const names = solids.map(({ name }) => name);
    if (names.join("\n") !== this.solids.map(({ name }) => name).join("\n")) {
      this.picker.replaceChildren(...names.map((name, i) => new Option(name, String(i))));
      this.surface = 0;
      this.follows = true;
      this.clear();
    }
    this.solids = solids;
    this.picker.hidden = names.length < 2;
    this.friction();
  }

  /** Shows another surface. @param {number} index */
  pick(index) {
    this.surface = index;
    this.forces.clear();
    this.friction();
  }

  /** Shows the surface that is pressed most where the chart has no force of the shown one. @param {number[]} tick */
  follow(tick) {
    const pressed = this.solids.map((_solid, i) => tick[1 + 2 * i] ?? 0);
    const most = pressed.indexOf(Math.max(...pressed));
    if (!this.follows || !(pressed[most] > 0) || this.forces.extent(this.time - this.window, 2)[1] > 0) return;
    this.picker.value = String(most);
    if (most !== this.surface) this.pick(most);
  }

  /** Takes the friction of the surface that is shown. */
  friction() {
    if (!this.state) return;
    const surface = this.solids[this.surface];
    this.mu.static = surface?.static ?? this.state.parameters.static;
    this.mu.dynamic = surface?.dynamic ?? this.state.parameters.dynamic;
  }

  /** Clears everything, after a reset. */
  clear() {
    for (const strip of this.data) strip.clear();
    this.newestSlip = -1;
    this.time = 0;
  }

  /** Takes a frame message. @param {FrameMessage} message */
  take(message) {
    if (message.frame.t < this.time) this.clear();
    this.time = message.frame.t;
    this.message = message;
    this.stale = true;
    if (message.strip.length > 0) this.follow(message.strip[message.strip.length - 1]);
    const { static: mus, dynamic: mud } = this.mu;
    for (const tick of message.strip) {
      const n = tick[1 + 2 * this.surface] ?? 0, t = tick[2 + 2 * this.surface] ?? 0;
      this.forces.push(tick[0], n, t, mus * n, -mus * n, mud * n, -mud * n);
    }
    for (const slip of message.slips) {
      if (slip.n <= this.newestSlip) continue;
      this.newestSlip = slip.n;
      this.slips.push(slip.t, slip.length);
    }
    const last = this.steps.last(0);
    if (message.step && !(this.time < last + STEP_SPACING * this.window / WINDOW)) {
      this.steps.push(this.time, (message.step.median ?? NaN) * 1e6, message.step.worst * 1e6);
    }
  }

  /** Draws new data, some fifteen times per second. Returns true if it must be called again to show the newest. */
  draw() {
    if (!this.stale) return false;
    const now = performance.now();
    if (now - this.drawn < PAUSE) return true;
    this.drawn = now;
    this.stale = false;
    const from = Math.max(0, this.time - this.window);
    this.plots.forEach((plot, i) => plot.batch(() => {
      plot.setData(this.data[i].since(from), false);
      plot.setScale("x", { min: from, max: from + this.window });
      if (i !== 2) plot.setScale("y", range(this.data[i], from, i === 0 ? 7 : 2, this.units[i === 0 ? "force" : "length"]));
      else plot.setScale("y", logRange(this.data[i]));
    }));
    this.tell();
    return false;
  }

  /** Shows the values next to the charts' titles: at the moment under the pointer, otherwise the newest. */
  tell() {
    const [{ cursor }] = this.plots;
    const at = cursor.left >= 0 ? this.plots[0].posToVal(cursor.left, "x") : null;
    this.plots.forEach((plot, i) => showMoment(plot, this.moments[i], at));
    this.tellForces(at);
    this.tellSlips(at);
    this.tellSteps(at);
  }

  /** Returns a value of a strip at a past moment, or NaN. @param {Strip} strip @param {number} at s @param {number} column */
  past(strip, at, column) {
    return at > this.time ? NaN : strip.before(at, column);
  }

  /** @param {number | null} at s */
  tellForces(at) {
    const { per } = this.units.force;
    for (const [id, letter, column] of /** @type {const} */ ([["now-n", "N", 1], ["now-t", "T", 2]])) {
      const force = at === null ? this.forces.last(column) || 0 : this.past(this.forces, at, column);
      setText(byId(id), `${letter} ${digits(force * per)}`);
    }
  }

  /** @param {number | null} at s */
  tellSlips(at) {
    const { name, per } = this.units.length;
    const all = this.message?.counts.slips ?? 0;
    const near = NEAR * this.window / Math.max(1, this.plots[1].over.clientWidth);
    const length = at === null ? this.slips.last(1) : this.slips.nearest(at, near);
    const which = at === null ? "last" : "here";
    const longest = `${which} ${Number.isNaN(length) ? "none" : `${digits(length * per)} ${name}`}`;
    setText(byId("now-slip"), all === 0 ? "none yet" : `${longest}, ${whole(all)} in all`);
  }

  /** @param {number | null} at s */
  tellSteps(at) {
    const { step } = this.message ?? {};
    if (!step) return;
    const [median, worst] = at === null ? [step.median, step.worst]
      : [1, 2].map((column) => this.past(this.steps, at, column) * 1e-6);
    setText(byId("now-median"), medianOf(median));
    setText(byId("now-worst"), `worst ${duration(worst)}`);
  }
}

/**
 * Shows the moment under the pointer, next to its line.
 * @param {UPlot} plot @param {HTMLElement} moment @param {number | null} at s
 */
function showMoment(plot, moment, at) {
  moment.hidden = at === null;
  if (at === null) return;
  setText(moment, `${at.toFixed(3)} s`);
  const { left } = plot.cursor;
  const isLeft = left > plot.over.clientWidth / 2;
  moment.style.left = `${left}px`;
  moment.dataset.left = String(isLeft);
}

/** @param {number | null} median of the steps (s): 0 if the solver runs in the page. */
function medianOf(median) {
  if (median === null || Number.isNaN(median)) return "no median";
  return median > 0 ? `median ${duration(median)}` : `median below ${duration(CLOCK)}`;
}

/**
 * Returns the range of the first columns of a strip, with a margin, including 0; one unit if all are 0.
 * @param {Strip} strip @param {number} from @param {number} columns @param {import("./sizes.js").Unit} unit
 */
function range(strip, from, columns, { per }) {
  const [low, high] = strip.extent(from, columns);
  const room = 0.08 * (high - low) || 1 / per;
  return { min: low < 0 ? low - room : 0, max: high > 0 ? high + room : room };
}

/** Returns the decades that contain the step times. @param {Strip} strip */
function logRange(strip) {
  let low = Infinity, high = 0;
  for (let i = 0; i < strip.length; i++) {
    low = Math.min(low, strip.at(1, i) || strip.at(2, i));
    high = Math.max(high, strip.at(2, i));
  }
  if (!(high > 0)) return { min: 0.1, max: 100 };
  return { min: 10 ** Math.floor(Math.log10(Math.max(low, 1e-3))), max: 10 ** Math.ceil(Math.log10(high) + 1e-9) };
}

/** Returns an axis in the colours of the page. @param {object} options */
const axis = (options) => ({
  stroke: () => colors.muted,
  grid: { stroke: () => colors.grid, width: 1 },
  ticks: { show: false },
  font: `${Math.round(0.79 * parseFloat(getComputedStyle(document.documentElement).fontSize))}px system-ui, sans-serif`,
  ...options,
});

/**
 * Returns the range of a vertical axis, which uPlot asks for as long as it has no data, also where the range is set.
 * @param {UPlot} _plot @param {number | null} min @param {number | null} max
 */
const yRange = (_plot, min, max) => [min ?? 0, max ?? 1];

/**
 * Makes a chart in the element with this id, of the same size.
 * @param {string} id @param {number} columns @param {UPlotSeries[]} series @param {object} y options of the scale
 * @param {object} yAxis
 */
function plotIn(id, columns, series, y = {}, yAxis = {}) {
  const target = byId(id);
  const plot = new uPlot({
    width: Math.max(100, target.clientWidth), height: Math.max(80, target.clientHeight),
    legend: { show: false }, padding: [6, 14, 0, 0],
    cursor: {
      y: false, points: { show: false }, drag: { x: false, y: false, setScale: false },
      sync: { key: SHARED, scales: ["x", null] },
    },
    scales: { x: { time: false }, y: { auto: false, range: yRange, ...y } },
    axes: [axis({ size: 24, gap: 5, values: seconds }), axis({ size: 42, gap: 3, ...yAxis })],
    series: [{}, ...series],
  }, Array.from({ length: columns }, () => []), target);
  new ResizeObserver(() => {
    const { clientWidth: width, clientHeight: height } = target;
    if (width > 0 && height > 0) plot.setSize({ width, height });
  }).observe(target);
  return plot;
}

/** Formats times at the ticks, with as many decimals as they need. @param {UPlot} _plot @param {number[]} ticks */
const seconds = (_plot, ticks) => {
  const step = ticks.length > 1 ? ticks[1] - ticks[0] : 1;
  let decimals = 0;
  while (decimals < 5 && Math.abs(step * 10 ** decimals - Math.round(step * 10 ** decimals)) > 1e-6) decimals++;
  return ticks.map((t, i) => t.toFixed(decimals) + (i === ticks.length - 1 ? " s" : ""));
};

/**
 * Formats values at the ticks of an axis, in a unit.
 * @param {() => import("./sizes.js").Unit} unit @returns {(plot: UPlot, ticks: number[]) => string[]}
 */
const inUnit = (unit) => (_plot, ticks) => ticks.map((tick) => {
  const value = Number((tick * unit().per).toPrecision(6));
  const text = String(value);
  return (text.length > ROOM ? value.toExponential().replace("+", "") : text).replaceAll("-", "−");
});

/** Plots N and T of a surface between the limits. @param {() => import("./sizes.js").Unit} unit */
function forcePlot(unit) {
  /** @param {"limit-static" | "limit-dynamic"} color @param {number[]} dash @returns {UPlotSeries} */
  const limit = (color, dash) => ({ stroke: () => colors[color], width: 1.2, dash, points: { show: false } });
  return plotIn("chart-forces", 7, [
    { stroke: () => colors.normal, width: 1.4, points: { show: false } },
    { stroke: () => colors.friction, width: 2, points: { show: false } },
    limit("limit-static", [6, 3]), limit("limit-static", [6, 3]),
    limit("limit-dynamic", [1.8, 2.6]), limit("limit-dynamic", [1.8, 2.6]),
    // Small as it is on the first screen, it has a tick below 0, too.
  ], {}, { values: inUnit(unit), space: TICK });
}

/** Plots a stem for every tick with a slip. @param {() => import("./sizes.js").Unit} unit */
function slipPlot(unit) {
  return plotIn("chart-slips", 2, [{
    stroke: () => colors.slip, width: 1.6, paths: stems,
    points: { show: true, size: 5, fill: () => colors.slip, stroke: () => colors.slip },
  }], {}, { values: inUnit(unit) });
}

/** Plots median and worst step time, on a logarithmic scale. */
function stepPlot() {
  return plotIn("chart-steps", 3, [
    { stroke: () => colors.body, width: 2.2, points: { show: false } },
    { stroke: () => colors.muted, width: 1.4, dash: [6, 3], points: { show: false } },
  ], { distr: 3, range: [0.1, 100] }, {
    values: decades, grid: { stroke: () => colors.grid, width: 1, filter: onlyDecades },
  });
}

/** Draws grid lines at powers of ten only. @param {UPlot} _plot @param {number[]} ticks */
const onlyDecades = (_plot, ticks) => ticks.map((value) => (isDecade(value) ? value : null));

/** Labels powers of ten only. @param {UPlot} _plot @param {(number | null)[]} ticks */
const decades = (_plot, ticks) =>
  ticks.map((value) => (value && isDecade(value) ? thousands(Number(value.toPrecision(1))) : null));

/** Returns a round number, short enough for its axis. @param {number} value */
const thousands = (value) => (value >= 1000 ? `${value / 1000}k` : String(value));

/** Returns true for a power of ten. @param {number} value */
const isDecade = (value) => Math.abs(Math.log10(value) - Math.round(Math.log10(value))) < 1e-6;

/** Draws lines from 0 up to the values. @param {UPlot} plot @param {number} series @param {number} from @param {number} to */
function stems(plot, series, from, to) {
  const stroke = new Path2D();
  const zero = plot.valToPos(0, "y", true);
  for (let i = from; i <= to; i++) {
    const x = plot.valToPos(plot.data[0][i], "x", true);
    stroke.moveTo(x, zero);
    stroke.lineTo(x, plot.valToPos(plot.data[series][i], "y", true));
  }
  return { stroke, fill: null };
}
