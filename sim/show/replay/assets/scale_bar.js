// A scale bar of a round length in the corner of the table.

/**
 * @import { Colours } from "./palette.js"
 * @import { Pen } from "./pen.js"
 * @import { View } from "./view.js"
 */

const LONGEST = 140; // px

/**
 * Longest of 1, 2, 5, 10 … µm that is no longer than so many.
 * @param {number} most
 */
function roundLength(most) {
  const decade = 10 ** Math.floor(Math.log10(most));
  return ([5, 2].find((digit) => digit * decade <= most) ?? 1) * decade;
}

/**
 * Draw the bar at the lower left.
 * @param {Pen} pen
 * @param {View} view
 * @param {Colours} colours
 */
export function drawScaleBar(pen, view, colours) {
  const shades = colours();
  const length = roundLength(LONGEST / view.scale);
  const text = length >= 1000 ? `${length / 1000} mm` : `${length} µm`;
  const [left, bottom] = [14, view.height - 14];
  const right = left + length * view.scale;
  pen.fillStyle = shades.page;
  pen.globalAlpha = 0.8;
  pen.fillRect(left - 6, bottom - 24, Math.max(right - left, 44) + 12, 32);
  pen.globalAlpha = 1;
  pen.strokeStyle = shades.ink;
  pen.lineWidth = 2;
  pen.beginPath();
  pen.moveTo(left, bottom - 6);
  pen.lineTo(left, bottom);
  pen.lineTo(right, bottom);
  pen.lineTo(right, bottom - 6);
  pen.stroke();
  pen.fillStyle = shades.ink;
  pen.font = "12px system-ui, sans-serif";
  pen.textAlign = "left";
  pen.fillText(text, left + 4, bottom - 8);
}
