// Written by `make pages` from sim/teach/plain/marks.py.
import { read_listing } from "./plain_blocks.js";
import { curve_of, with_axis_named } from "./plain_curves.js";
/** @import { Block } from "./plain_blocks.js" */
/** @import { Point } from "./plain_curves.js" */
/** @import { Task } from "./plain_tasks.js" */

/**
 * What of a block is right: whether it can be read, each of its words, its end, µm, and the share that is right.
 * @typedef {object} WordsMark
 * @property {boolean} is_read
 * @property {boolean} x
 * @property {boolean} y
 * @property {boolean} count_length
 * @property {boolean} axis
 * @property {boolean} sense
 * @property {Point} end
 * @property {number} share
 */

/**
 * @param {boolean} is_read
 * @param {boolean} x
 * @param {boolean} y
 * @param {boolean} count_length
 * @param {boolean} axis
 * @param {boolean} sense
 * @param {Point} end
 * @param {number} share
 * @returns {WordsMark}
 */
export function WordsMark(is_read, x, y, count_length, axis, sense, end, share) {
  return { is_read, x, y, count_length, axis, sense, end, share };
}

/**
 * Mark of a block that was written for a task: a fifth for each of X, Y, J, G and Z.
 * @param {Task} task
 * @param {string} text
 * @returns {WordsMark}
 */
export function words_mark(task, text) {
  const listing = read_listing(text);
  if ((listing.blocks.length !== 1) || (listing.unread.length > 0)) {
    return WordsMark(false, false, false, false, false, false, task.start, 0.0);
  }
  const right = task.block;
  const block = with_axis_named(listing.blocks[0]);
  const is_ratio = _are_alike(block, right);
  const x = is_ratio || (block.x === right.x);
  const y = is_ratio || (block.y === right.y);
  const sense = (block.turn === right.turn) && (block.quadrant === right.quadrant);
  const count = block.count_um === right.count_um;
  const axis = block.axis === right.axis;
  let wrong = 0;
  for (const is_right of [x, y, count, axis, sense]) {
    wrong += is_right ? 0 : 1;
  }
  return WordsMark(true, x, y, count, axis, sense, curve_of(block, task.start).end, (5 - wrong) / 5);
}

/**
 * Whether two lines have the same ratio X:Y.
 * @param {Block} block
 * @param {Block} right
 * @returns {boolean}
 */
function _are_alike(block, right) {
  const are_lines = (right.turn === 0) && (block.turn === 0) && ((block.x + block.y) > 0);
  return are_lines && ((block.x * right.y) === (block.y * right.x));
}
