// Lengths and places in the words of a task.

/** @import { Point } from "./plain_curves.js" */

/**
 * A length in mm, to 1 µm, without zeros at its end.
 * @param {number} length_um
 */
export function mm(length_um) {
  const text = (Math.round(length_um) / 1000).toFixed(3).replace(/\.?0+$/, "");
  return text === "-0" ? "0" : text;
}

/**
 * A number with one digit behind the point at most.
 * @param {number} value
 */
export function short(value) {
  return String(Math.round(value * 10) / 10);
}

/**
 * Places of a curve as values of a text.
 * @param {Point} start
 * @param {Point} end
 * @param {Point} centre
 */
export function values(start, end, centre) {
  return { x0: mm(start.x), y0: mm(start.y), x1: mm(end.x), y1: mm(end.y), cx: mm(centre.x), cy: mm(centre.y) };
}
