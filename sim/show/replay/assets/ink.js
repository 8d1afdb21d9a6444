// Strokes of a long path in bunches: a canvas takes longer for one path of many points than for many of few.

/** @import { Pen } from "./pen.js" */

const BUNCH = 500; // points

/** @typedef {ReturnType<typeof inkOf>} Ink */

/**
 * Ink of a pen, as it is set; its path begins here.
 * @param {Pen} pen
 */
export function inkOf(pen) {
  let held = 0;
  let all = 0;
  pen.beginPath();

  /** Stroke what the path has, and begin it anew. */
  function flush() {
    pen.stroke();
    pen.beginPath();
    held = 0;
  }

  return {
    /** How many points it was given so far. */
    get points() { return all; },
    flush,
    /**
     * So many more points are in the path; true where it begins anew, so that what goes on must move there first.
     * @param {number} points
     */
    took(points) {
      all += points;
      held += points;
      if (held < BUNCH) return false;
      flush();
      return true;
    },
  };
}
