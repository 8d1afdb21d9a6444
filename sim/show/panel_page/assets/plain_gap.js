// Written by `make pages` from sim/process/ticks/gap.py.
import { mean_delay_us, random_normal, random_share } from "./plain_chance.js";
import { ARC_SHARE, AT, BUSY_US, CHIP_CLEAR_UM, CHIP_UM, CHIP_UNTIL, FAR_ROW, FAR_UM, FARTHEST, FRONT_UM, GAP_UM, ON_US, OPEN_US, REMOVED_UM3, ROW, SHORT_US, SPARKLESS_UNTIL, TICK_SPARKS, TICK_US, TICKS } from "./plain_state.js";
/** @import { Job } from "./plain_state.js" */

/**
 * Path in one step of a block, µm.
 * @param {Job} job
 * @param {number} row
 * @returns {number}
 */
export function step_um(job, row) {
  const steps = job.way.before[row + 1] - job.way.before[row];
  return Number((job.way.along_um[row + 1] - job.way.along_um[row]) / steps);
}

/**
 * Path from its start to a step in a block, µm.
 * @param {Job} job
 * @param {number} row
 * @param {number} at
 * @returns {number}
 */
export function path_to_um(job, row, at) {
  return Number(job.way.along_um[row] + ((at - job.way.before[row]) * step_um(job, row)));
}

/**
 * Path from its start to the wire, µm.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {number}
 */
export function place_um(job, state) {
  return path_to_um(job, Math.trunc(Number(state[ROW])), state[AT]);
}

/**
 * Find the gap at a place. Where nothing is cut, the front goes with the wire; so it does in a start hole.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} place
 * @returns {void}
 */
export function find_gap(job, state, place) {
  const far_row = Math.trunc(Number(state[FAR_ROW]));
  const is_threaded = (state[FARTHEST] === job.way.before[far_row]) && (job.way.thread_um[far_row] === job.way.along_um[far_row]);
  if (is_threaded || (job.way.width_um[far_row] <= 0.0)) {
    state[FRONT_UM] = Math.max(state[FRONT_UM], place + FAR_UM);
  }
  state[GAP_UM] = Math.min(state[FRONT_UM] - place, FAR_UM);
}

/**
 * Mean voltage of a tick, as a share of the open one: that of the open gap, less of an arc, none else.
 * @param {Float64Array} state
 * @returns {number}
 */
export function mean_voltage(state) {
  return Number((state[OPEN_US] + (ARC_SHARE * state[ON_US])) / TICK_US);
}

/**
 * Mean current of a tick, as a share of the most: that of a short, or of sparks without a delay.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {number}
 */
export function mean_current(job, state) {
  const most_on_us = (TICK_US * job.discharge.on_us) / (job.discharge.on_us + job.discharge.off_us);
  return (state[SHORT_US] > 0.0) ? 1.0 : Number(Math.min(state[ON_US] / most_on_us, 1.0));
}

/**
 * Whether the wire touches the work, or a chip that lies between; farther back than that the chip is washed out.
 * @param {Float64Array} state
 * @param {number} place
 * @returns {boolean}
 */
export function is_shorted(state, place) {
  if (state[TICKS] < state[CHIP_UNTIL]) {
    if (place > (state[CHIP_UM] - state[CHIP_CLEAR_UM])) {
      return true;
    }
    state[CHIP_UNTIL] = 0.0;
  }
  return Boolean(state[GAP_UM] <= 0.0);
}

/**
 * The sparks of one tick, at one place: what the control sees of them, and the front that recedes.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} place
 * @returns {void}
 */
export function let_spark(job, state, place) {
  state[OPEN_US] = 0.0;
  state[ON_US] = 0.0;
  state[SHORT_US] = 0.0;
  state[TICK_SPARKS] = 0.0;
  if (is_shorted(state, place)) {
    state[SHORT_US] = TICK_US;
    state[BUSY_US] = 0.0;
    return;
  }
  if (state[TICKS] < state[SPARKLESS_UNTIL]) {
    state[BUSY_US] = 0.0;
    return;
  }
  if (state[GAP_UM] >= FAR_UM) {
    state[OPEN_US] = TICK_US;
    state[BUSY_US] = 0.0;
    return;
  }
  spark_until(job, state, TICK_US);
}

/**
 * Sparks one by one up to the end of a tick, from where the pause of the last one ends.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} end_us
 * @returns {void}
 */
export function spark_until(job, state, end_us) {
  const discharge = job.discharge;
  const cycle_us = discharge.on_us + discharge.off_us;
  const face_um2 = job.way.width_um[Math.trunc(Number(state[FAR_ROW]))] * discharge.height_um;
  const deeper = (face_um2 > 0.0) ? (discharge.crater_um3 / face_um2) : 0.0;
  let at_us = state[BUSY_US];
  let gap = state[GAP_UM];
  let open_us = 0.0;
  let sparks = 0.0;
  while (at_us < end_us) {
    const delay = (-mean_delay_us(gap)) * Math.log(random_share(state));
    if ((at_us + delay) >= end_us) {
      open_us += end_us - at_us;
      at_us = end_us;
    } else {
      open_us += delay;
      sparks += 1.0;
      at_us += delay + cycle_us;
      gap = Math.min(gap + deeper, FAR_UM);
    }
  }
  state[BUSY_US] = at_us - end_us;
  state[OPEN_US] = open_us;
  state[ON_US] = sparks * discharge.on_us;
  state[TICK_SPARKS] = sparks;
  if ((sparks > 0.0) && (face_um2 > 0.0)) {
    take_craters(job, state, sparks, face_um2);
  }
}

/**
 * Take the craters of a tick off the front: their number is that of its sparks, their volume by chance.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} sparks
 * @param {number} face_um2
 * @returns {void}
 */
export function take_craters(job, state, sparks, face_um2) {
  const discharge = job.discharge;
  const spread = (discharge.spread_um3 * Math.sqrt(sparks)) * random_normal(state);
  const removed = Math.max((discharge.crater_um3 * sparks) + spread, 0.0);
  state[REMOVED_UM3] += removed;
  state[FRONT_UM] += removed / face_um2;
  state[GAP_UM] = Math.min(state[GAP_UM] + (removed / face_um2), FAR_UM);
}
