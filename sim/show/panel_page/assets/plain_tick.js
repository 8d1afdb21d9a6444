// Written by `make pages` from sim/process/ticks/tick.py.
import { begin_events, stand, tear_wire } from "./plain_events.js";
import { find_gap, let_spark, place_um } from "./plain_gap.js";
import { note, record } from "./plain_log.js";
import { move, way_of_law } from "./plain_servo.js";
import { AT, AT_ORIGIN, BREAKS_AGAIN, BREAKS_HERE, BROKEN, COLLIDED, CORNER_UNTIL, FARTHEST, FINISHED, HAND_UM, HOLD_UNTIL, IN_VAIN, IS_BY_HAND, LOST_TICKS, POWER_OUT, POWERLESS, PROGRESS_TICK, REMOVED_UM3, ROW, RUNNING, SHORT_TICKS, SHORTED, SINGLE_S, STALLED, STOPPED, TICK_S, TICKS, WIRE_OUT } from "./plain_state.js";
import { breaks, watch_short } from "./plain_watch.js";
/** @import { Job } from "./plain_state.js" */

const _STALL_TICKS = 600000.0;

const _MOST_BREAKS_HERE = 5.0;

/**
 * Way that a tick makes, µm: by hand, none while the feed is held, else by the law.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {number}
 */
export function way_of_tick(job, state) {
  if (state[IS_BY_HAND] > 0.0) {
    state[PROGRESS_TICK] = state[TICKS];
    return Number(state[HAND_UM]);
  }
  if (state[TICKS] < state[HOLD_UNTIL]) {
    state[LOST_TICKS] += 1.0;
    state[PROGRESS_TICK] = state[TICKS];
    return 0.0;
  }
  if (state[TICKS] < state[CORNER_UNTIL]) {
    state[PROGRESS_TICK] = state[TICKS];
    return 0.0;
  }
  return way_of_law(job, state);
}

/**
 * What a cut waits for: somebody to thread the wire, or to switch the power on; else `RUNNING`.
 * @param {Float64Array} state
 * @returns {number}
 */
export function waits_for(state) {
  if (state[AT_ORIGIN] > 0.0) {
    return COLLIDED;
  }
  if (state[WIRE_OUT] > 0.0) {
    return (state[BREAKS_HERE] >= _MOST_BREAKS_HERE) ? BREAKS_AGAIN : BROKEN;
  }
  return (state[POWER_OUT] > 0.0) ? POWERLESS : RUNNING;
}

/**
 * Stand at the end of a block: under sparks at a corner, without in single block.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} row
 * @returns {void}
 */
export function end_block(job, state, row) {
  state[CORNER_UNTIL] = state[TICKS] + Math.floor((job.way.wait_s[row] / TICK_S) + 0.5);
  if (state[SINGLE_S] > 0.0) {
    stand(state, state[SINGLE_S]);
  }
}

/**
 * Why the control stops by itself, `RUNNING` where it does not; by hand it goes where hands want.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {boolean} is_in_vain
 * @returns {number}
 */
export function alarm(job, state, is_in_vain) {
  if (state[IS_BY_HAND] > 0.0) {
    return RUNNING;
  }
  if (is_in_vain) {
    return IN_VAIN;
  }
  if ((state[SHORT_TICKS] * TICK_S) > job.bounds.short_s) {
    return SHORTED;
  }
  return ((state[TICKS] - state[PROGRESS_TICK]) > _STALL_TICKS) ? STALLED : RUNNING;
}

/**
 * One tick: what happens, sparks, what the control makes of them; `RUNNING`, or why it stops.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {number}
 */
export function tick(job, state) {
  begin_events(job, state);
  const waiting = waits_for(state);
  if (waiting !== RUNNING) {
    return waiting;
  }
  const place = place_um(job, state);
  find_gap(job, state, place);
  const removed = state[REMOVED_UM3];
  let_spark(job, state, place);
  watch_short(job, state);
  record(job, state);
  if (breaks(job, state, state[REMOVED_UM3] - removed)) {
    tear_wire(job, state);
    return (state[BREAKS_HERE] >= _MOST_BREAKS_HERE) ? BREAKS_AGAIN : waits_for(state);
  }
  const row = state[ROW];
  const is_in_vain = move(job, state, way_of_tick(job, state));
  state[TICKS] += 1.0;
  if ((state[ROW] > row) && (state[AT] === state[FARTHEST])) {
    end_block(job, state, Math.trunc(Number(row)));
  }
  return alarm(job, state, is_in_vain);
}

/**
 * Run so many ticks at most: `FINISHED` at the end of the path, else what the last tick came to.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} most
 * @returns {number}
 */
export function run_ticks(job, state, most) {
  const end = job.way.before[job.way.before.length - 1];
  for (let _ = 0; _ < most; _ += 1) {
    if (state[AT] >= end) {
      return FINISHED;
    }
    const came_to = tick(job, state);
    if (came_to !== RUNNING) {
      if (![BROKEN, POWERLESS].includes(came_to)) {
        note(job, state, STOPPED, Number(came_to));
      }
      return came_to;
    }
  }
  return RUNNING;
}
