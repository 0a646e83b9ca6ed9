// Small helpers for the document: elements by id, text that is set only when it changes, formatted numbers.

/**
 * Returns the element with an id; it must exist.
 * @template {HTMLElement} T
 * @param {string} id
 * @param {{ new (): T }} [kind]
 * @returns {T}
 */
export function byId(id, kind) {
  const element = document.getElementById(id);
  if (!element || (kind && !(element instanceof kind))) throw new Error(`no element ${id}`);
  return /** @type {T} */ (element);
}

/** Sets a text if it differs. @param {Element} element @param {string} text */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/**
 * Makes an SVG element.
 * @param {string} name
 * @param {{[attribute: string]: string | number}} [attributes]
 * @param {(Node | string)[]} children
 */
export function svg(name, attributes = {}, ...children) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, String(value));
  element.append(...children);
  return element;
}

/** Most characters of a number, including sign and point, so that it fits into its place. */
const PLACES = 7;

/** Formats a number with three significant digits, without an exponent if it is readable. @param {number} value */
export function digits(value) {
  if (value === 0) return "0";
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 999_999.5) return exponential(value);
  const text = size >= 99.95 ? value.toFixed(0) : value.toPrecision(3);
  return minus(text.length <= PLACES ? text : value.toPrecision(2));
}

/**
 * Formats a number with a number of decimals; if it is too long, with fewer or with an exponent.
 * @param {number} value @param {number} decimals
 */
export function fixed(value, decimals) {
  if (Math.abs(value) < 0.5 * 10 ** -decimals) return (0).toFixed(decimals);
  for (let some = decimals; some >= 0; some--) {
    const text = value.toFixed(some);
    if (text.length <= PLACES) return minus(text);
  }
  return exponential(value);
}

/** Formats a number with an exponent, and with three digits if there is room. @param {number} value */
function exponential(value) {
  const texts = [2, 1, 0].map((decimals) => value.toExponential(decimals).replace("+", ""));
  return minus(texts.find(({ length }) => length <= PLACES) ?? texts[2]);
}

/** Prefixes of the powers of 1000. */
const PREFIXES = ["p", "n", "µ", "m", "", "k", "M", "G", "T"];
const PLAIN = PREFIXES.indexOf("");

/**
 * Returns the unit, with its prefix, in which a size has one to three digits before the point.
 * @param {number} size in the unit without a prefix, > 0 @param {string} unit
 * @returns {import("./sizes.js").Unit}
 */
export function prefixed(size, unit) {
  const thousands = Math.floor(Math.log10(size) / 3 + 1e-9);
  const step = Math.min(PREFIXES.length - 1 - PLAIN, Math.max(-PLAIN, thousands));
  return { name: PREFIXES[PLAIN + step] + unit, per: 1000 ** -step };
}

/** Replaces hyphens by proper minus signs. @param {string} text */
const minus = (text) => text.replaceAll("-", "−");

/** Formats a whole number with thin spaces between thousands. @param {number} value */
export const whole = (value) => String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, "\u2009");

/** Formats a time in seconds, in a suitable unit. @param {number} seconds */
export function duration(seconds) {
  if (seconds < 1e-6) return `${digits(seconds * 1e9)} ns`;
  if (seconds < 1e-3) return `${digits(seconds * 1e6)} µs`;
  return seconds < 1 ? `${digits(seconds * 1e3)} ms` : `${digits(seconds)} s`;
}

/**
 * Returns the value that a fraction of the samples does not exceed.
 * @param {readonly number[]} samples @param {number} fraction
 */
export function quantile(samples, fraction) {
  if (samples.length === 0) return NaN;
  const sorted = Float64Array.from(samples).sort();
  return sorted[Math.min(sorted.length - 1, Math.floor(fraction * sorted.length))];
}

/** True if the reader prefers reduced motion. */
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
export const reducedMotion = () => calm.matches;
