// The way of the axes: where they stand after each step, and when. Of a step two bytes or so are kept, as the tape has
// them; where one asks, its run of steps is worked out from the mark before it.
import { fill } from "../../html/assets/packed.js";
import { clamp, countUpTo } from "./numbers.js";

/**
 * @import { Tape } from "./document.js"
 * @import { Box } from "./view.js"
 */

/** @typedef {ReturnType<typeof wayOf>} Way */

/**
 * Some steps in turn: the first of them, how many, where the axes stand after each, how many so far moved X, and when.
 * @typedef {object} Run
 * @property {number} first
 * @property {number} size
 * @property {Int32Array} x
 * @property {Int32Array} y
 * @property {Int32Array} inX
 * @property {Float64Array} t
 */

const RUN = 512; // steps from mark to mark
const HELD = 64; // runs that are held as worked out
const BY_X = [-1, -1, -1, 0, 0, 0, 1, 1, 1]; // of each way that a step can go
const BY_Y = [-1, 0, 1, -1, 0, 1, -1, 0, 1];

/** @returns {Run} */
function emptyRun() {
  const [x, y, inX] = [new Int32Array(RUN), new Int32Array(RUN), new Int32Array(RUN)];
  return { first: 0, size: 0, x, y, inX, t: new Float64Array(RUN) };
}

/**
 * What goes on from step to step: place, steps in X, ticks, the byte that is read next, and how long the last step of
 * each way took.
 * @param {Tape} tape
 */
function startOf({ origin_um: [x, y] }) {
  return { x, y, inX: 0, ticks: 0, at: 0, took: new Float64Array(BY_X.length) };
}

/**
 * Way of a tape by the ways of its steps, and by bytes of the time that each took more than the last one of its way. Step
 * 0 is the start.
 * @param {Tape} tape
 * @param {Uint8Array} ways
 * @param {Uint8Array} more
 */
export function wayOf(tape, ways, more) {
  const { steps, tick_s: tick } = tape;
  const runs = Math.floor(steps / RUN) + 1;
  /** @type {ReturnType<typeof startOf>[]} */
  const marks = [];
  const begins = new Float64Array(runs); // times of the first steps
  const boxes = new Int32Array(4 * runs); // left, bottom, right, top in turn
  /** @type {Map<number, Run>} */
  const held = new Map();
  const mores = new Float64Array(RUN);

  /**
   * Go through a run from its mark; `visit(index)` hears of each step. Gives what goes on behind it.
   * @param {number} run
   * @param {(index: number, state: ReturnType<typeof startOf>) => void} visit
   */
  function go(run, visit) {
    const state = { ...marks[run], took: marks[run].took.slice() };
    const [first, count] = [run * RUN, Math.min(RUN, steps - run * RUN)];
    state.at = fill(mores, more, count, state.at);
    for (let index = 0; index < count; index++) {
      visit(index, state);
      const way = ways[first + index];
      state.x += BY_X[way];
      state.y += BY_Y[way];
      state.inX += BY_X[way] & 1;
      state.ticks += state.took[way] += mores[index];
    }
    if (count < RUN) visit(count, state);
    return state;
  }

  /** Set the marks, and the boxes of the runs. */
  function mark() {
    for (let run = 0, state = startOf(tape); run < runs; run++) {
      marks.push(state);
      begins[run] = state.ticks * tick;
      let [left, bottom, right, top] = [state.x, state.y, state.x, state.y];
      state = go(run, (_, { x, y }) => {
        if (x < left) left = x;
        else if (x > right) right = x;
        if (y < bottom) bottom = y;
        else if (y > top) top = y;
      });
      boxes.set([left, bottom, right, top], 4 * run);
    }
  }

  /** Memory for a run: that of the oldest one where enough are held, for a pass over all would leave much behind. */
  function room() {
    const oldest = held.size < HELD ? undefined : held.entries().next().value;
    if (!oldest) return emptyRun();
    held.delete(oldest[0]);
    return oldest[1];
  }

  /**
   * A run by its number; it holds until so many others are asked for.
   * @param {number} run
   */
  function runOf(run) {
    const known = held.get(run);
    if (known) return known;
    const made = room();
    const { x, y, inX, t } = made;
    made.first = run * RUN;
    made.size = Math.min(RUN, steps + 1 - made.first);
    go(run, (index, state) => {
      [x[index], y[index], inX[index], t[index]] = [state.x, state.y, state.inX, state.ticks * tick];
    });
    held.set(run, made);
    return made;
  }

  /**
   * What stands in a column of a run for a step.
   * @param {"x" | "y" | "inX" | "t"} column
   */
  const of = (column) => (/** @type {number} */ step) => runOf(Math.floor(step / RUN))[column][step % RUN];

  mark();
  return {
    x: of("x"),
    y: of("y"),
    inX: of("inX"),
    t: of("t"),
    /**
     * Visit the runs of steps that come near a box.
     * @param {Box} near
     * @param {(run: Run) => void} visit
     */
    visitNear(near, visit) {
      for (let run = 0, at = 0; run < runs; run++, at += 4) {
        const isNear = boxes[at] <= near.right && boxes[at + 2] >= near.left
          && boxes[at + 1] <= near.top && boxes[at + 3] >= near.bottom;
        if (isNear) visit(runOf(run));
      }
    },
    /**
     * How many steps are done by a time.
     * @param {number} time
     */
    doneBy(time) {
      const run = clamp(countUpTo(begins, time) - 1, 0, runs - 1);
      const { t, size } = runOf(run);
      return run * RUN + Math.max(0, countUpTo(t, time, size) - 1);
    },
  };
}
