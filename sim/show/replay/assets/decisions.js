// Point-by-point comparison: what a 3B controller looked at before each step, and what it made of it (docs/3b.md §3).
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});

  /** Signs of X and Y in quadrants 1 to 4. */
  const SIGNS = [[0, 0], [1, 1], [-1, 1], [-1, -1], [1, -1]];

  /** F ≥ 0: a step toward the centre; F < 0: one away from it. Each as axis and sign, by the quadrant of motion. */
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

  /** Quadrant that a motion from (x, y) about the centre is in; on an axis the one that is entered. */
  function motionQuadrant(x, y, turn) {
    if (turn > 0) {
      if (x > 0 && y >= 0) return 1;
      if (x <= 0 && y > 0) return 2;
      return x < 0 && y <= 0 ? 3 : 4;
    }
    if (x >= 0 && y > 0) return 1;
    if (x > 0 && y <= 0) return 4;
    return x <= 0 && y < 0 ? 3 : 2;
  }

  /** The decision on an arc at a place (x, y) from its centre. */
  function onArc(wordX, wordY, turn, x, y) {
    const rSquared = BigInt(wordX) ** 2n + BigInt(wordY) ** 2n;
    const formula = (x, y) => BigInt(x) ** 2n + BigInt(y) ** 2n - rSquared;
    const motion = (turn > 0 ? "NR" : "SR") + motionQuadrant(x, y, turn);
    const f = formula(x, y);
    const [axis, sign] = OF_ARCS[motion][f >= 0n ? 0 : 1];
    const fAfter = axis === "X" ? formula(x + sign, y) : formula(x, y + sign);
    return { kind: "arc", motion, x, y, rSquared, f, fAfter, axis, sign, toward: f >= 0n ? "center" : "away" };
  }

  /** The decision on a line of which x and y, counted in its own quadrant, are done. */
  function onLine(wordX, wordY, quadrant, x, y) {
    const firstIsX = quadrant % 2 === 1;
    const across = (x, y) => BigInt(wordX) * BigInt(y) - BigInt(wordY) * BigInt(x);
    const formula = firstIsX ? across : (x, y) => -across(x, y);
    const f = formula(x, y);
    const axis = (f >= 0n) === firstIsX ? "X" : "Y";
    const sign = SIGNS[quadrant][axis === "X" ? 0 : 1];
    const fAfter = axis === "X" ? formula(x + 1, y) : formula(x, y + 1);
    return { kind: "line", motion: "L" + quadrant, x, y, f, fAfter, axis, sign, toward: f >= 0n ? "first" : "second" };
  }

  /**
   * The decision before a step, from 1, of the block in a row; null where the card interpolates.
   *
   * {step, row, kind, motion, x, y, wordX, wordY, rSquared, f, fAfter, axis, sign, toward, rule, counted}: `f` looked
   * at, `rule` ">=0" or "<0", the step that follows along `axis` by `sign` "toward" the "center", "away" from it, or on
   * the "first" or "second" axis of a line, and `fAfter`. `x`, `y` stand in the formula: on an arc
   * F = x² + y² − rSquared, the place from the centre; on a line F = wordX·y − wordY·x with X as first axis (L1, L3),
   * F = wordY·x − wordX·y with Y, the ways done. F and rSquared are BigInt. `counted` tells whether J counts the step.
   */
  function decision(replay, step, row) {
    const blocks = replay.doc.blocks;
    if (replay.doc.interpolator !== "point-by-point" || !(step >= 1 && step <= replay.steps)) return null;
    const begin = blocks.first_step[row];
    const [wordX, wordY] = [blocks.word_x_um[row], blocks.word_y_um[row]];
    const [dx, dy] = [replay.x[step - 1] - replay.x[begin], replay.y[step - 1] - replay.y[begin]];
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

  Drycut.decision = decision;
})(globalThis);
