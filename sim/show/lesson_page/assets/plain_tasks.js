// Written by `make pages` from sim/teach/plain/tasks.py.
import { Block } from "./plain_blocks.js";
import { Point } from "./plain_curves.js";
import { motion_quadrant } from "./plain_stepping.js";

export const SHAPES = ["axis", "slope", "diagonal", "quarter", "arc", "circle"];

const _MODULUS = 2147483647;

const _LATTICE_X = [65, 63, 60, 56, 52, 39, 33, 25, 16];

const _LATTICE_Y = [0, 16, 25, 33, 39, 52, 56, 60, 63];

const _PER_QUARTER = 9;

/**
 * A curve with the block that cuts it; places are whole µm.
 * @typedef {object} Task
 * @property {string} shape
 * @property {Point} start
 * @property {Point} end
 * @property {Point} centre
 * @property {Block} block
 */

/**
 * @param {string} shape
 * @param {Point} start
 * @param {Point} end
 * @param {Point} centre
 * @param {Block} block
 * @returns {Task}
 */
export function Task(shape, start, end, centre, block) {
  return { shape, start, end, centre, block };
}

/**
 * A seed of a text, from 1 to 2³¹ − 2: the same text, the same seed.
 * @param {string} text
 * @returns {number}
 */
export function seed_of(text) {
  let seed = 17;
  for (const character of text) {
    seed = ((seed * 31) + (/** @type {number} */ (character.codePointAt(0)))) % (_MODULUS - 1);
  }
  return seed + 1;
}

/**
 * The seed of a part, numbered from 0, of what has a seed itself: of an exercise of a sitting, or of its task.
 * @param {number} seed
 * @param {number} number
 * @returns {number}
 */
export function seed_of_task(seed, number) {
  return seed_of(`${seed} ${number}`);
}

/**
 * The next number of the generator of Park and Miller (multiplier 48271), from 1 to 2³¹ − 2.
 * @param {number} seed
 * @returns {number}
 */
export function next_seed(seed) {
  return (seed * 48271) % _MODULUS;
}

/**
 * A whole number from low to high by a seed. Its low digits are worn by the modulus, so the high ones decide.
 * @param {number} seed
 * @param {number} low
 * @param {number} high
 * @returns {number}
 */
export function chosen(seed, low, high) {
  return low + (Math.floor((seed * ((high - low) + 1)) / _MODULUS));
}

/**
 * A task of a shape by a seed.
 * @param {string} shape
 * @param {number} seed
 * @returns {Task}
 */
export function task_of(shape, seed) {
  const first = next_seed(next_seed(seed));
  const second = next_seed(first);
  const start = Point(100 * chosen(first, -200, 200), 100 * chosen(second, -200, 200));
  if (["axis", "slope", "diagonal"].includes(shape)) {
    return _line_task(shape, start, second);
  }
  return _arc_task(shape, start, second);
}

/**
 * @param {string} shape
 * @param {Point} start
 * @param {number} seed
 * @returns {Task}
 */
function _line_task(shape, start, seed) {
  const first = next_seed(seed);
  const second = next_seed(first);
  const third = next_seed(second);
  const long = 100 * chosen(first, 60, 400);
  const short = 100 * chosen(second, 5, 50);
  const quadrant = chosen(third, 1, 4);
  let x = long;
  let y = short;
  if (shape === "diagonal") {
    y = long;
  }
  if (shape === "axis") {
    [x, y] = ((quadrant % 2) === 1) ? [long, 0] : [0, long];
  }
  if ((shape === "slope") && ((next_seed(third) % 2) === 0)) {
    x = short;
    y = long;
  }
  const block = Block(x, y, Math.max(x, y), line_axis(x, y, quadrant), 0, quadrant, 1);
  const end = Point(start.x + (([1, 4].includes(quadrant)) ? x : (-x)), start.y + (([1, 2].includes(quadrant)) ? y : (-y)));
  return Task(shape, start, end, start, block);
}

/**
 * Count direction of a line by the rule of the trade: the longer one; at 45° GY in quadrants 1 and 3, else GX.
 * @param {number} x
 * @param {number} y
 * @param {number} quadrant
 * @returns {number}
 */
export function line_axis(x, y, quadrant) {
  if (x === y) {
    return ((quadrant % 2) === 1) ? 1 : 0;
  }
  return (x > y) ? 0 : 1;
}

/**
 * Count direction of an arc by where it ends, from the centre: nearer the X axis GY, nearer the Y axis GX.
 * @param {number} end_x
 * @param {number} end_y
 * @returns {number}
 */
export function arc_axis(end_x, end_y) {
  return (Math.abs(end_x) > Math.abs(end_y)) ? 1 : 0;
}

/**
 * A place on the circle of radius 65 by its number, counter-clockwise from +X; 36 make it whole.
 * @param {number} number
 * @returns {Point}
 */
function _lattice(number) {
  const quarter = (Math.floor(number / _PER_QUARTER)) % 4;
  const within = number % _PER_QUARTER;
  const x = _LATTICE_X[within];
  const y = _LATTICE_Y[within];
  if (quarter === 0) {
    return Point(x, y);
  }
  if (quarter === 1) {
    return Point(-y, x);
  }
  return (quarter === 2) ? Point(-x, -y) : Point(y, -x);
}

/**
 * @param {string} shape
 * @param {Point} start
 * @param {number} seed
 * @returns {Task}
 */
function _arc_task(shape, start, seed) {
  const first = next_seed(seed);
  const second = next_seed(first);
  const third = next_seed(second);
  const fourth = next_seed(third);
  const turn = (chosen(first, 0, 1) === 1) ? 1 : (-1);
  const unit = 20 * chosen(second, 2, 20);
  const [number, places] = _arc_places(shape, third, fourth);
  const begins = _lattice(number);
  let count_x = 0.0;
  let count_y = 0.0;
  let ends = begins;
  for (let place = 1; place < places + 1; place += 1) {
    const following = _lattice((number + 36) + (turn * place));
    count_x += Math.abs(following.x - ends.x);
    count_y += Math.abs(following.y - ends.y);
    ends = following;
  }
  const axis = arc_axis(ends.x, ends.y);
  const count = Math.trunc(Number(unit * ((axis === 0) ? count_x : count_y)));
  const quadrant = motion_quadrant(turn, begins.x, begins.y);
  const block = Block(Math.trunc(Number(unit * Math.abs(begins.x))), Math.trunc(Number(unit * Math.abs(begins.y))), count, axis, turn, quadrant, 1);
  const centre = Point(start.x - (unit * begins.x), start.y - (unit * begins.y));
  return Task(shape, start, Point(centre.x + (unit * ends.x), centre.y + (unit * ends.y)), centre, block);
}

/**
 * The place where an arc begins, and how many places it goes on.
 * @param {string} shape
 * @param {number} seed
 * @param {number} other
 * @returns {[number, number]}
 */
function _arc_places(shape, seed, other) {
  if (shape === "circle") {
    return [_PER_QUARTER * chosen(seed, 0, 3), 4 * _PER_QUARTER];
  }
  if (shape === "quarter") {
    return [(_PER_QUARTER * chosen(seed, 0, 3)) + 4, chosen(other, 2, 4)];
  }
  return [chosen(seed, 0, 35), chosen(other, 11, 30)];
}
