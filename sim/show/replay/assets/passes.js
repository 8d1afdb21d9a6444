// Which pass over an edge each block belongs to.

/** @import { Pass, ReplayDocument } from "./document.js" */

/**
 * The pass of each row; null for a lead or a jump, and everywhere where every edge is cut once.
 * @param {ReplayDocument} doc
 * @returns {(Pass | null)[]}
 */
export function passOfRows({ blocks, passes }) {
  /** @type {(Pass | null)[]} */
  const found = blocks.kind.map(() => null);
  for (const pass of passes) found.fill(pass, pass.first_row, pass.last_row + 1);
  return found;
}
