// What a replay knows of any moment and any step of it; nothing here knows the page.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});

  /** How many of the entries of a rising column are no more than a value. */
  function countUpTo(column, value) {
    let low = 0;
    let high = column.length;
    while (low < high) {
      const middle = (low + high) >> 1;
      if (column[middle] <= value) low = middle + 1;
      else high = middle;
    }
    return low;
  }

  /** A value put between two bounds. */
  const held = (value, low, high) => Math.min(Math.max(value, low), high);

  /** Planned speed at a time. */
  function plannedSpeed(plan, t) {
    const phases = plan.speed_um_s.length;
    if (!phases || t > plan.t_s[phases]) return 0;
    const at = held(countUpTo(plan.t_s, t) - 1, 0, phases - 1);
    const dt = t - plan.t_s[at];
    const [v, a] = [plan.speed_um_s[at], plan.acceleration_um_s2[at]];
    const j = plan.jerk_um_s3 ? plan.jerk_um_s3[at] : 0;
    return Math.max(v + dt * (a + (dt * j) / 2), 0);
  }

  /** Between which samples a time lies, and how far from the first to the second. */
  function sampleAt(samples, t) {
    const last = samples.t.length - 1;
    const at = held(countUpTo(samples.t, t) - 1, 0, last);
    const next = Math.min(at + 1, last);
    const span = samples.t[next] - samples.t[at];
    return { at, next, share: span > 0 ? held((t - samples.t[at]) / span, 0, 1) : 0 };
  }

  /** Column between two samples. */
  const between = (column, { at, next, share }) => column[at] + share * (column[next] - column[at]);

  /** Questions about a replay as functions; steps count from 1, step 0 is the start, and rows of blocks from 0. */
  function model(replay) {
    const { doc, samples } = replay;
    const blocks = doc.blocks;
    const rows = blocks.kind.length;

    /** Number of steps done by a time. */
    const stepAt = (t) => Math.max(countUpTo(replay.t, t) - 1, 0);
    /** Time at which a step is done. */
    const timeOf = (step) => replay.t[held(step, 0, replay.steps)];
    /** Row of the block that runs at a time. */
    const blockAt = (t) => held(countUpTo(blocks.border_s, t) - 1, 0, rows - 1);
    /** Row of the block that makes a step. */
    const blockOfStep = (step) => held(countUpTo(blocks.first_step, Math.max(step, 1) - 1) - 1, 0, rows - 1);

    /** J that is left of the block in a row once so many steps are done; null where the card interpolates. */
    function countLeft(row, step) {
      if (doc.interpolator !== "point-by-point") return null;
      const begin = blocks.first_step[row];
      const done = held(step, begin, blocks.first_step[row + 1]);
      const inX = replay.xSteps[done] - replay.xSteps[begin];
      return blocks.count_um[row] - (blocks.count_axis[row] === "X" ? inX : done - begin - inX);
    }

    /** State at a time: what the controller commands, where table and wire really are, feed, and what is left. */
    function stateAt(time) {
      const t = held(time, 0, doc.duration_s);
      const [step, row] = [stepAt(t), blockAt(t)];
      const sample = sampleAt(samples, t);
      return {
        t,
        step,
        block: row,
        x: replay.x[step],
        y: replay.y[step],
        wire: [between(samples.wireX, sample), between(samples.wireY, sample)],
        table: [between(samples.tableX, sample), between(samples.tableY, sample)],
        feed_um_s: plannedSpeed(doc.plan, t),
        count_left: countLeft(row, step),
        remaining_s: doc.duration_s - t,
      };
    }

    /** What the controller looked at before a step: see decisions.js. */
    const decision = (step) => Drycut.decision(replay, step, blockOfStep(step));

    /** How far the wire is from the ideal path, and from which place on it: {um, foot}; between samples both go straight. */
    function deviation(t) {
      const sample = sampleAt(samples, held(t, 0, doc.duration_s));
      const { wireX, wireY, footRow } = samples;
      const [here, next] = [sample.at, sample.next].map((at) => Drycut.foot(blocks, footRow[at], wireX[at], wireY[at]));
      const foot = [0, 1].map((axis) => here[axis] + sample.share * (next[axis] - here[axis]));
      return { um: Math.hypot(between(wireX, sample) - foot[0], between(wireY, sample) - foot[1]), foot };
    }

    const duration = doc.duration_s;
    return { duration, stepAt, timeOf, blockAt, blockOfStep, countLeft, stateAt, decision, deviation };
  }

  Object.assign(Drycut, { model, countUpTo });
})(globalThis);
