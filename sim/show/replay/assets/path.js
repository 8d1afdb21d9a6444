// The exact path: boxes of its blocks, and their curves on a canvas at any scale.

/**
 * @import { Curves, Kind } from "./document.js"
 * @import { Pen } from "./pen.js"
 * @import { Box, View } from "./view.js"
 */

/** @typedef {ReturnType<typeof pathOf>} Path */

const FAR = 4000; // px: arcs of a larger radius are drawn by points, for a canvas places them coarsely
const POINTS = 96; // of such an arc in the window
const TURN = 2 * Math.PI;

/**
 * Angle from `start` on to `angle` in the sense of `sweep`, from 0 up to a turn.
 * @param {number} start
 * @param {number} angle
 * @param {number} sweep
 */
function passed(start, angle, sweep) {
  const turn = (sweep > 0 ? angle - start : start - angle) % TURN;
  return turn < 0 ? turn + TURN : turn;
}

/**
 * Box of each block: left, bottom, right, top in turn.
 * @param {Curves} blocks
 */
function boxesOf(blocks) {
  const count = blocks.kind.length;
  const boxes = new Float64Array(4 * count);
  for (let row = 0; row < count; row++) boxes.set(boxOf(blocks, row), 4 * row);
  return boxes;
}

/**
 * Box of a block; an arc reaches each extreme that it passes.
 * @param {Curves} blocks
 * @param {number} row
 */
function boxOf(blocks, row) {
  const xs = [blocks.place_x_um[row], blocks.place_x_um[row + 1]];
  const ys = [blocks.place_y_um[row], blocks.place_y_um[row + 1]];
  if (blocks.kind[row] === "arc") {
    const [start, sweep, radius] = [blocks.start_angle_rad[row], blocks.sweep_rad[row], blocks.radius_um[row]];
    for (let quarter = 0; quarter < 4; quarter++) {
      if (passed(start, (quarter * Math.PI) / 2, sweep) > Math.abs(sweep)) continue;
      xs.push(blocks.center_x_um[row] + radius * [1, 0, -1, 0][quarter]);
      ys.push(blocks.center_y_um[row] + radius * [0, 1, 0, -1][quarter]);
    }
  }
  return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
}

/**
 * Curves of a program; `wayTo` adds a block to the pen's path, from where the path ends or from its own start.
 * @param {Curves} blocks
 */
export function pathOf(blocks) {
  const count = blocks.kind.length;
  const boxes = boxesOf(blocks);

  /**
   * Box of all blocks.
   * @returns {Box}
   */
  function box() {
    const all = { left: Infinity, bottom: Infinity, right: -Infinity, top: -Infinity };
    for (let row = 0; row < count; row++) {
      all.left = Math.min(all.left, boxes[4 * row]);
      all.bottom = Math.min(all.bottom, boxes[4 * row + 1]);
      all.right = Math.max(all.right, boxes[4 * row + 2]);
      all.top = Math.max(all.top, boxes[4 * row + 3]);
    }
    return all;
  }

  /**
   * Whether a block comes near what shows.
   * @param {number} row
   * @param {Box} near
   */
  function shows(row, near) {
    return boxes[4 * row] <= near.right && near.left <= boxes[4 * row + 2]
      && boxes[4 * row + 1] <= near.top && near.bottom <= boxes[4 * row + 3];
  }

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
   * Stroke all blocks of some kinds that come near the window, as the pen is set.
   * @param {Pen} pen
   * @param {View} view
   * @param {(kind: Kind) => boolean} isWanted
   */
  function stroke(pen, view, isWanted) {
    const near = view.bounds(4);
    pen.beginPath();
    for (let row = 0; row < count; row++) {
      if (isWanted(blocks.kind[row]) && shows(row, near)) wayOf(pen, view, row);
    }
    pen.stroke();
  }

  /**
   * Rows of the blocks that come near a box.
   * @param {Box} near
   */
  function rowsNear(near) {
    const rows = [];
    for (let row = 0; row < count; row++) if (shows(row, near)) rows.push(row);
    return rows;
  }

  return { box, wayOf, stroke, rowsNear };
}
