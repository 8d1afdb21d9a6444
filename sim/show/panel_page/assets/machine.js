// The cut that the panel drives: its job and state, what each key of the panel does, and the keys as they were pressed.
import {
  AT, CHIP_CLEAR_UM, CHIP_UM, CHIP_UNTIL, DRUMLESS_UNTIL, HAND_UM, HISTORY_STRIDE, HOLD_UNTIL, IS_BY_HAND,
  PROGRESS_TICK, PUMPLESS_UNTIL, ROW, RUNNING, SEED_1, SEED_2, SET_SHARE, SPARKLESS_UNTIL, STATE_SIZE,
  TICKS, POWER_OUT, WIRE_OUT,
} from "./plain_state.js";
import { cut_power, restart, thread_wire, tear_wire } from "./plain_events.js";
import { place_um } from "./plain_gap.js";
import { clear_alarm } from "./plain_hands.js";
import { run_ticks } from "./plain_tick.js";

/** @import { Job } from "./plain_state.js" */
/** @import { Panel } from "./data.js" */

/**
 * A key that was pressed: in which tick, which one, and with which value.
 * @typedef {[number, string, number]} Press
 */

const EVER = 1e15; // ticks
const HISTORY_ROWS = 4096;
const LOG_ROWS = 500;
const CHIP_BACK_UM = 60;
const CHIP_TICKS = 60000;

/**
 * The job of a panel, with room for what it records.
 * @param {Panel} panel
 * @returns {Job}
 */
export function jobOf(panel) {
  const { way, events } = panel;
  const length = way.along_um[way.along_um.length - 1];
  return {
    way: {
      before: Float64Array.from(way.before), along_um: Float64Array.from(way.along_um),
      width_um: Float64Array.from(way.width_um), thread_um: Float64Array.from(way.thread_um), wait_s: Float64Array.from(way.wait_s),
    },
    discharge: { ...panel.discharge },
    servo: { ...panel.servo },
    bounds: { ...panel.bounds, area_rate_mm2_min: panel.bounds.area_rate_mm2_min ?? Infinity, is_reversed: 0, is_manned: 1 },
    events: {
      kind: Float64Array.from(events.kind), for_s: Float64Array.from(events.for_s),
      size: Float64Array.from(events.size), at: Float64Array.from(events.at),
      by_step: Float64Array.from(events.by_step), by_time: Float64Array.from(events.by_time),
    },
    records: {
      lit_s: new Float64Array(Math.floor(length / panel.stretch_um) + 1), stretch_um: Float64Array.of(panel.stretch_um),
      block_s: new Float64Array(way.width_um.length), log: new Float64Array(4 * LOG_ROWS),
      history: new Float64Array(4 * HISTORY_ROWS),
    },
  };
}

/**
 * A cut at its start. `presses` are keys of an earlier sitting, pressed again at their ticks.
 * @param {Panel} panel
 * @param {Press[]} presses
 */
export function newCut(panel, presses = []) {
  const job = jobOf(panel);
  const state = new Float64Array(STATE_SIZE);
  [state[SEED_1], state[SEED_2]] = panel.seeds;
  state[SET_SHARE] = panel.set_share;
  state[HISTORY_STRIDE] = 1;
  const cut = { job, state, status: RUNNING, mode: panel.mode, hold: false, presses: /** @type {Press[]} */ ([]), ahead: presses.slice() };

  /** @type {Record<string, (value: number) => void>} */
  const actions = {
    set: (value) => { state[SET_SHARE] = value; },
    mode: (value) => {
      const { name, crater_um3, spread_um3 } = panel.modes[value];
      cut.mode = name;
      job.discharge = { ...job.discharge, crater_um3, spread_um3 };
    },
    on: (value) => { job.discharge = { ...job.discharge, on_us: value }; },
    off: (value) => { job.discharge = { ...job.discharge, off_us: value }; },
    hold: (value) => {
      cut.hold = value > 0;
      state[HOLD_UNTIL] = value ? EVER : 0;
      state[PROGRESS_TICK] = state[TICKS];
    },
    sparks: (value) => { state[SPARKLESS_UNTIL] = value ? 0 : EVER; },
    pump: (value) => { state[PUMPLESS_UNTIL] = value ? 0 : EVER; },
    drum: (value) => { state[DRUMLESS_UNTIL] = value ? 0 : EVER; },
    hand: (value) => {
      state[IS_BY_HAND] = value ? 1 : 0;
      state[HAND_UM] = value;
    },
    thread: (value) => { if (state[WIRE_OUT] > 0) thread_wire(job, state, value); },
    restart: (value) => { if (state[POWER_OUT] > 0) restart(job, state, value); },
    chip: () => {
      state[CHIP_UM] = place_um(job, state);
      state[CHIP_CLEAR_UM] = CHIP_BACK_UM;
      state[CHIP_UNTIL] = state[TICKS] + CHIP_TICKS;
    },
    tear: () => tear_wire(job, state),
    fail: () => cut_power(job, state),
    resume: () => clear_alarm(state),
  };

  /**
   * Press a key of the panel: it counts from this tick on.
   * @param {string} name
   * @param {number} value
   */
  function press(name, value = 0) {
    cut.presses.push([state[TICKS], name, value]);
    actions[name](value);
    cut.status = RUNNING;
  }

  /** Press again those keys of an earlier sitting whose tick has come. */
  function pressAgain() {
    while (cut.ahead.length && cut.ahead[0][0] <= state[TICKS]) {
      const [, name, value] = /** @type {Press} */ (cut.ahead.shift());
      if (name in actions) press(name, value);
    }
  }

  /**
   * Go on for so many ticks at most, until the control stops; how many went by.
   * @param {number} ticks
   */
  function advance(ticks) {
    pressAgain();
    const begins = state[TICKS];
    const wanted = cut.ahead.length ? Math.min(ticks, Math.max(cut.ahead[0][0] - begins, 1)) : ticks;
    cut.status = run_ticks(job, state, wanted);
    return state[TICKS] - begins;
  }

  return Object.assign(cut, {
    press, advance,
    /** Whether the path is cut to its end. */
    isThrough: () => state[AT] >= job.way.before[job.way.before.length - 1],
    /** Steps of the block where the wire stands. */
    made: () => state[AT] - job.way.before[Math.trunc(state[ROW])],
    /** How the keys stand. */
    settings: () => ({
      set: state[SET_SHARE], on: job.discharge.on_us, off: job.discharge.off_us, mode: cut.mode,
      pressed: {
        hold: cut.hold, sparks: state[SPARKLESS_UNTIL] <= state[TICKS], pump: state[PUMPLESS_UNTIL] <= state[TICKS],
        drum: state[DRUMLESS_UNTIL] <= state[TICKS],
      },
    }),
  });
}

/** @typedef {ReturnType<typeof newCut>} Cut */
