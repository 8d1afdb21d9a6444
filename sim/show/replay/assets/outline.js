// Closed outlines on a canvas.

/**
 * @import { Place } from "./document.js"
 * @import { Pen } from "./pen.js"
 * @import { View } from "./view.js"
 */

/**
 * Add closed outlines to the pen's path.
 * @param {Pen} pen
 * @param {View} view
 * @param {Place[][]} rings
 */
export function outline(pen, view, rings) {
  pen.beginPath();
  for (const ring of rings) {
    ring.forEach(([x, y], at) => (at ? pen.lineTo(view.toX(x), view.toY(y)) : pen.moveTo(view.toX(x), view.toY(y))));
    pen.closePath();
  }
}
