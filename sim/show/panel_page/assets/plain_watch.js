// Written by `make pages` from sim/process/ticks/watch.py.
import { note } from "./plain_log.js";
import { AREA_RATE, AREA_UM2, AT, CHIPS_FACTOR, CHIPS_UNTIL, CLEARED, DRUMLESS_UNTIL, FAR_ROW, FARTHEST, IS_SHORT, LOST_TICKS, PUMPLESS_UNTIL, SHORT, SHORT_AT, SHORT_TICKS, SHORT_US, SHORTS, TICK_S, TICK_SPARKS, TICKS, UNCOOLED_TICKS } from "./plain_state.js";
/** @import { Job } from "./plain_state.js" */

const _SHORT_TICKS = 10;

const _AREA_SMOOTH = 0.002;

const _UNCOOLED_MOST = 1000.0;

const _STANDING_MOST = 500.0;

/**
 * Count the ticks of a short. One that lasts is noted, and so is its end; what it costs ends where it began.
 * @param {Job} job
 * @param {Float64Array} state
 * @returns {void}
 */
export function watch_short(job, state) {
  if (state[SHORT_US] > 0.0) {
    state[SHORT_TICKS] += 1.0;
    if ((state[SHORT_TICKS] === _SHORT_TICKS) && (state[IS_SHORT] === 0.0)) {
      state[IS_SHORT] = 1.0;
      state[SHORT_AT] = state[FARTHEST];
      state[SHORTS] += 1.0;
      state[LOST_TICKS] += _SHORT_TICKS - 1.0;
      note(job, state, SHORT, 0.0);
    }
  } else {
    state[SHORT_TICKS] = 0.0;
    if (state[IS_SHORT] === 1.0) {
      state[IS_SHORT] = 2.0;
      note(job, state, CLEARED, state[SHORT_AT] - state[AT]);
    }
  }
  if ((state[IS_SHORT] === 2.0) && (state[AT] >= state[SHORT_AT])) {
    state[IS_SHORT] = 0.0;
  }
  if (state[IS_SHORT] > 0.0) {
    state[LOST_TICKS] += 1.0;
  }
}

/**
 * Whether the wire breaks in this tick: more is cut than it stands, or nothing cools it, or it stands still.
 * @param {Job} job
 * @param {Float64Array} state
 * @param {number} removed_um3
 * @returns {boolean}
 */
export function breaks(job, state, removed_um3) {
  const width_um = job.way.width_um[Math.trunc(Number(state[FAR_ROW]))];
  let rate = 0.0;
  if (width_um > 0.0) {
    state[AREA_UM2] += removed_um3 / width_um;
    rate = (((removed_um3 / width_um) * 1e-06) / TICK_S) * 60.0;
  }
  state[AREA_RATE] += _AREA_SMOOTH * (rate - state[AREA_RATE]);
  let most = job.bounds.area_rate_mm2_min;
  if (state[TICKS] < state[CHIPS_UNTIL]) {
    most *= state[CHIPS_FACTOR];
  }
  const is_standing = state[TICKS] < state[DRUMLESS_UNTIL];
  const is_bare = is_standing || (state[TICKS] < state[PUMPLESS_UNTIL]);
  const is_lit = (state[TICK_SPARKS] > 0.0) || (state[SHORT_US] > 0.0);
  state[UNCOOLED_TICKS] = (is_bare && is_lit) ? (state[UNCOOLED_TICKS] + 1.0) : 0.0;
  const limit = is_standing ? _STANDING_MOST : _UNCOOLED_MOST;
  return Boolean((state[AREA_RATE] > most) || (state[UNCOOLED_TICKS] > limit));
}
