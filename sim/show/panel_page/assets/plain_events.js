// Written by `make pages` from sim/process/ticks/events.py.
import { place_um } from "./plain_gap.js";
import { note } from "./plain_log.js";
import { AREA_RATE, AT, AT_ORIGIN, BREAK, BREAK_UM, BREAKS, BREAKS_HERE, BUSY_US, CHIP_CLEAR_UM, CHIP_UM, CHIP_UNTIL, CHIPS, CHIPS_FACTOR, CHIPS_UNTIL, DRUM_OFF, DRUMLESS_UNTIL, FAR_ROW, FARTHEST, FLOOR_UM, FRONT_UM, HOLD_UNTIL, KNOB, LOST_TICKS, NEXT_BY_CUT, NEXT_BY_STEP, NEXT_BY_TIME, ORIGIN, PAUSE, POWER, POWER_OUT, PROGRESS_TICK, PUMP_OFF, PUMPLESS_UNTIL, RESET_UM_S, RESIDUE, ROW, SET_SHARE, SHORT, SINGLE, SINGLE_S, SKIP, SPARKLESS_UNTIL, SPARKS_OFF, STOOD_TICKS, TICK_S, TICKS, UNCOOLED_TICKS, WIRE_OUT } from "./plain_state.js";
/** @import { Job } from "./plain_state.js" */

const _SAME_PLACE_UM = 1000.0;

/**
 * Let time go by without sparks.
 * @param {Float64Array} state
 * @param {number} seconds
 * @returns {void}
 */
export function stand(state, seconds) {
  const ticks = Math.floor((seconds / TICK_S) + 0.5);
  state[TICKS] += ticks;
  state[STOOD_TICKS] += ticks;
  state[LOST_TICKS] += ticks;
  state[PROGRESS_TICK] = state[TICKS];
  state[BUSY_US] = 0.0;
  state[RESET_UM_S] = 0.0;
  state[RESIDUE] = 0.0;
}

/**
 * Thread a broken wire, in place or at the start, from where it goes through the slot again.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} is_from_start
 * @returns {void}
 */
export function thread_wire(job, state, is_from_start) {
  const back_um = place_um(job, state) - job.way.thread_um[Math.trunc(Number(state[ROW]))];
  stand(state, job.bounds.thread_s + (((2.0 * back_um) * is_from_start) / job.bounds.jog_um_s));
  if (job.bounds.is_manned === 0.0) {
    state[PUMPLESS_UNTIL] = 0.0;
    state[DRUMLESS_UNTIL] = 0.0;
  }
  state[UNCOOLED_TICKS] = 0.0;
  state[AREA_RATE] = 0.0;
  state[WIRE_OUT] = 0.0;
  state[AT_ORIGIN] = 0.0;
}

/**
 * Let the wire break: it is threaded at once, or waits for somebody who does it.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {void}
 */
export function tear_wire(job, state) {
  note(job, state, BREAK, 0.0);
  state[BREAKS] += 1.0;
  const place = place_um(job, state);
  const is_here = (state[BREAKS_HERE] > 0.0) && ((place - state[BREAK_UM]) < _SAME_PLACE_UM);
  state[BREAKS_HERE] = is_here ? (state[BREAKS_HERE] + 1.0) : 1.0;
  state[BREAK_UM] = (state[BREAKS_HERE] === 1.0) ? place : state[BREAK_UM];
  state[WIRE_OUT] = 1.0;
  if ((job.bounds.is_manned + job.bounds.is_reversed) === 0.0) {
    thread_wire(job, state, job.bounds.is_from_start);
  }
}

/**
 * Go on after a power loss: at the step where it came, or at the begin of the block.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} remembers
 * @returns {void}
 */
export function restart(job, state, remembers) {
  stand(state, job.bounds.restart_s);
  state[POWER_OUT] = 0.0;
  if (remembers === 0.0) {
    state[AT] = job.way.before[Math.trunc(Number(state[ROW]))];
  }
}

/**
 * Let the power fail, and wait for somebody who switches it on.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {void}
 */
export function cut_power(job, state) {
  note(job, state, POWER, 1.0);
  state[POWER_OUT] = 1.0;
}

/**
 * Leave out the rest of a block: the control counts from where it stands, and the wire cuts on from there.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {void}
 */
export function skip_block(job, state) {
  let row = Math.trunc(Number(state[ROW]));
  const gap_um = state[FRONT_UM] - place_um(job, state);
  state[AT] = job.way.before[row + 1];
  state[FARTHEST] = state[AT];
  row = Math.min(row + 1, job.way.before.length - 2);
  state[ROW] = Number(row);
  state[FAR_ROW] = Number(row);
  state[FLOOR_UM] = place_um(job, state);
  state[FRONT_UM] = state[FLOOR_UM] + gap_um;
  state[RESIDUE] = 0.0;
}

/**
 * Turn a switch or the knob, or let chips gather, until a tick.
 * @param {Float64Array} state
 * @param {number} kind
 * @param {number} until
 * @param {number} size
 * @returns {void}
 */
export function turn_switch(state, kind, until, size) {
  if (kind === CHIPS) {
    state[CHIPS_UNTIL] = until;
    state[CHIPS_FACTOR] = size;
  } else if (kind === PAUSE) {
    state[HOLD_UNTIL] = until;
  } else if (kind === SPARKS_OFF) {
    state[SPARKLESS_UNTIL] = until;
  } else if (kind === PUMP_OFF) {
    state[PUMPLESS_UNTIL] = until;
  } else if (kind === DRUM_OFF) {
    state[DRUMLESS_UNTIL] = until;
  } else if (kind === KNOB) {
    state[SET_SHARE] = size;
  } else if (kind === SINGLE) {
    state[SINGLE_S] = size;
  }
}

/**
 * Begin one of the events.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} at
 * @returns {void}
 */
export function begin_event(job, state, at) {
  const kind = job.events.kind[at];
  const size = job.events.size[at];
  const seconds = job.events.for_s[at];
  const until = state[TICKS] + Math.floor((seconds / TICK_S) + 0.5);
  if (kind === BREAK) {
    tear_wire(job, state);
    return;
  }
  if (kind === SHORT) {
    state[CHIP_UM] = place_um(job, state);
    state[CHIP_CLEAR_UM] = size;
    state[CHIP_UNTIL] = until;
    return;
  }
  if (kind === POWER) {
    cut_power(job, state);
    if (job.bounds.is_manned === 0.0) {
      restart(job, state, size);
    }
    return;
  }
  note(job, state, kind, size);
  if (kind === SKIP) {
    skip_block(job, state);
  } else if (kind === ORIGIN) {
    state[AT_ORIGIN] = 1.0;
    state[WIRE_OUT] = 1.0;
  } else {
    turn_switch(state, kind, until, size);
  }
}

/**
 * Begin what happens at this step, at this time, and after so much time of cutting.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {void}
 */
export function begin_events(job, state) {
  const events = job.events;
  const by_step = Math.trunc(Number(events.by_step[0]));
  const by_time = by_step + Math.trunc(Number(events.by_time[0]));
  while ((state[NEXT_BY_STEP] < by_step) && (events.at[Math.trunc(Number(state[NEXT_BY_STEP]))] <= state[AT])) {
    state[NEXT_BY_STEP] += 1.0;
    begin_event(job, state, Math.trunc(Number(state[NEXT_BY_STEP])) - 1);
  }
  while (((by_step + state[NEXT_BY_TIME]) < by_time) && (events.at[by_step + Math.trunc(Number(state[NEXT_BY_TIME]))] <= state[TICKS])) {
    state[NEXT_BY_TIME] += 1.0;
    begin_event(job, state, (by_step + Math.trunc(Number(state[NEXT_BY_TIME]))) - 1);
  }
  const rest = events.at.length - by_time;
  while ((state[NEXT_BY_CUT] < rest) && (events.at[by_time + Math.trunc(Number(state[NEXT_BY_CUT]))] <= (state[TICKS] - state[STOOD_TICKS]))) {
    state[NEXT_BY_CUT] += 1.0;
    begin_event(job, state, (by_time + Math.trunc(Number(state[NEXT_BY_CUT]))) - 1);
  }
}
