// Written by `make pages` from sim/teach/plain/program.py.
import { read_listing } from "./plain_blocks.js";
import { Point, area_of, decoded, distance, distance_to, is_endless, length_of, points_on, with_axis_named } from "./plain_curves.js";
import { motion_quadrant } from "./plain_stepping.js";
import { arc_axis, line_axis } from "./plain_tasks.js";
/** @import { Block, Listing } from "./plain_blocks.js" */
/** @import { Curve } from "./plain_curves.js" */

export const PARTS = ["reads", "closes", "shape", "offset", "thread", "direction", "count", "end"];

const _ROUNDED_APART = 3;

const _MOST_LEADS = 2;

/**
 * A way round a drawing: ``right``, ``no-offset`` or ``wrong-side``, its curves in the order of cutting, µm.
 * @typedef {object} Variant
 * @property {string} name
 * @property {Curve[]} curves
 */

/**
 * @param {string} name
 * @param {Curve[]} curves
 * @returns {Variant}
 */
export function Variant(name, curves) {
  return { name, curves };
}

/**
 * What a program is to cut.
 * @typedef {object} Target
 * @property {Point} thread
 * @property {number} turn
 * @property {number} within_um
 * @property {Variant[]} variants
 */

/**
 * @param {Point} thread
 * @param {number} turn
 * @param {number} within_um
 * @param {Variant[]} variants
 * @returns {Target}
 */
export function Target(thread, turn, within_um, variants) {
  return { thread, turn, within_um, variants };
}

/**
 * A program as it was read.
 * @typedef {object} Written
 * @property {Curve[]} curves
 * @property {boolean} is_read
 * @property {number} words_fit
 * @property {number} wrong_block
 * @property {boolean} ends
 */

/**
 * @param {Curve[]} curves
 * @param {boolean} is_read
 * @param {number} words_fit
 * @param {number} wrong_block
 * @param {boolean} ends
 * @returns {Written}
 */
export function Written(curves, is_read, words_fit, wrong_block, ends) {
  return { curves, is_read, words_fit, wrong_block, ends };
}

/**
 * What of a program is right.
 * @typedef {object} ProgramMark
 * @property {boolean} reads
 * @property {boolean} closes
 * @property {boolean} shape
 * @property {boolean} offset
 * @property {boolean} thread
 * @property {boolean} direction
 * @property {number} counts
 * @property {boolean} end
 * @property {string} fits
 * @property {number} off_um
 * @property {number} moved_um
 * @property {Point} at
 * @property {number} at_block
 * @property {number} wrong_block
 */

/**
 * @param {boolean} reads
 * @param {boolean} closes
 * @param {boolean} shape
 * @param {boolean} offset
 * @param {boolean} thread
 * @param {boolean} direction
 * @param {number} counts
 * @param {boolean} end
 * @param {string} fits
 * @param {number} off_um
 * @param {number} moved_um
 * @param {Point} at
 * @param {number} at_block
 * @param {number} wrong_block
 * @returns {ProgramMark}
 */
export function ProgramMark(reads, closes, shape, offset, thread, direction, counts, end, fits, off_um, moved_um, at, at_block, wrong_block) {
  return { reads, closes, shape, offset, thread, direction, counts, end, fits, off_um, moved_um, at, at_block, wrong_block };
}

/**
 * A program in 3B, threaded at a place.
 * @param {string} text
 * @param {Point} thread
 * @returns {Written}
 */
export function written_of(text, thread) {
  const listing = read_listing(text);
  const curves = decoded(listing.blocks, thread);
  const wrong = first_wrong(listing.blocks, curves);
  const is_read = (listing.unread.length === 0) && (listing.blocks.length > 0);
  return Written(curves, is_read, (wrong === 0) ? 1 : 0, wrong, _ends(listing));
}

/**
 * Whether ``DD`` stands behind the last block, and nothing behind that.
 * @param {Listing} listing
 * @returns {boolean}
 */
function _ends(listing) {
  if ((listing.marks.length === 0) || (listing.behind_end > 0)) {
    return false;
  }
  const last = listing.marks[listing.marks.length - 1];
  return last.is_end && (last.after === listing.blocks.length);
}

/**
 * The first block, from 1, whose count length, count direction or quadrant goes against the rules; 0 if none.
 * @param {Block[]} blocks
 * @param {Curve[]} curves
 * @returns {number}
 */
export function first_wrong(blocks, curves) {
  for (let number = 0; number < blocks.length; number += 1) {
    const block = with_axis_named(blocks[number]);
    const curve = curves[number];
    const fits = (block.turn === 0) ? line_fits(block) : arc_fits(block, curve);
    if (is_endless(block) || (block.count_um === 0) || (!fits)) {
      return number + 1;
    }
  }
  return 0;
}

/**
 * Whether a line goes by the rules; where X and Y are reduced J carries the length, elsewhere it is the longer.
 * @param {Block} block
 * @returns {boolean}
 */
export function line_fits(block) {
  const longer = Math.max(block.x, block.y);
  const is_reduced = (block.count_um > longer) && ((longer < 1000) || ((block.count_um % longer) === 0));
  const axes = (block.y === 0) ? [1, 3] : [2, 4];
  const on_axis = (block.x === 0) || (block.y === 0);
  if (on_axis && (!axes.includes(block.quadrant))) {
    return false;
  }
  const near = (Math.max(block.x, block.y) - Math.min(block.x, block.y)) <= 1;
  const fits_axis = near || (block.axis === line_axis(block.x, block.y, block.quadrant));
  return fits_axis && ((Math.abs(block.count_um - longer) <= 1) || is_reduced);
}

/**
 * Whether an arc goes by the rules; near 45° either count direction will do.
 * @param {Block} block
 * @param {Curve} curve
 * @returns {boolean}
 */
export function arc_fits(block, curve) {
  const end_x = curve.end.x - curve.centre.x;
  const end_y = curve.end.y - curve.centre.y;
  const near = Math.abs(Math.abs(end_x) - Math.abs(end_y)) <= _ROUNDED_APART;
  const start_x = curve.start.x - curve.centre.x;
  const start_y = curve.start.y - curve.centre.y;
  const is_once = block.count_um <= ((4.0 * curve.radius) + 4.0);
  const on_axis = (block.x === 0) || (block.y === 0);
  const fits_sense = (!on_axis) || (motion_quadrant(block.turn, start_x, start_y) === block.quadrant);
  return is_once && fits_sense && (near || (block.axis === arc_axis(end_x, end_y)));
}

/**
 * The blocks of a program that go round: from the first, from 0, to before the last; nothing where both are 0.
 * @typedef {object} _Loop
 * @property {number} first
 * @property {number} past
 */

/**
 * @param {number} first
 * @param {number} past
 * @returns {_Loop}
 */
function _Loop(first, past) {
  return { first, past };
}

/**
 * How far a path lies off a variant, µm, where, and on which curve, from 0.
 * @typedef {object} _Off
 * @property {number} off_um
 * @property {Point} at
 * @property {number} number
 */

/**
 * @param {number} off_um
 * @param {Point} at
 * @param {number} number
 * @returns {_Off}
 */
function _Off(off_um, at, number) {
  return { off_um, at, number };
}

/**
 * Lowest and highest places, µm.
 * @typedef {object} _Box
 * @property {number} low_x
 * @property {number} low_y
 * @property {number} high_x
 * @property {number} high_y
 */

/**
 * @param {number} low_x
 * @param {number} low_y
 * @param {number} high_x
 * @param {number} high_y
 * @returns {_Box}
 */
function _Box(low_x, low_y, high_x, high_y) {
  return { low_x, low_y, high_x, high_y };
}

/**
 * Mark of a program against what it is to cut; what does not close has no shape, offset or direction.
 * @param {Target} target
 * @param {Written} written
 * @returns {ProgramMark}
 */
export function program_mark(target, written) {
  const loop = _loop_in(written.curves, target);
  if (loop.past === 0) {
    return ProgramMark(written.is_read, false, false, false, false, false, written.words_fit, written.ends, "", 0.0, 0.0, target.thread, 0, written.wrong_block);
  }
  const curves = written.curves.slice(loop.first, loop.past);
  let best = _Off(Infinity, target.thread, 0);
  let fits = "";
  let moved = Point(0.0, 0.0);
  for (const variant of target.variants) {
    const by = _moved_by(curves, variant.curves);
    const off = _off_of(curves, variant.curves, by, target.within_um);
    if (off.off_um < best.off_um) {
      best = off;
      fits = variant.name;
      moved = by;
      if (off.off_um <= target.within_um) {
        break;
      }
    }
  }
  const moved_um = Math.sqrt((moved.x * moved.x) + (moved.y * moved.y));
  const is_shape = best.off_um <= target.within_um;
  const back_um = distance(written.curves[written.curves.length - 1].end, target.thread);
  const turn = (area_of(curves) > 0.0) ? 1 : (-1);
  return ProgramMark(written.is_read, true, is_shape, is_shape && (fits === "right"), is_shape && (moved_um <= target.within_um) && (back_um <= target.within_um), [0, turn].includes(target.turn), written.words_fit, written.ends, fits, best.off_um, moved_um, best.at, (loop.first + best.number) + 1, written.wrong_block);
}

/**
 * The shortest way in a path that ends where it began, past at most two leads, and is half the drawing long.
 * @param {Curve[]} curves
 * @param {Target} target
 * @returns {_Loop}
 */
function _loop_in(curves, target) {
  let least = 0.0;
  for (const curve of target.variants[0].curves) {
    least += 0.5 * length_of(curve);
  }
  let best = Infinity;
  let found = _Loop(0, 0);
  for (let first = 0; first < Math.min(_MOST_LEADS + 1, curves.length); first += 1) {
    let length = 0.0;
    for (let number = first; number < curves.length; number += 1) {
      length += length_of(curves[number]);
      const closes = distance(curves[first].start, curves[number].end) <= target.within_um;
      if (closes && (least <= length && length < best)) {
        best = length;
        found = _Loop(first, number + 1);
      }
    }
  }
  return found;
}

/**
 * The box of curves, by their places.
 * @param {Curve[]} curves
 * @returns {_Box}
 */
function _box_of(curves) {
  let low_x = Infinity;
  let low_y = Infinity;
  let high_x = -Infinity;
  let high_y = -Infinity;
  for (const curve of curves) {
    for (const point of points_on(curve)) {
      [low_x, high_x] = [Math.min(low_x, point.x), Math.max(high_x, point.x)];
      [low_y, high_y] = [Math.min(low_y, point.y), Math.max(high_y, point.y)];
    }
  }
  return _Box(low_x, low_y, high_x, high_y);
}

/**
 * How far the middle of the box of curves lies beside that of others.
 * @param {Curve[]} curves
 * @param {Curve[]} others
 * @returns {Point}
 */
function _moved_by(curves, others) {
  const box = _box_of(curves);
  const other = _box_of(others);
  const x = ((box.low_x + box.high_x) - other.low_x) - other.high_x;
  const y = ((box.low_y + box.high_y) - other.low_y) - other.high_y;
  return Point(x / 2.0, y / 2.0);
}

/**
 * How far curves lie off others that are moved by so much, either from the other.
 * @param {Curve[]} curves
 * @param {Curve[]} others
 * @param {Point} by
 * @param {number} within_um
 * @returns {_Off}
 */
function _off_of(curves, others, by, within_um) {
  let worst = 0.0;
  let at = Point(0.0, 0.0);
  let at_number = 0;
  let near = 0;
  for (let number = 0; number < curves.length; number += 1) {
    for (const point of points_on(curves[number])) {
      const nearest = _nearest(others, Point(point.x - by.x, point.y - by.y), near, within_um);
      near = nearest.number;
      if (nearest.off_um > worst) {
        worst = nearest.off_um;
        at = point;
        at_number = number;
      }
    }
  }
  near = 0;
  for (const other of others) {
    for (const point of points_on(other)) {
      const back = _nearest(curves, Point(point.x + by.x, point.y + by.y), near, within_um);
      near = back.number;
      if (back.off_um > worst) {
        worst = back.off_um;
        at = back.at;
        at_number = back.number;
      }
    }
  }
  return _Off(worst, at, at_number);
}

/**
 * The nearest of curves to a place, and how far it is; the first one, from `begin` on, that is near enough.
 * @param {Curve[]} curves
 * @param {Point} place
 * @param {number} begin
 * @param {number} within_um
 * @returns {_Off}
 */
function _nearest(curves, place, begin, within_um) {
  let least = Infinity;
  let nearest = 0;
  for (let count = 0; count < curves.length; count += 1) {
    const number = (begin + count) % curves.length;
    const off_um = distance_to(curves[number], place);
    if (off_um < least) {
      least = off_um;
      nearest = number;
      if (off_um <= within_um) {
        break;
      }
    }
  }
  return _Off(least, place, nearest);
}

/**
 * Parts of a mark in the order of `PARTS`: 1 right, 0 not, −1 where there is no such thing in the language.
 * @param {ProgramMark} mark
 * @returns {number[]}
 */
export function parts_of(mark) {
  const rights = [mark.reads, mark.closes, mark.shape, mark.offset, mark.thread, mark.direction];
  /** @type {number[]} */
  const parts = rights.map((is_right) => (is_right ? 1 : 0));
  parts.push(mark.counts);
  parts.push(mark.end ? 1 : 0);
  return parts;
}

/**
 * Share of a program that is right, its parts weighed as in `PARTS`; one that the language lacks has none.
 * @param {ProgramMark} mark
 * @param {number[]} weights
 * @returns {number}
 */
export function program_share(mark, weights) {
  const parts = parts_of(mark);
  let right = 0.0;
  let whole = 0.0;
  for (let number = 0; number < parts.length; number += 1) {
    if (parts[number] >= 0) {
      whole += weights[number];
      right += weights[number] * parts[number];
    }
  }
  return (whole > 0.0) ? (right / whole) : 0.0;
}
