// Point-by-point comparison: what a 3B controller looked at before each step, and what it made of it (docs/3b.md §3).

/**
 * @import { Replay } from "./decode.js"
 * @import { Axis } from "./document.js"
 */

/**
 * On an arc F = x² + y² − rSquared, x and y the place from the centre; the step leads toward the centre, or away.
 * @typedef {object} OnArc
 * @property {"arc"} kind
 * @property {string} motion
 * @property {number} x
 * @property {number} y
 * @property {bigint} rSquared
 * @property {bigint} f looked at
 * @property {bigint} fAfter of the step that follows
 * @property {Axis} axis of that step
 * @property {number} sign of that step
 * @property {"center" | "away"} toward
 */

/**
 * On a line F = wordX·y − wordY·x with X as first axis (L1, L3), F = wordY·x − wordX·y with Y, x and y the ways done;
 * the step is on the first axis, or on the second.
 * @typedef {object} OnLine
 * @property {"line"} kind
 * @property {string} motion
 * @property {number} x
 * @property {number} y
 * @property {bigint} f looked at
 * @property {bigint} fAfter of the step that follows
 * @property {Axis} axis of that step
 * @property {number} sign of that step
 * @property {"first" | "second"} toward
 */

/**
 * A decision before a step, from 1, of the block in a row; `counted` tells whether J counts the step.
 * @typedef {(OnArc | OnLine) & {
 *   step: number, row: number, wordX: number, wordY: number, rule: ">=0" | "<0", counted: boolean,
 * }} Decision
 */

/** Signs of X and Y in quadrants 1 to 4. */
const SIGNS = [[0, 0], [1, 1], [-1, 1], [-1, -1], [1, -1]];

/**
 * F ≥ 0: a step toward the centre; F < 0: one away from it. Each as axis and sign, by the quadrant of motion.
 * @type {Record<string, [axis: Axis, sign: number][]>}
 */
const OF_ARCS = {
  NR1: [["X", -1], ["Y", 1]],
  NR2: [["Y", -1], ["X", -1]],
  NR3: [["X", 1], ["Y", -1]],
  NR4: [["Y", 1], ["X", 1]],
  SR1: [["Y", -1], ["X", 1]],
  SR2: [["X", 1], ["Y", 1]],
  SR3: [["Y", 1], ["X", -1]],
  SR4: [["X", -1], ["Y", -1]],
};

/**
 * Quadrant that a motion from (x, y) about the centre is in; on an axis the one that is entered.
 * @param {number} x
 * @param {number} y
 * @param {number} turn
 * @returns {number}
 */
function motionQuadrant(x, y, turn) {
  if (turn < 0) return 5 - motionQuadrant(x, -y, 1); // clockwise is counter-clockwise in a mirror
  if (x > 0 && y >= 0) return 1;
  if (x <= 0 && y > 0) return 2;
  return x < 0 && y <= 0 ? 3 : 4;
}

/**
 * The decision on an arc at a place (x, y) from its centre.
 * @param {number} wordX
 * @param {number} wordY
 * @param {number} turn
 * @param {number} x
 * @param {number} y
 * @returns {OnArc}
 */
function onArc(wordX, wordY, turn, x, y) {
  const rSquared = BigInt(wordX) ** 2n + BigInt(wordY) ** 2n;
  /** @type {(atX: number, atY: number) => bigint} */
  const formula = (atX, atY) => BigInt(atX) ** 2n + BigInt(atY) ** 2n - rSquared;
  const motion = `${turn > 0 ? "NR" : "SR"}${motionQuadrant(x, y, turn)}`;
  const f = formula(x, y);
  const [axis, sign] = OF_ARCS[motion][f >= 0n ? 0 : 1];
  const fAfter = axis === "X" ? formula(x + sign, y) : formula(x, y + sign);
  return { kind: "arc", motion, x, y, rSquared, f, fAfter, axis, sign, toward: f >= 0n ? "center" : "away" };
}

/**
 * The decision on a line of which x and y, counted in its own quadrant, are done.
 * @param {number} wordX
 * @param {number} wordY
 * @param {number} quadrant
 * @param {number} x
 * @param {number} y
 * @returns {OnLine}
 */
function onLine(wordX, wordY, quadrant, x, y) {
  const firstIsX = quadrant % 2 === 1;
  /** @type {(doneX: number, doneY: number) => bigint} */
  const formula = (doneX, doneY) => {
    const across = BigInt(wordX) * BigInt(doneY) - BigInt(wordY) * BigInt(doneX);
    return firstIsX ? across : -across;
  };
  const f = formula(x, y);
  const axis = (f >= 0n) === firstIsX ? "X" : "Y";
  const sign = SIGNS[quadrant][axis === "X" ? 0 : 1];
  const fAfter = axis === "X" ? formula(x + 1, y) : formula(x, y + 1);
  return { kind: "line", motion: `L${quadrant}`, x, y, f, fAfter, axis, sign, toward: f >= 0n ? "first" : "second" };
}

/**
 * The decision before a step of the block in a row; null where the card interpolates.
 * @param {Pick<Replay, "doc" | "steps" | "way">} replay
 * @param {number} step
 * @param {number} row
 * @returns {Decision | null}
 */
export function decisionAt(replay, step, row) {
  const blocks = replay.doc.blocks;
  if (replay.doc.interpolator !== "point-by-point" || !(step >= 1 && step <= replay.steps)) return null;
  const begin = blocks.first_step[row];
  const [wordX, wordY] = [blocks.word_x_um[row], blocks.word_y_um[row]];
  const { x, y } = replay.way;
  const [dx, dy] = [x(step - 1) - x(begin), y(step - 1) - y(begin)];
  const quadrant = blocks.quadrant[row];
  const [sx, sy] = SIGNS[quadrant];
  const turn = blocks.turn[row];
  const made =
    turn !== 0
      ? onArc(wordX, wordY, turn, sx * wordX + dx, sy * wordY + dy)
      : onLine(wordX, wordY, quadrant, Math.abs(dx), Math.abs(dy));
  const rule = made.f >= 0n ? ">=0" : "<0";
  return { step, row, wordX, wordY, rule, counted: made.axis === blocks.count_axis[row], ...made };
}
