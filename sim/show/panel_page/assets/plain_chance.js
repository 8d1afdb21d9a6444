// Written by `make pages` from sim/process/ticks/chance.py.
import { HAS_SPARE, SEED_1, SEED_2, SPARE } from "./plain_state.js";

export const CLOSE_UM = 3.84;

export const LN_2 = 0.6931471805599453;

const _SHARE_1 = 1.0 / 2147483563.0;

const _SHARE_2 = 1.0 / 2147483399.0;

/**
 * A random number between 0 and 1, neither of them.
 * @param {Float64Array} state
 * @returns {number}
 */
export function random_share(state) {
  let first = 40014.0 * state[SEED_1];
  first -= Math.floor(first * _SHARE_1) * 2147483563.0;
  let second = 40692.0 * state[SEED_2];
  second -= Math.floor(second * _SHARE_2) * 2147483399.0;
  state[SEED_1] = first;
  state[SEED_2] = second;
  let both = first - second;
  if (both < 1.0) {
    both += 2147483562.0;
  }
  return Number(both * _SHARE_1);
}

/**
 * A random number of mean 0 and spread 1 (Box and Muller): two are made at once.
 * @param {Float64Array} state
 * @returns {number}
 */
export function random_normal(state) {
  if (state[HAS_SPARE] > 0.0) {
    state[HAS_SPARE] = 0.0;
    return Number(state[SPARE]);
  }
  const radius = Math.sqrt((-2.0) * Math.log(random_share(state)));
  const angle = (2.0 * Math.PI) * random_share(state);
  state[SPARE] = radius * Math.sin(angle);
  state[HAS_SPARE] = 1.0;
  return radius * Math.cos(angle);
}

/**
 * Mean time from an open gap to a spark, µs: its median is 0.48 g² − 3.69 g + 14.05 with the gap g in µm.
 * @param {number} gap_um
 * @returns {number}
 */
export function mean_delay_us(gap_um) {
  const gap = Math.max(gap_um, CLOSE_UM);
  return ((((0.48 * gap) * gap) - (3.69 * gap)) + 14.05) / LN_2;
}
