// Written by `make pages` from sim/process/ticks/log.py.
import { mean_current, mean_voltage, place_um } from "./plain_gap.js";
import { ALL_GAP_UM, ALL_ON_US, ALL_OPEN_US, ALL_SPARKS, AT, CURRENT_SUM, FAR_ROW, GAP_UM, HISTORY_ROWS, HISTORY_STRIDE, HISTORY_TICKS, LIVE_TICKS, LOGGED, ON_US, OPEN_US, ROW, SHORT_US, SPARKLESS_UNTIL, TICK_S, TICK_SPARKS, TICKS, VOLTAGE_SUM } from "./plain_state.js";
/** @import { Job } from "./plain_state.js" */

const _LOG_WIDTH = 4;

const _HISTORY_WIDTH = 4;

/**
 * Write a row of the log; those for which there is no room are counted alone.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} kind
 * @param {number} size
 * @returns {void}
 */
export function note(job, state, kind, size) {
  const log = job.records.log;
  const row = Math.trunc(Number(state[LOGGED])) * _LOG_WIDTH;
  state[LOGGED] += 1.0;
  if ((row + _LOG_WIDTH) > log.length) {
    return;
  }
  log[row] = state[TICKS] * TICK_S;
  log[row + 1] = state[AT];
  log[row + 2] = kind;
  log[row + 3] = size;
}

/**
 * Make one row of two of the history: half of its room is free again.
 * @param {Float64Array} state
 * @param {Float64Array} history
 * @returns {void}
 */
export function thin(state, history) {
  const rows = Math.floor(Math.trunc(Number(state[HISTORY_ROWS])) / 2);
  for (let row = 0; row < rows; row += 1) {
    const first = (2 * row) * _HISTORY_WIDTH;
    const to = row * _HISTORY_WIDTH;
    history[to] = history[first + 4];
    history[to + 1] = history[first + 5];
    history[to + 2] = (history[first + 2] + history[first + 6]) / 2.0;
    history[to + 3] = (history[first + 3] + history[first + 7]) / 2.0;
  }
  state[HISTORY_ROWS] = Number(rows);
  state[HISTORY_STRIDE] *= 2.0;
}

/**
 * Add a tick to the sums, and a row to the history where it is time for one.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {void}
 */
export function record(job, state) {
  const records = job.records;
  records.block_s[Math.trunc(Number(state[ROW]))] += TICK_S;
  if (job.way.width_um[Math.trunc(Number(state[FAR_ROW]))] > 0.0) {
    if ((state[SHORT_US] === 0.0) && (state[TICKS] >= state[SPARKLESS_UNTIL])) {
      const at = Math.trunc(Number(place_um(job, state) / records.stretch_um[0]));
      records.lit_s[Math.min(at, records.lit_s.length - 1)] += TICK_S;
    }
    state[LIVE_TICKS] += 1.0;
    state[ALL_SPARKS] += state[TICK_SPARKS];
    state[ALL_OPEN_US] += state[OPEN_US];
    state[ALL_ON_US] += state[ON_US];
    state[ALL_GAP_UM] += state[GAP_UM];
  }
  state[VOLTAGE_SUM] += mean_voltage(state);
  state[CURRENT_SUM] += mean_current(job, state);
  const stride = state[HISTORY_STRIDE];
  state[HISTORY_TICKS] += 1.0;
  if (state[HISTORY_TICKS] < stride) {
    return;
  }
  const history = records.history;
  const row = Math.trunc(Number(state[HISTORY_ROWS])) * _HISTORY_WIDTH;
  history[row] = state[TICKS] * TICK_S;
  history[row + 1] = state[AT];
  history[row + 2] = state[VOLTAGE_SUM] / stride;
  history[row + 3] = state[CURRENT_SUM] / stride;
  state[HISTORY_ROWS] += 1.0;
  state[HISTORY_TICKS] = 0.0;
  state[VOLTAGE_SUM] = 0.0;
  state[CURRENT_SUM] = 0.0;
  if ((row + (2 * _HISTORY_WIDTH)) > history.length) {
    thin(state, history);
  }
}
