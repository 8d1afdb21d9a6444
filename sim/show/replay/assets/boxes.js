// Boxes of the blocks of a path, and which of them come near a window.

/**
 * @import { Curves } from "./document.js"
 * @import { Box } from "./view.js"
 */

/** @typedef {ReturnType<typeof boxesOf>} Boxes */

const RUN = 128; // rows that share one box
const TURN = 2 * Math.PI;

/**
 * Angle from `start` on to `angle` in the sense of `sweep`, from 0 up to a turn.
 * @param {number} start
 * @param {number} angle
 * @param {number} sweep
 */
export function passed(start, angle, sweep) {
  const turn = (sweep > 0 ? angle - start : start - angle) % TURN;
  return turn < 0 ? turn + TURN : turn;
}

/**
 * Box of a block: left, bottom, right, top; an arc reaches each extreme that it passes.
 * @param {Curves} blocks
 * @param {number} row
 */
function boxOf(blocks, row) {
  const xs = [blocks.place_x_um[row], blocks.place_x_um[row + 1]];
  const ys = [blocks.place_y_um[row], blocks.place_y_um[row + 1]];
  if (blocks.kind[row] === "arc") {
    const [start, sweep, radius] = [blocks.start_angle_rad[row], blocks.sweep_rad[row], blocks.radius_um[row]];
    for (let quarter = 0; quarter < 4; quarter++) {
      if (passed(start, (quarter * Math.PI) / 2, sweep) > Math.abs(sweep)) continue;
      xs.push(blocks.center_x_um[row] + radius * [1, 0, -1, 0][quarter]);
      ys.push(blocks.center_y_um[row] + radius * [0, 1, 0, -1][quarter]);
    }
  }
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

/**
 * Box about some of the boxes, from `first` up to before `past`, of four numbers each.
 * @param {Float64Array} boxes
 * @param {number} first
 * @param {number} past
 */
function about(boxes, first, past) {
  const all = [Infinity, Infinity, -Infinity, -Infinity];
  for (let at = 4 * first; at < 4 * past; at += 4) {
    all[0] = Math.min(all[0], boxes[at]);
    all[1] = Math.min(all[1], boxes[at + 1]);
    all[2] = Math.max(all[2], boxes[at + 2]);
    all[3] = Math.max(all[3], boxes[at + 3]);
  }
  return all;
}

/**
 * Whether the box in a row comes near another one.
 * @param {Float64Array} boxes
 * @param {number} row
 * @param {Box} near
 */
function meets(boxes, row, near) {
  const at = 4 * row;
  return boxes[at] <= near.right && near.left <= boxes[at + 2] && boxes[at + 1] <= near.top && near.bottom <= boxes[at + 3];
}

/**
 * Boxes of the blocks of a path.
 * @param {Curves} blocks
 */
export function boxesOf(blocks) {
  const count = blocks.kind.length;
  const own = new Float64Array(4 * count);
  for (let row = 0; row < count; row++) own.set(boxOf(blocks, row), 4 * row);
  const runs = new Float64Array(4 * Math.ceil(count / RUN));
  for (let run = 0; run * RUN < count; run++) runs.set(about(own, run * RUN, Math.min(count, (run + 1) * RUN)), 4 * run);

  return {
    /**
     * Box of all blocks.
     * @returns {Box}
     */
    all() {
      const [left, bottom, right, top] = about(own, 0, count);
      return { left, bottom, right, top };
    },
    /**
     * Visit the rows of the blocks that come near a box, in order.
     * @param {Box} near
     * @param {(row: number) => void} visit
     */
    visitNear(near, visit) {
      for (let run = 0; run * RUN < count; run++) {
        if (!meets(runs, run, near)) continue;
        const past = Math.min(count, (run + 1) * RUN);
        for (let row = run * RUN; row < past; row++) if (meets(own, row, near)) visit(row);
      }
    },
    /**
     * Width or height of a block's box, the larger one.
     * @param {number} row
     */
    size: (row) => Math.max(own[4 * row + 2] - own[4 * row], own[4 * row + 3] - own[4 * row + 1]),
  };
}
