// Written by `make pages` from sim/process/ticks/state.py.

export const TICK_S = 0.001;

export const TICK_US = 1000.0;

export const FAR_UM = 50.0;

export const ARC_SHARE = 0.3;

export const RUNNING = 0;

export const FINISHED = 1;

export const IN_VAIN = 2;

export const SHORTED = 3;

export const STALLED = 4;

export const BREAKS_AGAIN = 5;

export const BROKEN = 6;

export const POWERLESS = 7;

export const COLLIDED = 8;

export const VOLTAGE = 0;

export const WINDOW = 1;

export const DUTY = 2;

export const SHORT = 1;

export const CHIPS = 2;

export const BREAK = 3;

export const POWER = 4;

export const PAUSE = 5;

export const SPARKS_OFF = 6;

export const PUMP_OFF = 7;

export const DRUM_OFF = 8;

export const KNOB = 9;

export const CLEARED = 10;

export const STOPPED = 11;

export const SINGLE = 12;

export const SKIP = 13;

export const ORIGIN = 14;

export const TICKS = 0;

export const AT = 1;

export const FARTHEST = 2;

export const ROW = 3;

export const FAR_ROW = 4;

export const FRONT_UM = 5;

export const BUSY_US = 6;

export const RESIDUE = 7;

export const RESET_UM_S = 8;

export const SEED_1 = 9;

export const SEED_2 = 10;

export const SPARE = 11;

export const HAS_SPARE = 12;

export const OPEN_US = 13;

export const ON_US = 14;

export const SHORT_US = 15;

export const TICK_SPARKS = 16;

export const SET_SHARE = 17;

export const CHIP_UM = 18;

export const CHIP_CLEAR_UM = 19;

export const CHIP_UNTIL = 20;

export const HOLD_UNTIL = 21;

export const SPARKLESS_UNTIL = 22;

export const PUMPLESS_UNTIL = 23;

export const DRUMLESS_UNTIL = 24;

export const CHIPS_UNTIL = 25;

export const CHIPS_FACTOR = 26;

export const SHORT_TICKS = 27;

export const IS_SHORT = 28;

export const SHORT_AT = 29;

export const AREA_RATE = 30;

export const NEXT_BY_STEP = 31;

export const NEXT_BY_TIME = 32;

export const PROGRESS_TICK = 33;

export const ALL_SPARKS = 34;

export const ALL_OPEN_US = 35;

export const ALL_ON_US = 36;

export const LIVE_TICKS = 37;

export const SHORTS = 38;

export const BREAKS = 39;

export const RETREATED_UM = 40;

export const LOST_TICKS = 41;

export const REMOVED_UM3 = 42;

export const GAP_UM = 43;

export const LOGGED = 44;

export const HISTORY_ROWS = 45;

export const HISTORY_STRIDE = 46;

export const VOLTAGE_SUM = 47;

export const CURRENT_SUM = 48;

export const UNCOOLED_TICKS = 49;

export const HISTORY_TICKS = 50;

export const AREA_UM2 = 51;

export const ALL_GAP_UM = 52;

export const BREAK_UM = 53;

export const BREAKS_HERE = 54;

export const WIRE_OUT = 55;

export const POWER_OUT = 56;

export const IS_BY_HAND = 57;

export const HAND_UM = 58;

export const SINGLE_S = 59;

export const FLOOR_UM = 60;

export const AT_ORIGIN = 61;

export const STOOD_TICKS = 62;

export const NEXT_BY_CUT = 63;

export const CORNER_UNTIL = 64;

export const STATE_SIZE = 65;

/**
 * The stepped path, n blocks.
 * @typedef {object} Way
 * @property {Float64Array} before
 * @property {Float64Array} along_um
 * @property {Float64Array} width_um
 * @property {Float64Array} thread_um
 * @property {Float64Array} wait_s
 */

/**
 * @param {Float64Array} before
 * @param {Float64Array} along_um
 * @param {Float64Array} width_um
 * @param {Float64Array} thread_um
 * @param {Float64Array} wait_s
 * @returns {Way}
 */
export function Way(before, along_um, width_um, thread_um, wait_s) {
  return { before, along_um, width_um, thread_um, wait_s };
}

/**
 * Sparks: how long each one lasts and pauses, its crater with its spread, and the height of the work in µm.
 * @typedef {object} Discharge
 * @property {number} on_us
 * @property {number} off_us
 * @property {number} crater_um3
 * @property {number} spread_um3
 * @property {number} height_um
 */

/**
 * @param {number} on_us
 * @param {number} off_us
 * @param {number} crater_um3
 * @param {number} spread_um3
 * @param {number} height_um
 * @returns {Discharge}
 */
export function Discharge(on_us, off_us, crater_um3, spread_um3, height_um) {
  return { on_us, off_us, crater_um3, spread_um3, height_um };
}

/**
 * The law by which the control moves, and the speeds that bound it.
 * @typedef {object} Servo
 * @property {number} law
 * @property {number} gain_um_s
 * @property {number} reset_s
 * @property {number} least_um_s
 * @property {number} most_um_s
 * @property {number} ring_um
 */

/**
 * @param {number} law
 * @param {number} gain_um_s
 * @param {number} reset_s
 * @param {number} least_um_s
 * @param {number} most_um_s
 * @param {number} ring_um
 * @returns {Servo}
 */
export function Servo(law, gain_um_s, reset_s, least_um_s, most_um_s, ring_um) {
  return { law, gain_um_s, reset_s, least_um_s, most_um_s, ring_um };
}

/**
 * What stops the cut, and how long it takes to go on.
 * @typedef {object} Bounds
 * @property {number} short_s
 * @property {number} area_rate_mm2_min
 * @property {number} thread_s
 * @property {number} restart_s
 * @property {number} jog_um_s
 * @property {number} is_from_start
 * @property {number} is_reversed
 * @property {number} is_manned
 */

/**
 * @param {number} short_s
 * @param {number} area_rate_mm2_min
 * @param {number} thread_s
 * @param {number} restart_s
 * @param {number} jog_um_s
 * @param {number} is_from_start
 * @param {number} is_reversed
 * @param {number} is_manned
 * @returns {Bounds}
 */
export function Bounds(short_s, area_rate_mm2_min, thread_s, restart_s, jog_um_s, is_from_start, is_reversed, is_manned) {
  return { short_s, area_rate_mm2_min, thread_s, restart_s, jog_um_s, is_from_start, is_reversed, is_manned };
}

/**
 * What happens: at a step, then at a time, then after so much time of cutting, each in order.
 * @typedef {object} Events
 * @property {Float64Array} kind
 * @property {Float64Array} for_s
 * @property {Float64Array} size
 * @property {Float64Array} at
 * @property {Float64Array} by_step
 * @property {Float64Array} by_time
 */

/**
 * @param {Float64Array} kind
 * @param {Float64Array} for_s
 * @param {Float64Array} size
 * @param {Float64Array} at
 * @param {Float64Array} by_step
 * @param {Float64Array} by_time
 * @returns {Events}
 */
export function Events(kind, for_s, size, at, by_step, by_time) {
  return { kind, for_s, size, at, by_step, by_time };
}

/**
 * What the loop fills.
 * @typedef {object} Records
 * @property {Float64Array} lit_s
 * @property {Float64Array} stretch_um
 * @property {Float64Array} block_s
 * @property {Float64Array} log
 * @property {Float64Array} history
 */

/**
 * @param {Float64Array} lit_s
 * @param {Float64Array} stretch_um
 * @param {Float64Array} block_s
 * @param {Float64Array} log
 * @param {Float64Array} history
 * @returns {Records}
 */
export function Records(lit_s, stretch_um, block_s, log, history) {
  return { lit_s, stretch_um, block_s, log, history };
}

/**
 * All that the loop goes by.
 * @typedef {object} Job
 * @property {Way} way
 * @property {Discharge} discharge
 * @property {Servo} servo
 * @property {Bounds} bounds
 * @property {Events} events
 * @property {Records} records
 */

/**
 * @param {Way} way
 * @param {Discharge} discharge
 * @param {Servo} servo
 * @param {Bounds} bounds
 * @param {Events} events
 * @param {Records} records
 * @returns {Job}
 */
export function Job(way, discharge, servo, bounds, events, records) {
  return { way, discharge, servo, bounds, events, records };
}

/**
 * What the walls of k rows are held against.
 * @typedef {object} Walls
 * @property {Float64Array} usual_s
 * @property {Float64Array} gap_um
 * @property {Float64Array} start_um
 * @property {number} stretch_um
 * @property {number} half
 */

/**
 * @param {Float64Array} usual_s
 * @param {Float64Array} gap_um
 * @param {Float64Array} start_um
 * @param {number} stretch_um
 * @param {number} half
 * @returns {Walls}
 */
export function Walls(usual_s, gap_um, start_um, stretch_um, half) {
  return { usual_s, gap_um, start_um, stretch_um, half };
}
