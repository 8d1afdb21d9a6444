// The ideal curve of a block: the place on it that is nearest to another one.

/** @import { Curves, Place } from "./document.js" */

const TURN = 2 * Math.PI;

/**
 * Nearest place on a line from (ax, ay) to (bx, by).
 * @param {number} ax
 * @param {number} ay
 * @param {number} bx
 * @param {number} by
 * @param {number} x
 * @param {number} y
 * @returns {Place}
 */
function onLine(ax, ay, bx, by, x, y) {
  const [ux, uy] = [bx - ax, by - ay];
  const square = ux * ux + uy * uy;
  const share = square > 0 ? ((x - ax) * ux + (y - ay) * uy) / square : 0;
  const within = Math.min(Math.max(share, 0), 1);
  return [ax + within * ux, ay + within * uy];
}

/**
 * Nearest place on the arc in a row.
 * @param {Curves} blocks
 * @param {number} row
 * @param {number} x
 * @param {number} y
 * @returns {Place}
 */
function onArc(blocks, row, x, y) {
  const [cx, cy] = [blocks.center_x_um[row], blocks.center_y_um[row]];
  const [start, sweep] = [blocks.start_angle_rad[row], blocks.sweep_rad[row]];
  const angle = Math.atan2(y - cy, x - cx);
  const turned = ((((angle - start) * Math.sign(sweep)) % TURN) + TURN) % TURN;
  const reach = Math.abs(sweep);
  if (turned <= reach) {
    const radius = blocks.radius_um[row];
    return [cx + radius * Math.cos(angle), cy + radius * Math.sin(angle)];
  }
  const at = turned - reach < TURN - turned ? row + 1 : row;
  return [blocks.place_x_um[at], blocks.place_y_um[at]];
}

/**
 * Nearest place on the ideal curve of the block in a row.
 * @param {Curves} blocks
 * @param {number} row
 * @param {number} x
 * @param {number} y
 * @returns {Place}
 */
export function foot(blocks, row, x, y) {
  const [px, py] = [blocks.place_x_um, blocks.place_y_um];
  if (blocks.kind[row] === "arc") return onArc(blocks, row, x, y);
  return onLine(px[row], py[row], px[row + 1], py[row + 1], x, y);
}
