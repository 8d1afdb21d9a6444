// The ideal curve of a block: the place on it that is nearest to another one.

/** @import { Blocks, Place } from "./document.js" */

/** @typedef {{ foot: Place, beyond: number }} Foot Nearest place; `beyond` is −1 before the curve, 1 past it, else 0. */

const TURN = 2 * Math.PI;

/**
 * Nearest place on a line from (ax, ay) to (bx, by); `beyond` is −1 before it, 1 past it, else 0.
 * @param {number} ax
 * @param {number} ay
 * @param {number} bx
 * @param {number} by
 * @param {number} x
 * @param {number} y
 * @returns {Foot}
 */
function onLine(ax, ay, bx, by, x, y) {
  const [ux, uy] = [bx - ax, by - ay];
  const square = ux * ux + uy * uy;
  const share = square > 0 ? ((x - ax) * ux + (y - ay) * uy) / square : 0;
  const within = Math.min(Math.max(share, 0), 1);
  return { foot: [ax + within * ux, ay + within * uy], beyond: Math.sign(share - within) };
}

/**
 * Nearest place on the arc in a row.
 * @param {Blocks} blocks
 * @param {number} row
 * @param {number} x
 * @param {number} y
 * @returns {Foot}
 */
function onArc(blocks, row, x, y) {
  const [cx, cy] = [blocks.center_x_um[row], blocks.center_y_um[row]];
  const [start, sweep] = [blocks.start_angle_rad[row], blocks.sweep_rad[row]];
  const angle = Math.atan2(y - cy, x - cx);
  const turned = ((((angle - start) * Math.sign(sweep)) % TURN) + TURN) % TURN;
  const reach = Math.abs(sweep);
  if (turned <= reach) {
    const radius = blocks.radius_um[row];
    return { foot: [cx + radius * Math.cos(angle), cy + radius * Math.sin(angle)], beyond: 0 };
  }
  const pastEnd = turned - reach < TURN - turned;
  const at = pastEnd ? row + 1 : row;
  return { foot: [blocks.place_x_um[at], blocks.place_y_um[at]], beyond: pastEnd ? 1 : -1 };
}

/**
 * Nearest place on the ideal curve of the block in a row: {um, foot, row, beyond}.
 * @param {Blocks} blocks
 * @param {number} row
 * @param {number} x
 * @param {number} y
 */
export function nearest(blocks, row, x, y) {
  const [px, py] = [blocks.place_x_um, blocks.place_y_um];
  const found =
    blocks.kind[row] === "arc" ? onArc(blocks, row, x, y) : onLine(px[row], py[row], px[row + 1], py[row + 1], x, y);
  return { um: Math.hypot(x - found.foot[0], y - found.foot[1]), row, ...found };
}
