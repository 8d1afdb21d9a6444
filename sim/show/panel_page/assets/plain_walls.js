// Written by `make pages` from sim/process/ticks/walls.py.
/** @import { Walls } from "./plain_state.js" */

/**
 * By how much the gap at a wall grows where sparks have so many times the usual time for it: the cube root of that.
 * @param {number} time_ratio
 * @returns {number}
 */
export function side_gap_ratio(time_ratio) {
  return Math.exp(Math.log(time_ratio) / 3.0);
}

/**
 * Fill in (m,) by how much the gap is wider in each stretch of path, µm; 0 where nothing was cut.
 * @param {Walls} walls
 * @param {Float64Array} along_um
 * @param {Float64Array} lit_s
 * @param {Float64Array} wider_um
 * @returns {void}
 */
export function widen(walls, along_um, lit_s, wider_um) {
  const count = lit_s.length;
  let row = 0;
  const last = walls.usual_s.length - 1;
  for (let at = 0; at < count; at += 1) {
    while ((row < last) && ((at * walls.stretch_um) >= along_um[row + 1])) {
      row += 1;
    }
    const low = Math.max(at - walls.half, 0);
    const high = Math.min((at + walls.half) + 1, count);
    let seconds = 0.0;
    let cut = 0;
    for (let near = low; near < high; near += 1) {
      if (lit_s[near] > 0.0) {
        seconds += lit_s[near];
        cut += 1;
      }
    }
    wider_um[at] = 0.0;
    if ((walls.usual_s[row] > 0.0) && (cut > 0) && ((at * walls.stretch_um) >= walls.start_um[row])) {
      const times = (seconds / cut) / walls.usual_s[row];
      wider_um[at] = Math.max(walls.gap_um[row], 0.0) * (side_gap_ratio(times) - 1.0);
    }
  }
}
