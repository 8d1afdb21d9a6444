// What lies between two places that a measure took hold of: how far, along the path, across; and an arc by itself.

/** @import { Curves } from "../../replay/assets/document.js" */
/** @import { Snap } from "./snap.js" */

/** @typedef {[name: string, value: number, unit: "mm" | "°"]} Measure Its name in the page's words, and its value. */

const PARALLEL_RAD = 1e-6;
const SAME_UM = 1; // centres of arcs about one centre, as whole µm place them
const DEGREE = Math.PI / 180;

/**
 * How far along its block a place lies, µm from the block's start.
 * @param {Curves & { length_um: number[] }} path
 * @param {Snap} snap
 */
function alongBlock(path, { x, y, row }) {
  if (path.kind[row] !== "arc") return Math.hypot(x - path.place_x_um[row], y - path.place_y_um[row]);
  const angle = Math.atan2(y - path.center_y_um[row], x - path.center_x_um[row]);
  const [start, sweep, turn] = [path.start_angle_rad[row], path.sweep_rad[row], 2 * Math.PI];
  const turned = ((((angle - start) * Math.sign(sweep)) % turn) + turn) % turn;
  const isEnd = Math.hypot(x - path.place_x_um[row + 1], y - path.place_y_um[row + 1]) < 1e-3;
  if (isEnd && Math.abs(sweep) > turn / 2) return path.length_um[row]; // of a whole circle the start is the end
  return path.radius_um[row] * (turned > Math.abs(sweep) + 1e-9 ? 0 : turned);
}

/**
 * Length of the path between two places on it; null where the wire is taken out between them, or one is not on it.
 * @param {Curves & { length_um: number[] }} path
 * @param {Snap} a
 * @param {Snap} b
 */
function along(path, a, b) {
  if ([a, b].some((snap) => snap.row < 0 || snap.kind === "center" || path.kind[snap.row] === "jump")) return null;
  const [first, last] = a.row <= b.row ? [a, b] : [b, a];
  let length = alongBlock(path, last) - alongBlock(path, first);
  for (let row = first.row; row < last.row; row++) {
    if (path.kind[row] === "jump") return null;
    length += path.length_um[row];
  }
  return Math.abs(length);
}

/**
 * Width between two parallel lines, or two arcs about one centre; null of others.
 * @param {Curves} path
 * @param {Snap} a
 * @param {Snap} b
 */
function across(path, a, b) {
  if (a.row < 0 || b.row < 0 || a.row === b.row) return null;
  const isArc = [a, b].map((snap) => path.kind[snap.row] === "arc");
  if (isArc[0] !== isArc[1]) return null;
  if (isArc[0]) {
    const apart = Math.hypot(
      path.center_x_um[a.row] - path.center_x_um[b.row], path.center_y_um[a.row] - path.center_y_um[b.row],
    );
    return apart < SAME_UM ? Math.abs(path.radius_um[a.row] - path.radius_um[b.row]) : null;
  }
  const [one, other] = [a, b].map(({ row }) => Math.atan2(
    path.place_y_um[row + 1] - path.place_y_um[row], path.place_x_um[row + 1] - path.place_x_um[row],
  ));
  if (Math.abs(Math.sin(one - other)) > PARALLEL_RAD) return null;
  const [dx, dy] = [path.place_x_um[b.row] - path.place_x_um[a.row], path.place_y_um[b.row] - path.place_y_um[a.row]];
  const width = Math.abs(dx * Math.sin(one) - dy * Math.cos(one));
  return width > SAME_UM ? width : null; // one line, which two blocks lie on
}

/**
 * An arc by itself.
 * @param {Curves} path
 * @param {Snap} snap
 * @returns {Measure[]}
 */
export function ofArc(path, { row }) {
  if (row < 0 || path.kind[row] !== "arc") return [];
  return [
    ["radius", path.radius_um[row], "mm"], ["diameter", 2 * path.radius_um[row], "mm"],
    ["center-x", path.center_x_um[row], "mm"], ["center-y", path.center_y_um[row], "mm"],
    ["sweep", path.sweep_rad[row] / DEGREE, "°"],
  ];
}

/**
 * What lies between two places.
 * @param {Curves & { length_um: number[] }} path
 * @param {Snap} a
 * @param {Snap} b
 * @returns {Measure[]}
 */
export function between(path, a, b) {
  const [dx, dy] = [b.x - a.x, b.y - a.y];
  /** @type {Measure[]} */
  const found = [
    ["distance", Math.hypot(dx, dy), "mm"], ["delta-x", dx, "mm"], ["delta-y", dy, "mm"],
    ["angle", Math.atan2(dy, dx) / DEGREE, "°"],
  ];
  const [way, width] = [along(path, a, b), across(path, a, b)];
  if (way !== null) found.push(["along", way, "mm"]);
  if (width !== null) found.push(["across", width, "mm"]);
  return found;
}
