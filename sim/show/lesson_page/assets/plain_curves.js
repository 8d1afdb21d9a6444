// Written by `make pages` from sim/teach/plain/curves.py.
import { Block } from "./plain_blocks.js";

const _SIGN_X = [0, 1, -1, -1, 1];

const _SIGN_Y = [0, 1, 1, -1, -1];

const _PARTS_OF_ARC = 24;

const _PARTS_OF_LINE = 8;

/**
 * A place, µm.
 * @typedef {object} Point
 * @property {number} x
 * @property {number} y
 */

/**
 * @param {number} x
 * @param {number} y
 * @returns {Point}
 */
export function Point(x, y) {
  return { x, y };
}

/**
 * A line, or an arc about a centre; a line has turn 0 and its start as its centre.
 * @typedef {object} Curve
 * @property {number} turn
 * @property {Point} start
 * @property {Point} end
 * @property {Point} centre
 * @property {number} radius
 * @property {number} start_rad
 * @property {number} sweep_rad
 */

/**
 * @param {number} turn
 * @param {Point} start
 * @param {Point} end
 * @param {Point} centre
 * @param {number} radius
 * @param {number} start_rad
 * @param {number} sweep_rad
 * @returns {Curve}
 */
export function Curve(turn, start, end, centre, radius, start_rad, sweep_rad) {
  return { turn, start, end, centre, radius, start_rad, sweep_rad };
}

/**
 * A line.
 * @param {Point} start
 * @param {Point} end
 * @returns {Curve}
 */
export function line_to(start, end) {
  return Curve(0, start, end, start, 0.0, 0.0, 0.0);
}

/**
 * An arc from its start on.
 * @param {Point} start
 * @param {Point} centre
 * @param {number} sweep_rad
 * @returns {Curve}
 */
export function arc_to(start, centre, sweep_rad) {
  const x = start.x - centre.x;
  const y = start.y - centre.y;
  const radius = Math.sqrt((x * x) + (y * y));
  const start_rad = Math.atan2(y, x);
  const angle = start_rad + sweep_rad;
  const end = Point(centre.x + (radius * Math.cos(angle)), centre.y + (radius * Math.sin(angle)));
  return Curve((sweep_rad > 0.0) ? 1 : (-1), start, end, centre, radius, start_rad, sweep_rad);
}

/**
 * Curves of blocks from a start on; a block that no controller can count out makes no way.
 * @param {Block[]} blocks
 * @param {Point} start
 * @returns {Curve[]}
 */
export function decoded(blocks, start) {
  /** @type {Curve[]} */
  const curves = [];
  let place = start;
  for (const block of blocks) {
    const curve = curve_of(block, place);
    curves.push(curve);
    place = curve.end;
  }
  return curves;
}

/**
 * Whether a controller would never count a block out (3B201, 3B202): no radius, or nothing on the counted axis.
 * @param {Block} block
 * @returns {boolean}
 */
export function is_endless(block) {
  if (block.turn !== 0) {
    return ((block.x * block.x) + (block.y * block.y)) <= 1;
  }
  const named = with_axis_named(block);
  return (((named.axis === 0) ? named.x : named.y) === 0) && (named.count_um > 0);
}

/**
 * A block; a line without X and Y gets the axis that its digit names.
 * @param {Block} block
 * @returns {Block}
 */
export function with_axis_named(block) {
  if ((block.turn !== 0) || (block.x > 0) || (block.y > 0)) {
    return block;
  }
  const on_x = (block.quadrant % 2) === 1;
  return Block(on_x ? 1 : 0, on_x ? 0 : 1, block.count_um, block.axis, 0, block.quadrant, block.line);
}

/**
 * The curve of a block from its start; J decides where it ends.
 * @param {Block} block
 * @param {Point} start
 * @returns {Curve}
 */
export function curve_of(block, start) {
  if (is_endless(block)) {
    return line_to(start, start);
  }
  return (block.turn === 0) ? _line_of(with_axis_named(block), start) : _arc_of(block, start);
}

/**
 * A line: J along the counted axis, the ratio X:Y across it.
 * @param {Block} block
 * @param {Point} start
 * @returns {Curve}
 */
function _line_of(block, start) {
  const counted = (block.axis === 0) ? block.x : block.y;
  const other = (block.axis === 0) ? block.y : block.x;
  const along = (counted > 0) ? block.count_um : 0;
  const across = (counted > 0) ? ((block.count_um * other) / counted) : 0.0;
  const by_x = (block.axis === 0) ? along : across;
  const by_y = (block.axis === 0) ? across : along;
  return line_to(start, Point(start.x + (_SIGN_X[block.quadrant] * by_x), start.y + (_SIGN_Y[block.quadrant] * by_y)));
}

/**
 * An arc: its counted coordinate is a triangle wave of period 4R in the length counted off.
 * @param {Block} block
 * @param {Point} start
 * @returns {Curve}
 */
function _arc_of(block, start) {
  const x = _SIGN_X[block.quadrant] * block.x;
  const y = _SIGN_Y[block.quadrant] * block.y;
  const radius = Math.sqrt((x * x) + (y * y));
  const cosine = (block.axis === 0) ? x : y;
  const sine = ((block.axis === 0) ? y : (-x)) * block.turn;
  const near = (cosine > 0) ? ((sine * sine) / (radius + cosine)) : (radius - cosine);
  const phase = ((sine >= 0) ? near : ((4.0 * radius) - near)) + block.count_um;
  const turns = Math.floor(phase / (4.0 * radius));
  const rest = phase - ((turns * 4.0) * radius);
  const is_upper = rest <= (2.0 * radius);
  const end_cosine = is_upper ? (radius - rest) : (rest - (3.0 * radius));
  const square = is_upper ? (rest * ((2.0 * radius) - rest)) : (((4.0 * radius) - rest) * (rest - (2.0 * radius)));
  const end_sine = Math.sqrt(Math.max(square, 0.0)) * (is_upper ? 1.0 : (-1.0));
  const sweep = (_angle(end_cosine, end_sine) + ((2.0 * Math.PI) * turns)) - _angle(cosine, sine);
  const end_x = (block.axis === 0) ? end_cosine : ((-end_sine) * block.turn);
  const end_y = (block.axis === 0) ? (end_sine * block.turn) : end_cosine;
  const end = Point((start.x + end_x) - x, (start.y + end_y) - y);
  const centre = Point(start.x - x, start.y - y);
  return Curve(block.turn, start, end, centre, radius, Math.atan2(y, x), sweep * block.turn);
}

/**
 * Angle from 0 up to 2π.
 * @param {number} cosine
 * @param {number} sine
 * @returns {number}
 */
function _angle(cosine, sine) {
  const angle = Math.atan2(sine, cosine);
  return (angle < 0.0) ? (angle + (2.0 * Math.PI)) : angle;
}

/**
 * Length of a curve, µm.
 * @param {Curve} curve
 * @returns {number}
 */
export function length_of(curve) {
  if (curve.turn === 0) {
    return distance(curve.start, curve.end);
  }
  return curve.radius * Math.abs(curve.sweep_rad);
}

/**
 * Distance of two places, µm.
 * @param {Point} place
 * @param {Point} other
 * @returns {number}
 */
export function distance(place, other) {
  const x = place.x - other.x;
  const y = place.y - other.y;
  return Math.sqrt((x * x) + (y * y));
}

/**
 * The place at a share of a curve, 0 to 1.
 * @param {Curve} curve
 * @param {number} share
 * @returns {Point}
 */
export function point_on(curve, share) {
  if (share >= 1.0) {
    return curve.end;
  }
  if (curve.turn === 0) {
    const x = curve.end.x - curve.start.x;
    const y = curve.end.y - curve.start.y;
    return Point(curve.start.x + (share * x), curve.start.y + (share * y));
  }
  const angle = curve.start_rad + (share * curve.sweep_rad);
  return Point(curve.centre.x + (curve.radius * Math.cos(angle)), curve.centre.y + (curve.radius * Math.sin(angle)));
}

/**
 * Places along a curve, its start and its end among them: 25 on an arc, 9 on a line.
 * @param {Curve} curve
 * @returns {Point[]}
 */
export function points_on(curve) {
  const parts = (curve.turn === 0) ? _PARTS_OF_LINE : _PARTS_OF_ARC;
  return Array.from({ length: parts + 1 }, (_, at) => at).map((number) => point_on(curve, number / parts));
}

/**
 * Distance of a place from a curve, µm.
 * @param {Curve} curve
 * @param {Point} place
 * @returns {number}
 */
export function distance_to(curve, place) {
  const ends = Math.min(distance(curve.start, place), distance(curve.end, place));
  if (curve.turn === 0) {
    return Math.min(ends, _distance_to_line(curve, place));
  }
  const x = place.x - curve.centre.x;
  const y = place.y - curve.centre.y;
  let turned = (Math.atan2(y, x) - curve.start_rad) * curve.turn;
  turned -= (2.0 * Math.PI) * Math.floor(turned / (2.0 * Math.PI));
  if (turned <= Math.abs(curve.sweep_rad)) {
    return Math.abs(Math.sqrt((x * x) + (y * y)) - curve.radius);
  }
  return ends;
}

/**
 * Distance from where the foot of a place lies on a line, or infinity where it lies past an end.
 * @param {Curve} curve
 * @param {Point} place
 * @returns {number}
 */
function _distance_to_line(curve, place) {
  const by_x = curve.end.x - curve.start.x;
  const by_y = curve.end.y - curve.start.y;
  const x = place.x - curve.start.x;
  const y = place.y - curve.start.y;
  const square = (by_x * by_x) + (by_y * by_y);
  const along = (x * by_x) + (y * by_y);
  if ((square <= 0.0) || (along < 0.0) || (along > square)) {
    return Infinity;
  }
  return Math.abs((x * by_y) - (y * by_x)) / Math.sqrt(square);
}

/**
 * Signed area that a loop of curves encloses, µm², positive counter-clockwise; arcs as 24 chords.
 * @param {Curve[]} curves
 * @returns {number}
 */
export function area_of(curves) {
  let twice = 0.0;
  for (const curve of curves) {
    const points = points_on(curve);
    for (let number = 0; number < points.length - 1; number += 1) {
      const first = points[number];
      const last = points[number + 1];
      twice += (first.x * last.y) - (last.x * first.y);
    }
  }
  return twice / 2.0;
}
