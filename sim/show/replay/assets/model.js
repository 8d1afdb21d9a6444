// What a replay knows of any moment and any step of it; nothing here knows the page.
import { decisionAt } from "./decisions.js";
import { foot } from "./nearest.js";
import { clamp, countUpTo } from "./numbers.js";

/**
 * @import { Replay, Samples } from "./decode.js"
 * @import { Place, Plan } from "./document.js"
 */

/** @typedef {ReturnType<typeof modelOf>} Model */
/** @typedef {{ at: number, next: number, share: number }} Between Two samples, and the share of the way between them. */
/** @typedef {{ um: number, foot: Place }} Deviation */

/**
 * What the controller commands at a time, where table and wire really are, feed, and what is left.
 * @typedef {object} State
 * @property {number} t
 * @property {number} step
 * @property {number} block its row
 * @property {number} x
 * @property {number} y
 * @property {Place} wire
 * @property {Place} table
 * @property {number} feed_um_s
 * @property {number | null} count_left
 * @property {number} remaining_s
 */

/**
 * Planned speed at a time.
 * @param {Plan} plan
 * @param {number} t
 */
function plannedSpeed(plan, t) {
  const phases = plan.speed_um_s.length;
  if (!phases || t > plan.t_s[phases]) return 0;
  const at = clamp(countUpTo(plan.t_s, t) - 1, 0, phases - 1);
  const dt = t - plan.t_s[at];
  const [v, a] = [plan.speed_um_s[at], plan.acceleration_um_s2[at]];
  const j = plan.jerk_um_s3 ? plan.jerk_um_s3[at] : 0;
  return Math.max(v + dt * (a + (dt * j) / 2), 0);
}

/**
 * Between which samples a time lies, and how far from the first to the second.
 * @param {Samples} samples
 * @param {number} t
 * @returns {Between}
 */
function sampleAt(samples, t) {
  const last = samples.t.length - 1;
  const at = clamp(countUpTo(samples.t, t) - 1, 0, last);
  const next = Math.min(at + 1, last);
  const span = samples.t[next] - samples.t[at];
  return { at, next, share: span > 0 ? clamp((t - samples.t[at]) / span, 0, 1) : 0 };
}

/**
 * Column between two samples.
 * @param {Float64Array} column
 * @param {Between} sample
 */
const between = (column, { at, next, share }) => column[at] + share * (column[next] - column[at]);

/**
 * Questions about a replay as functions; steps count from 1, step 0 is the start, and rows of blocks from 0.
 * @param {Replay} replay
 */
export function modelOf(replay) {
  const { doc, samples, way } = replay;
  const blocks = doc.blocks;
  const rows = blocks.kind.length;

  /**
   * Number of steps done by a time.
   * @param {number} t
   */
  const stepAt = (t) => way.doneBy(t);
  /**
   * Time at which a step is done.
   * @param {number} step
   */
  const timeOf = (step) => way.t(clamp(step, 0, replay.steps));
  /**
   * Row of the block that runs at a time.
   * @param {number} t
   */
  const blockAt = (t) => clamp(countUpTo(blocks.border_s, t) - 1, 0, rows - 1);
  /**
   * Row of the block that makes a step.
   * @param {number} step
   */
  const blockOfStep = (step) => clamp(countUpTo(blocks.first_step, Math.max(step, 1) - 1) - 1, 0, rows - 1);

  /**
   * J that is left of the block in a row once so many steps are done; null where the card interpolates.
   * @param {number} row
   * @param {number} step
   */
  function countLeft(row, step) {
    if (doc.interpolator !== "point-by-point") return null;
    const begin = blocks.first_step[row];
    const done = clamp(step, begin, blocks.first_step[row + 1]);
    const inX = way.inX(done) - way.inX(begin);
    return blocks.count_um[row] - (blocks.count_axis[row] === "X" ? inX : done - begin - inX);
  }

  /**
   * State at a time: what the controller commands, where table and wire really are, feed, and what is left.
   * @param {number} time
   * @returns {State}
   */
  function stateAt(time) {
    const t = clamp(time, 0, doc.duration_s);
    const [step, row] = [stepAt(t), blockAt(t)];
    const sample = sampleAt(samples, t);
    return {
      t,
      step,
      block: row,
      x: way.x(step),
      y: way.y(step),
      wire: [between(samples.wireX, sample), between(samples.wireY, sample)],
      table: [between(samples.tableX, sample), between(samples.tableY, sample)],
      feed_um_s: plannedSpeed(doc.plan, t),
      count_left: countLeft(row, step),
      remaining_s: doc.duration_s - t,
    };
  }

  /**
   * What the controller looked at before a step: see decisions.js.
   * @param {number} step
   */
  const decision = (step) => decisionAt(replay, step, blockOfStep(step));

  /**
   * How far the wire is from the ideal path, and from which place on it; between two samples both go straight.
   * @param {number} t
   * @returns {Deviation}
   */
  function deviation(t) {
    const sample = sampleAt(samples, clamp(t, 0, doc.duration_s));
    const { wireX, wireY, footRow } = samples;
    const [here, next] = [sample.at, sample.next].map((at) => foot(blocks, footRow[at], wireX[at], wireY[at]));
    /** @type {Place} */
    const on = [here[0] + sample.share * (next[0] - here[0]), here[1] + sample.share * (next[1] - here[1])];
    return { um: Math.hypot(between(wireX, sample) - on[0], between(wireY, sample) - on[1]), foot: on };
  }

  const duration = doc.duration_s;
  return { duration, stepAt, timeOf, blockAt, blockOfStep, countLeft, stateAt, decision, deviation };
}
