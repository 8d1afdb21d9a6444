// What is picked of a drawing: where its places lie beneath a program, and their marks.

/** @import { Placement } from "./data.js" */
/** @import { View } from "../../replay/assets/view.js" */

/** @type {Placement} */
export const IN_PLACE = { turn_rad: 0, shift_um: [0, 0], mirror: false };

/**
 * A place of the drawing as it lies beneath the program.
 * @param {Placement} placement
 * @param {[x: number, y: number]} place
 * @returns {[x: number, y: number]}
 */
export function laid({ turn_rad: turn, shift_um: [byX, byY], mirror }, [x, y]) {
  const [cos, sin, own] = [Math.cos(turn), Math.sin(turn), mirror ? -x : x];
  return [cos * own - sin * y + byX, sin * own + cos * y + byY];
}

/**
 * The place of the drawing that lies somewhere beneath the program.
 * @param {Placement} placement
 * @param {[x: number, y: number]} place
 * @returns {[x: number, y: number]}
 */
export function lifted({ turn_rad: turn, shift_um: [byX, byY], mirror }, [x, y]) {
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const own = cos * (x - byX) + sin * (y - byY);
  return [mirror ? -own : own, cos * (y - byY) - sin * (x - byX)];
}

/**
 * The place that a pick names, mm; null where it names something else.
 * @param {string} pick
 * @returns {[x: number, y: number] | null}
 */
export function placeOf(pick) {
  const [, x, y] = /^(-?[\d.]+) *, *(-?[\d.]+)$/.exec(pick) ?? [];
  return x && y ? [Number(x), Number(y)] : null;
}

/**
 * Draw the marks of what is picked.
 * @param {CanvasRenderingContext2D} pen
 * @param {View} view
 * @param {[x: number, y: number][]} places
 * @param {string} shade
 */
export function drawPicks(pen, view, places, shade) {
  pen.fillStyle = pen.strokeStyle = shade;
  pen.lineWidth = 2;
  for (const [x, y] of places) {
    for (const radius of [9, 5]) {
      pen.beginPath();
      pen.arc(view.toX(x), view.toY(y), radius, 0, 2 * Math.PI);
      if (radius === 5) pen.fill();
      else pen.stroke();
    }
  }
}
