// Small helpers for the document: elements by name, text that is set only when it changes, numbers in words.

/**
 * The element of an id; it must be there.
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

/** Sets a text where it differs. @param {Element} element @param {string} text */
export function setText(element, text) {
  if (element.textContent !== text) element.textContent = text;
}

/**
 * A new SVG element.
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

/** A number takes no more places than this, its sign and point with it, so that it fits where there is room for it. */
const PLACES = 7;

/** A number with three digits that count, without an exponent where it can be read without. @param {number} value */
export function digits(value) {
  if (value === 0) return "0";
  if (!Number.isFinite(value)) return "–";
  const size = Math.abs(value);
  if (size < 1e-3 || size >= 999_999.5) return exponential(value);
  const text = size >= 99.95 ? value.toFixed(0) : value.toPrecision(3);
  return minus(text.length <= PLACES ? text : value.toPrecision(2));
}

/** A number with so many decimals, or fewer, or an exponent, where it is too long. @param {number} value @param {number} decimals */
export function fixed(value, decimals) {
  if (Math.abs(value) < 0.5 * 10 ** -decimals) return (0).toFixed(decimals);
  for (let some = decimals; some >= 0; some--) {
    const text = value.toFixed(some);
    if (text.length <= PLACES) return minus(text);
  }
  return exponential(value);
}

/** With an exponent, and three digits where there is room for them. @param {number} value */
function exponential(value) {
  const texts = [2, 1, 0].map((decimals) => value.toExponential(decimals).replace("+", ""));
  return minus(texts.find(({ length }) => length <= PLACES) ?? texts[2]);
}

/** Steps of a thousand. */
const PREFIXES = ["p", "n", "µ", "m", "", "k", "M", "G", "T"];
const PLAIN = PREFIXES.indexOf("");

/**
 * The unit, with its prefix, in which a size has one to three digits before its point.
 * @param {number} size in the unit without a prefix, > 0 @param {string} unit
 * @returns {import("./sizes.js").Unit}
 */
export function prefixed(size, unit) {
  const thousands = Math.floor(Math.log10(size) / 3 + 1e-9);
  const step = Math.min(PREFIXES.length - 1 - PLAIN, Math.max(-PLAIN, thousands));
  return { name: PREFIXES[PLAIN + step] + unit, per: 1000 ** -step };
}

/** A proper minus sign. @param {string} text */
const minus = (text) => text.replaceAll("-", "−");

/** A whole number with thin spaces between thousands. @param {number} value */
export const whole = (value) => String(Math.round(value)).replace(/\B(?=(\d{3})+$)/g, "\u2009");

/** A time in seconds, in the unit that fits. @param {number} seconds */
export function duration(seconds) {
  if (seconds < 1e-6) return `${digits(seconds * 1e9)} ns`;
  if (seconds < 1e-3) return `${digits(seconds * 1e6)} µs`;
  return seconds < 1 ? `${digits(seconds * 1e3)} ms` : `${digits(seconds)} s`;
}

/**
 * The value that a fraction of the samples does not exceed.
 * @param {readonly number[]} samples @param {number} fraction
 */
export function quantile(samples, fraction) {
  if (samples.length === 0) return NaN;
  const sorted = Float64Array.from(samples).sort();
  return sorted[Math.min(sorted.length - 1, Math.floor(fraction * sorted.length))];
}

/** True if the reader asked for less motion. */
const calm = window.matchMedia("(prefers-reduced-motion: reduce)");
export const reducedMotion = () => calm.matches;
