// Which blocks of two versions are not in the other one: by where their curves lie, whatever their text and their order.
import { pathOf } from "../../replay/assets/path.js";

/** @import { Path } from "./data.js" */

/**
 * A path and its rows that the other one has not.
 * @typedef {object} Different
 * @property {ReturnType<typeof pathOf>} drawn
 * @property {number[]} rows
 */

/**
 * What tells a block from others: its kind, and its ends, centre and turn to 0.001 µm and 0.000001 rad.
 * @param {Path} path
 * @param {number} row
 */
function keyOf(path, row) {
  const um = [
    path.place_x_um[row], path.place_y_um[row], path.place_x_um[row + 1], path.place_y_um[row + 1],
    path.center_x_um[row], path.center_y_um[row],
  ].map((place) => Math.round(place * 1e3));
  return [path.kind[row], ...um, Math.round(path.sweep_rad[row] * 1e6)].join();
}

/** @param {Path} path */
const keysOf = (path) => path.kind.map((_, row) => keyOf(path, row));

/**
 * Rows of each path that the other has not; null for both where one is missing.
 * @param {Path | null} below
 * @param {Path | null} above
 * @returns {{ below: Different | null, above: Different | null }}
 */
export function differing(below, above) {
  if (!below || !above) return { below: null, above: null };
  const [was, is] = [keysOf(below), keysOf(above)];
  const [known, here] = [new Set(was), new Set(is)];
  return {
    below: { drawn: pathOf(below), rows: was.flatMap((key, row) => (here.has(key) ? [] : [row])) },
    above: { drawn: pathOf(above), rows: is.flatMap((key, row) => (known.has(key) ? [] : [row])) },
  };
}
