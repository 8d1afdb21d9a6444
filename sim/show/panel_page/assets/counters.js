// X, Y, F and J left at any step of the path, by the stepper of lessons; states on the way shorten the next question.
import { begun, stepped } from "../../lesson_page/assets/plain_stepping.js";

/** @import { Block } from "../../lesson_page/assets/plain_blocks.js" */
/** @import { Stepper } from "../../lesson_page/assets/plain_stepping.js" */
/** @import { Panel } from "./data.js" */

const EVERY = 512;

/**
 * The counters of a program.
 * @param {Panel} panel
 */
export function newCounters({ words, starts_um }) {
  /** @param {number} row @returns {Block} */
  const blockOf = (row) => ({
    x: words.x_um[row], y: words.y_um[row], count_um: words.count_um[row], axis: words.axis[row], turn: words.turn[row],
    quadrant: words.quadrant[row], line: 0,
  });
  let known = { row: -1, block: blockOf(0), states: /** @type {Stepper[]} */ ([]), made: 0, stepper: begun(blockOf(0)) };

  /** @param {number} row */
  function enter(row) {
    const block = blockOf(row);
    const first = begun(block);
    known = { row, block, states: [first], made: 0, stepper: first };
  }

  /**
   * What the control has in its counters after so many steps of a row.
   * @param {number} row
   * @param {number} made
   */
  function at(row, made) {
    if (known.row !== row) enter(row);
    if (made < known.made) {
      const slot = Math.floor(made / EVERY);
      known.stepper = known.states[slot];
      known.made = slot * EVERY;
    }
    while (known.made < made) {
      known.stepper = stepped(known.block, known.stepper);
      known.made += 1;
      if (known.made % EVERY === 0) known.states[known.made / EVERY] = known.stepper;
    }
    const { x, y, deviation, count_left } = known.stepper;
    const [first] = known.states;
    const [start_x, start_y] = starts_um[row];
    return { x_um: start_x + x - first.x, y_um: start_y + y - first.y, deviation, count_left_um: count_left };
  }

  return { at };
}
