// Where a measure takes hold: ends, centres, tangents, feet of perpendiculars, else the path itself.
import { foot } from "../../replay/assets/nearest.js";

/** @import { Curves } from "../../replay/assets/document.js" */
/** @import { Path as Drawn } from "../../replay/assets/path.js" */

/**
 * A place that a measure takes hold of, µm, and the row that it belongs to; −1 where it is free.
 * @typedef {object} Snap
 * @property {"end" | "center" | "tangent" | "across" | "on" | "free"} kind
 * @property {number} x
 * @property {number} y
 * @property {number} row
 */

const TURN = 2 * Math.PI;
const SAME_UM = 1e-3; // farther inside a circle there is no tangent

/**
 * Whether the arc in a row passes an angle.
 * @param {Curves} path
 * @param {number} row
 * @param {number} angle
 */
function passes(path, row, angle) {
  const [start, sweep] = [path.start_angle_rad[row], path.sweep_rad[row]];
  const turned = ((((angle - start) * Math.sign(sweep)) % TURN) + TURN) % TURN;
  return turned <= Math.abs(sweep) + 1e-12 || TURN - turned < 1e-12;
}

/**
 * Places on the arc in a row at some angles, those that it passes.
 * @param {Curves} path
 * @param {number} row
 * @param {number[]} angles
 * @param {"tangent" | "across"} kind
 * @returns {Snap[]}
 */
function onArc(path, row, angles, kind) {
  const [x, y, radius] = [path.center_x_um[row], path.center_y_um[row], path.radius_um[row]];
  return angles.filter((angle) => passes(path, row, angle)).map((angle) => (
    { kind, x: x + radius * Math.cos(angle), y: y + radius * Math.sin(angle), row }
  ));
}

/**
 * Where lines from a place touch the arc in a row, and where they meet it at a right angle.
 * @param {Curves} path
 * @param {number} row
 * @param {Snap} from
 * @returns {Snap[]}
 */
function fromToArc(path, row, from) {
  const [dx, dy] = [from.x - path.center_x_um[row], from.y - path.center_y_um[row]];
  const far = Math.hypot(dx, dy);
  if (far < SAME_UM) return []; // from the centre all of it is at a right angle
  const toward = Math.atan2(dy, dx);
  const across = onArc(path, row, [toward, toward + Math.PI], "across");
  if (far <= path.radius_um[row] + SAME_UM) return across;
  const half = Math.acos(path.radius_um[row] / far);
  return [...across, ...onArc(path, row, [toward - half, toward + half], "tangent")];
}

/**
 * Where the line from a place meets the line in a row at a right angle, if it does.
 * @param {Curves} path
 * @param {number} row
 * @param {Snap} from
 * @returns {Snap[]}
 */
function fromToLine(path, row, from) {
  const [ax, ay] = [path.place_x_um[row], path.place_y_um[row]];
  const [ux, uy] = [path.place_x_um[row + 1] - ax, path.place_y_um[row + 1] - ay];
  const square = ux * ux + uy * uy;
  const share = square > 0 ? ((from.x - ax) * ux + (from.y - ay) * uy) / square : -1;
  return share >= 0 && share <= 1 ? [{ kind: "across", x: ax + share * ux, y: ay + share * uy, row }] : [];
}

/**
 * The places of a block that a measure may take hold of, but for its centre and the path itself.
 * @param {Curves} path
 * @param {number} row
 * @param {Snap | null} from where the measure begins
 * @returns {Snap[]}
 */
function ofBlock(path, row, from) {
  /** @type {Snap[]} */
  const ends = [row, row + 1].map((at) => ({ kind: "end", x: path.place_x_um[at], y: path.place_y_um[at], row }));
  if (!from || from.row === row) return ends;
  return [...ends, ...(path.kind[row] === "arc" ? fromToArc : fromToLine)(path, row, from)];
}

/**
 * The place that a measure takes hold of near a place.
 * @param {Curves} path
 * @param {Drawn} drawn
 * @param {[x: number, y: number]} place µm
 * @param {number} reach µm
 * @param {Snap | null} from where the measure begins; null for its first place
 * @returns {Snap}
 */
export function snapAt(path, drawn, [x, y], reach, from) {
  const rows = drawn.rowsNear(boxAbout(x, y, reach));
  /** @type {Snap[]} */
  const sharp = rows.flatMap((row) => ofBlock(path, row, from));
  for (let row = 0; row < path.kind.length; row++) { // a centre lies far from its arc
    if (path.kind[row] === "arc") sharp.push({ kind: "center", x: path.center_x_um[row], y: path.center_y_um[row], row });
  }
  /** @param {Snap} snap */
  const far = (snap) => Math.hypot(snap.x - x, snap.y - y);
  /** @param {Snap[]} snaps */
  const nearest = (snaps) => snaps.reduce((best, snap) => (far(snap) < far(best) ? snap : best));
  const held = sharp.filter((snap) => far(snap) <= reach);
  if (held.length) return nearest(held);
  const feet = rows.map((row) => {
    const [fx, fy] = foot(path, row, x, y);
    return /** @type {Snap} */ ({ kind: "on", x: fx, y: fy, row });
  }).filter((snap) => far(snap) <= reach);
  return feet.length ? nearest(feet) : { kind: "free", x, y, row: -1 };
}

/**
 * The row whose block is nearest to a place; -1 where none is near.
 * @param {Curves} path
 * @param {Drawn} drawn
 * @param {[x: number, y: number]} place µm
 * @param {number} reach µm
 */
export function rowAt(path, drawn, [x, y], reach) {
  let least = reach;
  let found = -1;
  for (const row of drawn.rowsNear(boxAbout(x, y, reach))) {
    const [fx, fy] = foot(path, row, x, y);
    const far = Math.hypot(fx - x, fy - y);
    if (far < least) [least, found] = [far, row];
  }
  return found;
}

/**
 * The box about a place.
 * @param {number} x
 * @param {number} y
 * @param {number} reach
 */
const boxAbout = (x, y, reach) => ({ left: x - reach, right: x + reach, bottom: y - reach, top: y + reach });
