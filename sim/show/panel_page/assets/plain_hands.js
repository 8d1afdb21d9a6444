// Written by `make pages` from sim/process/ticks/hands.py.
import { restart, thread_wire } from "./plain_events.js";
import { place_um } from "./plain_gap.js";
import { BREAKS, BREAKS_HERE, DRUMLESS_UNTIL, FINISHED, HAND_UM, IS_BY_HAND, POWER_OUT, PROGRESS_TICK, PUMPLESS_UNTIL, RUNNING, SET_SHARE, SHORT_TICKS, SHORTS, SPARKLESS_UNTIL, TICKS, WIRE_OUT } from "./plain_state.js";
import { run_ticks } from "./plain_tick.js";
/** @import { Job } from "./plain_state.js" */

export const KNOB_UP = 0;

export const KNOB_DOWN = 1;

export const PUMP_ON = 2;

export const DRUM_ON = 3;

export const GENERATOR_ON = 4;

export const GO_BACK = 5;

export const THREAD_HERE = 6;

export const THREAD_AT_START = 7;

export const POWER_ON = 8;

export const BEGIN_BLOCK_AGAIN = 9;

export const CLEAR_ALARM = 10;

export const GOES_ON = 0;

export const STANDS = 1;

export const BREAKS_THEN = 2;

export const SHORTS_THEN = 3;

export const TOO_SLOW = 4;

const _KNOB = 0.3;

const _LEAST_SHARE = 0.02;

const _MOST_SHARE = 0.9;

const _HAND_UM = -0.3;

const _HAND_TICKS = 1000;

const _BETWEEN_TICKS = 2000;

const _THEN_TICKS = 20000;

const _FEW_SHORTS = 1.0;

/**
 * Turn the set value by a share of the open voltage.
 * @param {Float64Array} state
 * @param {number} by
 * @returns {void}
 */
export function turn_knob(state, by) {
  state[SET_SHARE] = Math.min(Math.max(state[SET_SHARE] + by, _LEAST_SHARE), _MOST_SHARE);
}

/**
 * Let the control forget what it stopped for.
 * @param {Float64Array} state
 * @returns {void}
 */
export function clear_alarm(state) {
  state[SHORT_TICKS] = 0.0;
  state[BREAKS_HERE] = 0.0;
  state[PROGRESS_TICK] = state[TICKS];
}

/**
 * Switch pump, wire drum or generator on.
 * @param {Float64Array} state
 * @param {number} action
 * @returns {void}
 */
export function switch_on(state, action) {
  if (action === PUMP_ON) {
    state[PUMPLESS_UNTIL] = 0.0;
  } else if (action === DRUM_ON) {
    state[DRUMLESS_UNTIL] = 0.0;
  } else {
    state[SPARKLESS_UNTIL] = 0.0;
  }
}

/**
 * Thread a wire that is broken, switch a power on that failed; nothing where neither is so.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} action
 * @returns {void}
 */
export function see_to(job, state, action) {
  if ([THREAD_HERE, THREAD_AT_START].includes(action)) {
    if (state[WIRE_OUT] > 0.0) {
      thread_wire(job, state, (action === THREAD_AT_START) ? 1.0 : 0.0);
    }
  } else if (state[POWER_OUT] > 0.0) {
    restart(job, state, (action === POWER_ON) ? 1.0 : 0.0);
  }
}

/**
 * One thing that hands do; back by hand for a second.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} action
 * @returns {void}
 */
export function act(job, state, action) {
  if (action === KNOB_UP) {
    turn_knob(state, _KNOB);
  } else if (action === KNOB_DOWN) {
    turn_knob(state, -_KNOB);
  } else if (action === GO_BACK) {
    state[IS_BY_HAND] = 1.0;
    state[HAND_UM] = _HAND_UM;
    run_ticks(job, state, _HAND_TICKS);
    state[IS_BY_HAND] = 0.0;
  } else if ([THREAD_HERE, THREAD_AT_START, POWER_ON, BEGIN_BLOCK_AGAIN].includes(action)) {
    see_to(job, state, action);
  } else if (action === CLEAR_ALARM) {
    clear_alarm(state);
  } else {
    switch_on(state, action);
  }
}

/**
 * What a cut comes to after actions in their order, two seconds apart, in the twenty seconds behind the last.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {Float64Array} actions
 * @param {number} least_um
 * @returns {number}
 */
export function judge(job, state, actions, least_um) {
  for (let at = 0; at < actions.length; at += 1) {
    act(job, state, Math.trunc(Number(actions[at])));
    run_ticks(job, state, _BETWEEN_TICKS);
  }
  const breaks = state[BREAKS];
  const shorts = state[SHORTS];
  const place = place_um(job, state);
  const came_to = run_ticks(job, state, _THEN_TICKS);
  if (state[BREAKS] > breaks) {
    return BREAKS_THEN;
  }
  if (![RUNNING, FINISHED].includes(came_to)) {
    return STANDS;
  }
  if (state[SHORTS] > (shorts + _FEW_SHORTS)) {
    return SHORTS_THEN;
  }
  if ((came_to === RUNNING) && ((place_um(job, state) - place) < least_um)) {
    return TOO_SLOW;
  }
  return GOES_ON;
}
