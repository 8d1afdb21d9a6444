// What the time line tells apart: blocks that are wide enough, and groups of those that are not.
import { clamp, countUpTo } from "./numbers.js";

/** @import { Span } from "./span.js" */

/** @typedef {{ first: number, past: number, left: number, right: number }} Group Rows, from a px of the bar to another. */

const DENSE = 4; // px: blocks narrower than that are not told apart
const ROOM = 92; // px of a group, for the number of its blocks

/**
 * Blocks and groups that show in a span, in order: a block alone is a group of one row.
 * @param {ArrayLike<number>} border
 * @param {Span} span
 */
export function groupsIn(border, span) {
  const rows = border.length - 1;
  const first = clamp(countUpTo(border, span.since) - 1, 0, rows - 1);
  let past = clamp(countUpTo(border, span.until), first + 1, rows);
  while (past > first + 1 && past < rows && border[past - 1] >= span.until) past--;
  /** @type {Group[]} */
  const groups = [];
  let isDense = false; // the last group
  for (let row = first; row < past; row++) {
    const [left, right] = [span.toX(border[row]), span.toX(border[row + 1])];
    const isNarrow = right - left < DENSE;
    const last = groups[groups.length - 1];
    if (isDense && isNarrow && right - last.left <= ROOM) {
      last.past = row + 1;
      last.right = right;
    } else groups.push({ first: row, past: row + 1, left, right });
    isDense = isNarrow;
  }
  return groups;
}
