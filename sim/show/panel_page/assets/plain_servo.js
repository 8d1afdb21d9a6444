// Written by `make pages` from sim/process/ticks/servo.py.
import { mean_voltage, path_to_um, place_um, step_um } from "./plain_gap.js";
import { AT, DUTY, FAR_ROW, FAR_UM, FARTHEST, FLOOR_UM, GAP_UM, NEXT_BY_STEP, OPEN_US, PROGRESS_TICK, RESET_UM_S, RESIDUE, RETREATED_UM, ROW, SET_SHARE, SHORT_US, SPARKLESS_UNTIL, TICK_S, TICK_SPARKS, TICK_US, TICKS, WINDOW } from "./plain_state.js";
/** @import { Job } from "./plain_state.js" */

const _ROUNDING_UM = 1e-06;

/**
 * A value, or the nearer of two bounds.
 * @param {number} value
 * @param {number} low
 * @param {number} high
 * @returns {number}
 */
export function within(value, low, high) {
  return Math.min(Math.max(value, low), high);
}

/**
 * Way along the path that the law makes of a tick, µm.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {number}
 */
export function way_of_law(job, state) {
  const servo = job.servo;
  if (servo.law === WINDOW) {
    if (state[OPEN_US] > (state[SET_SHARE] * TICK_US)) {
      return 1.0;
    }
    return (state[SHORT_US] > (0.5 * TICK_US)) ? (-5.0) : 0.0;
  }
  let off;
  if (servo.law === DUTY) {
    const most = TICK_US / (job.discharge.on_us + job.discharge.off_us);
    off = state[SET_SHARE] - Math.min(state[TICK_SPARKS] / most, 1.0);
  } else {
    off = mean_voltage(state) - state[SET_SHARE];
  }
  if (state[SHORT_US] > 0.0) {
    state[RESET_UM_S] = 0.0;
  } else if (state[GAP_UM] < FAR_UM) {
    const reset = state[RESET_UM_S] + (((servo.gain_um_s * off) * TICK_S) / servo.reset_s);
    state[RESET_UM_S] = within(reset, Math.max(servo.least_um_s, 0.0), servo.most_um_s);
  }
  return within((servo.gain_um_s * off) + state[RESET_UM_S], servo.least_um_s, servo.most_um_s) * TICK_S;
}

/**
 * Make the next step of the path.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {void}
 */
export function step_forward(job, state) {
  const before = job.way.before;
  const last = before.length - 2;
  state[AT] += 1.0;
  let row = Math.trunc(Number(state[ROW]));
  while ((row < last) && (state[AT] >= before[row + 1])) {
    row += 1;
  }
  state[ROW] = Number(row);
  if (state[AT] > state[FARTHEST]) {
    state[FARTHEST] = state[AT];
    state[FAR_ROW] = Number(row);
    state[PROGRESS_TICK] = state[TICKS];
  }
}

/**
 * Undo the last step of the path.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {void}
 */
export function step_back(job, state) {
  state[AT] -= 1.0;
  let row = Math.trunc(Number(state[ROW]));
  while ((row > 0) && (state[AT] < job.way.before[row])) {
    row -= 1;
  }
  state[ROW] = Number(row);
}

/**
 * The step at which something happens next, or the last one.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {number}
 */
export function next_stop(job, state) {
  const end = job.way.before[job.way.before.length - 1];
  const at = Math.trunc(Number(state[NEXT_BY_STEP]));
  if (at < job.events.by_step[0]) {
    return Number(Math.min(end, Math.max(job.events.at[at], state[AT])));
  }
  return Number(end);
}

/**
 * Go back by whole steps; whether the control stands at the end of its way back and would go on.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {boolean}
 */
export function go_back(job, state) {
  const far_row = Math.trunc(Number(state[FAR_ROW]));
  const far_um = path_to_um(job, far_row, state[FARTHEST]);
  const lowest_um = Math.max(far_um - job.servo.ring_um, job.way.thread_um[far_row], state[FLOOR_UM]) - _ROUNDING_UM;
  const here_um = place_um(job, state);
  while (state[RESIDUE] <= (-1.0)) {
    if ((state[AT] <= 0.0) || ((place_um(job, state) - step_um(job, Math.trunc(Number(state[ROW])))) < lowest_um)) {
      state[RESIDUE] = 0.0;
      return Boolean((state[SHORT_US] > 0.0) || (state[TICKS] < state[SPARKLESS_UNTIL]));
    }
    step_back(job, state);
    state[RESIDUE] += 1.0;
  }
  if (state[SHORT_US] > 0.0) {
    state[RETREATED_UM] += here_um - place_um(job, state);
  }
  return false;
}

/**
 * Move along the path by whole steps; whether the control wanted to go back farther than it can.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} way
 * @returns {boolean}
 */
export function move(job, state, way) {
  state[RESIDUE] += way / step_um(job, Math.trunc(Number(state[ROW])));
  while (state[RESIDUE] >= 1.0) {
    if (state[AT] >= next_stop(job, state)) {
      state[RESIDUE] = 0.0;
      return false;
    }
    step_forward(job, state);
    state[RESIDUE] -= 1.0;
  }
  return (state[RESIDUE] <= (-1.0)) ? go_back(job, state) : false;
}
