// The exact path: curves of its blocks on a canvas at any scale.
import { boxesOf, passed } from "./boxes.js";
import { inkOf } from "./ink.js";

/**
 * @import { Curves, Kind, Place } from "./document.js"
 * @import { Pen } from "./pen.js"
 * @import { Box, View } from "./view.js"
 */

/** @typedef {ReturnType<typeof pathOf>} Path */

const FAR = 4000; // px: arcs of a larger radius are drawn by points, for a canvas places them coarsely
const POINTS = 96; // of such an arc in the window
const TURN = 2 * Math.PI;
const LEAST = 0.35; // px: smaller blocks in turn are drawn as one line, up to where it is that long

/**
 * Where a curve leads after a share of its way, µm.
 * @param {Curves} path
 * @param {number} row
 * @param {number} share
 * @returns {Place}
 */
export function placeOn(path, row, share) {
  if (path.kind[row] === "arc") {
    const angle = path.start_angle_rad[row] + share * path.sweep_rad[row];
    return [path.center_x_um[row] + path.radius_um[row] * Math.cos(angle), path.center_y_um[row] + path.radius_um[row] * Math.sin(angle)];
  }
  const [x, y, toX, toY] = [path.place_x_um[row], path.place_y_um[row], path.place_x_um[row + 1], path.place_y_um[row + 1]];
  return [x + share * (toX - x), y + share * (toY - y)];
}

/**
 * Curves of a program; `wayTo` adds a block to the pen's path, from where the path ends or from its own start.
 * @param {Curves} blocks
 */
export function pathOf(blocks) {
  const boxes = boxesOf(blocks);

  /**
   * The stretch of a far arc that can show, by points about the window.
   * @param {Pen} pen
   * @param {View} view
   * @param {number} row
   */
  function farArc(pen, view, row) {
    const [centerX, centerY] = [blocks.center_x_um[row], blocks.center_y_um[row]];
    const [radius, start, sweep] = [blocks.radius_um[row], blocks.start_angle_rad[row], blocks.sweep_rad[row]];
    const [x, y] = view.center;
    const reach = Math.min(Math.PI, Math.hypot(view.width, view.height) / view.scale / radius);
    const middle = passed(start, Math.atan2(y - centerY, x - centerX), sweep);
    for (const shift of [-TURN, 0, TURN]) {
      const since = Math.max(0, middle + shift - reach);
      const until = Math.min(Math.abs(sweep), middle + shift + reach);
      for (let point = 0; point <= POINTS && until > since; point++) {
        const angle = start + Math.sign(sweep) * (since + ((until - since) * point) / POINTS);
        const px = view.toX(centerX + radius * Math.cos(angle));
        const py = view.toY(centerY + radius * Math.sin(angle));
        if (point === 0) pen.moveTo(px, py);
        else pen.lineTo(px, py);
      }
    }
  }

  /**
   * Add a block to the pen's path.
   * @param {Pen} pen
   * @param {View} view
   * @param {number} row
   */
  function wayOf(pen, view, row) {
    const isArc = blocks.kind[row] === "arc";
    const radius = isArc ? blocks.radius_um[row] * view.scale : 0;
    if (isArc && radius > FAR) {
      farArc(pen, view, row);
      return;
    }
    pen.moveTo(view.toX(blocks.place_x_um[row]), view.toY(blocks.place_y_um[row]));
    if (isArc && radius > 0.5) {
      const start = -blocks.start_angle_rad[row];
      const [x, y] = [view.toX(blocks.center_x_um[row]), view.toY(blocks.center_y_um[row])];
      pen.arc(x, y, radius, start, start - blocks.sweep_rad[row], blocks.sweep_rad[row] > 0);
    } else {
      pen.lineTo(view.toX(blocks.place_x_um[row + 1]), view.toY(blocks.place_y_um[row + 1]));
    }
  }

  /**
   * Stroke all blocks of some kinds that come near the window, as the pen is set; how many points that took. A line may
   * be so many times as far off as else.
   * @param {Pen} pen
   * @param {View} view
   * @param {(kind: Kind, row: number) => boolean} isWanted
   */
  function stroke(pen, view, isWanted, coarseness = 1) {
    const [xs, ys, least] = [blocks.place_x_um, blocks.place_y_um, (LEAST * coarseness) / view.scale];
    const ink = inkOf(pen);
    let [first, past] = [0, 0]; // rows of the small blocks that are not drawn yet

    /** Draw those as one line. */
    function drawSmall() {
      if (first === past) return;
      pen.moveTo(view.toX(xs[first]), view.toY(ys[first]));
      pen.lineTo(view.toX(xs[past]), view.toY(ys[past]));
      ink.took(1);
      first = past;
    }

    boxes.visitNear(view.bounds(4), (row) => {
      if (!isWanted(blocks.kind[row], row)) return;
      const isSmall = boxes.size(row) < least;
      if (row !== past || !isSmall) drawSmall();
      if (isSmall) {
        if (first === past) first = row;
        past = row + 1;
        if (Math.max(Math.abs(xs[past] - xs[first]), Math.abs(ys[past] - ys[first])) >= least) drawSmall();
      } else {
        wayOf(pen, view, row);
        ink.took(1);
      }
    });
    drawSmall();
    ink.flush();
    return ink.points;
  }

  /**
   * Rows of the blocks that come near a box.
   * @param {Box} near
   */
  function rowsNear(near) {
    /** @type {number[]} */
    const rows = [];
    boxes.visitNear(near, (row) => rows.push(row));
    return rows;
  }

  return { box: boxes.all, wayOf, stroke, rowsNear };
}
