// Written by `make pages` from sim/teach/plain/stepping.py.
import { is_endless, with_axis_named } from "./plain_curves.js";
/** @import { Block } from "./plain_blocks.js" */

const _SIGN_X = [0, 1, -1, -1, 1];

const _SIGN_Y = [0, 1, 1, -1, -1];

/**
 * Where a block stands.
 * @typedef {object} Stepper
 * @property {number} x
 * @property {number} y
 * @property {number} deviation
 * @property {number} count_left
 */

/**
 * @param {number} x
 * @param {number} y
 * @param {number} deviation
 * @param {number} count_left
 * @returns {Stepper}
 */
export function Stepper(x, y, deviation, count_left) {
  return { x, y, deviation, count_left };
}

/**
 * A step: by 1 µm along X or along Y.
 * @typedef {object} Way
 * @property {number} x
 * @property {number} y
 */

/**
 * @param {number} x
 * @param {number} y
 * @returns {Way}
 */
export function Way(x, y) {
  return { x, y };
}

/**
 * A block that begins; with nothing left to count where no controller can count it out.
 * @param {Block} block
 * @returns {Stepper}
 */
export function begun(block) {
  const count = is_endless(block) ? 0 : block.count_um;
  if (block.turn === 0) {
    return Stepper(0, 0, 0, count);
  }
  return Stepper(_SIGN_X[block.quadrant] * block.x, _SIGN_Y[block.quadrant] * block.y, 0, count);
}

/**
 * The next step of a block.
 * @param {Block} block
 * @param {Stepper} stepper
 * @returns {Way}
 */
export function next_way(block, stepper) {
  if (block.turn === 0) {
    const first_is_x = (block.quadrant % 2) === 1;
    if ((stepper.deviation >= 0) === first_is_x) {
      return Way(_SIGN_X[block.quadrant], 0);
    }
    return Way(0, _SIGN_Y[block.quadrant]);
  }
  return _way_on_arc(block.turn, motion_quadrant(block.turn, stepper.x, stepper.y), stepper.deviation >= 0);
}

/**
 * Quadrant of the motion on an arc at a place, from its centre; on an axis it is the one that is entered.
 * @param {number} turn
 * @param {number} x
 * @param {number} y
 * @returns {number}
 */
export function motion_quadrant(turn, x, y) {
  return (turn > 0) ? _entered(x, y) : (5 - _entered(x, -y));
}

/**
 * Quadrant that is entered counter-clockwise.
 * @param {number} x
 * @param {number} y
 * @returns {number}
 */
function _entered(x, y) {
  if ((x > 0) && (y >= 0)) {
    return 1;
  }
  if ((x <= 0) && (y > 0)) {
    return 2;
  }
  return ((x < 0) && (y <= 0)) ? 3 : 4;
}

/**
 * The table of docs/3b.md: toward the centre where F ≥ 0, away from it else.
 * @param {number} turn
 * @param {number} quadrant
 * @param {boolean} is_outside
 * @returns {Way}
 */
function _way_on_arc(turn, quadrant, is_outside) {
  const steps_x_inward = ((quadrant % 2) === 1) === (turn > 0);
  if (steps_x_inward) {
    return is_outside ? Way(-_SIGN_X[quadrant], 0) : Way(0, _SIGN_Y[quadrant]);
  }
  return is_outside ? Way(0, -_SIGN_Y[quadrant]) : Way(_SIGN_X[quadrant], 0);
}

/**
 * A block after its next step.
 * @param {Block} block
 * @param {Stepper} stepper
 * @returns {Stepper}
 */
export function stepped(block, stepper) {
  const way = next_way(block, stepper);
  const x = stepper.x + way.x;
  const y = stepper.y + way.y;
  const left = stepper.count_left - ((block.axis === 0) ? Math.abs(way.x) : Math.abs(way.y));
  if (block.turn === 0) {
    const named = with_axis_named(block);
    const gained = (way.x !== 0) ? (-named.y) : named.x;
    return Stepper(x, y, stepper.deviation + (((block.quadrant % 2) === 1) ? gained : (-gained)), left);
  }
  const change = (2 * ((way.x * stepper.x) + (way.y * stepper.y))) + 1;
  return Stepper(x, y, stepper.deviation + change, left);
}

/**
 * A block after so many steps, or where it ends before.
 * @param {Block} block
 * @param {number} steps
 * @returns {Stepper}
 */
export function after_steps(block, steps) {
  let stepper = begun(block);
  for (let _ = 0; _ < steps; _ += 1) {
    if (stepper.count_left <= 0) {
      return stepper;
    }
    stepper = stepped(block, stepper);
  }
  return stepper;
}
