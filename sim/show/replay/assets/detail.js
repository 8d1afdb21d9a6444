// A long polyline at many levels of detail, so that a frame draws the points it can show and no more.
import { countUpTo } from "./numbers.js";

/** @import { Box } from "./view.js" */

/** @typedef {(points: Int32Array, at: number, past: number) => void} Visit Takes a run of points, as indices. */

const FINEST = 0.25; // µm
const COARSER = 4; // from level to level
const LEVELS = 7; // up to 1 mm
const RUN = 128; // points that share one box
const SHOWN = 0.3; // px that a line may be off

/**
 * Angle between -π and π.
 * @param {number} angle
 */
const wrapped = (angle) => (angle > Math.PI ? angle - 2 * Math.PI : angle < -Math.PI ? angle + 2 * Math.PI : angle);

/**
 * The sleeve of Zhao and Saalfeld: tells whether a line from its start passes all points since near enough.
 * @param {Float64Array} x
 * @param {Float64Array} y
 * @param {number} tolerance
 */
function sleeve(x, y, tolerance) {
  let start = 0;
  let toward = 0; // direction of the first point that is away from the start
  let low = -Infinity; // turns from it that pass all points
  let high = Infinity;
  let farthest = 0;
  return {
    /** @param {number} index */
    restart(index) {
      start = index;
      low = -Infinity;
      high = Infinity;
      farthest = 0;
    },
    /**
     * Take one more point; false where the line from the start cannot go on to it.
     * @param {number} index
     */
    takes(index) {
      const dx = x[index] - x[start];
      const dy = y[index] - y[start];
      const away = Math.sqrt(dx * dx + dy * dy);
      if (away < farthest - tolerance) return false; // it comes back
      if (away <= tolerance) return true;
      const angle = Math.atan2(dy, dx);
      if (low === -Infinity) toward = angle;
      const turn = wrapped(angle - toward);
      if (turn < low || turn > high) return false;
      const half = Math.asin(tolerance / away);
      low = Math.max(low, turn - half);
      high = Math.min(high, turn + half);
      farthest = Math.max(farthest, away);
      return true;
    },
  };
}

/**
 * Points of `from` (indices) that keep the line within about `tolerance` of it.
 * @param {Float64Array} x
 * @param {Float64Array} y
 * @param {Int32Array} from
 * @param {number} tolerance
 * @param {Uint8Array} mustKeep
 */
function thinned(x, y, from, tolerance, mustKeep) {
  const kept = new Int32Array(from.length);
  const line = sleeve(x, y, tolerance);
  let count = 0;
  /** @param {number} index */
  const keep = (index) => {
    kept[count++] = index;
    line.restart(index);
  };
  keep(from[0]);
  for (let at = 1; at < from.length; at++) {
    if (!line.takes(from[at])) {
      keep(from[at - 1]);
      line.takes(from[at]);
    }
    if (mustKeep[from[at]]) keep(from[at]);
  }
  const last = from[from.length - 1];
  if (kept[count - 1] !== last) kept[count++] = last;
  return kept.slice(0, count);
}

/**
 * Boxes of runs of points: left, bottom, right, top of each in turn.
 * @param {Float64Array} x
 * @param {Float64Array} y
 * @param {Int32Array} points
 */
function boxesOf(x, y, points) {
  const boxes = new Float64Array(4 * Math.ceil(points.length / RUN));
  for (let run = 0, box = 0; run < points.length; run += RUN, box += 4) {
    const past = Math.min(run + RUN + 1, points.length); // with the first of the next: lines lead there
    let [left, bottom, right, top] = [Infinity, Infinity, -Infinity, -Infinity];
    for (let at = run; at < past; at++) {
      const px = x[points[at]];
      const py = y[points[at]];
      if (px < left) left = px;
      if (px > right) right = px;
      if (py < bottom) bottom = py;
      if (py > top) top = py;
    }
    boxes.set([left, bottom, right, top], box);
  }
  return boxes;
}

/**
 * Levels of the polyline x, y; points with `mustKeep` are on all of them.
 * @param {Float64Array} x
 * @param {Float64Array} y
 * @param {Uint8Array} mustKeep
 */
export function detailOf(x, y, mustKeep) {
  let points = Int32Array.from({ length: x.length }, (_, index) => index);
  const levels = [{ tolerance: 0, points, boxes: boxesOf(x, y, points) }];
  for (let level = 0, tolerance = FINEST; level < LEVELS && points.length > 2; level++, tolerance *= COARSER) {
    points = thinned(x, y, points, tolerance, mustKeep);
    levels.push({ tolerance, points, boxes: boxesOf(x, y, points) });
  }

  /**
   * The coarsest level that is true enough at a scale.
   * @param {number} scale
   */
  function levelFor(scale) {
    let level = levels.length - 1;
    while (level > 0 && levels[level].tolerance * scale > SHOWN) level--;
    return level;
  }

  /**
   * Visit runs of points of a level from index `first` to `last` that come near a box; `visit(points, at, past)`.
   * @param {number} level
   * @param {number} first
   * @param {number} last
   * @param {Box} near
   * @param {Visit} visit
   */
  function visitRuns(level, first, last, near, visit) {
    const { points: kept, boxes } = levels[level];
    const start = Math.max(0, countUpTo(kept, first) - 1);
    const past = countUpTo(kept, last);
    for (let at = start; at < past; ) {
      const run = Math.floor(at / RUN);
      const end = Math.min((run + 1) * RUN, past);
      const [left, bottom, right, top] = boxes.subarray(4 * run, 4 * run + 4);
      if (left <= near.right && near.left <= right && bottom <= near.top && near.bottom <= top) visit(kept, at, Math.min(end + 1, past));
      at = end;
    }
    return past ? kept[past - 1] : 0;
  }

  return {
    /**
     * As `visitRuns`, with ever finer levels up to exactly `last`.
     * @param {number} scale
     * @param {number} first
     * @param {number} last
     * @param {Box} near
     * @param {Visit} visit
     */
    visit(scale, first, last, near, visit) {
      let since = first;
      for (let level = levelFor(scale); level >= 0 && since < last; level--) {
        since = Math.max(since, visitRuns(level, since, last, near, visit));
      }
    },
  };
}
