// The wire: its disc where it is, a cross where the controller wants it, and how far it is off the ideal curve.

/**
 * @import { Place } from "./document.js"
 * @import { Room } from "./free_room.js"
 * @import { Colours, Shades } from "./palette.js"
 * @import { Pen } from "./pen.js"
 * @import { Moment } from "./player.js"
 * @import { View } from "./view.js"
 */

/** @typedef {{ text: string, box: Room }} Plate */

const LEAST_RADIUS = 4; // px, so that the wire shows on the whole table
const LARGE = 60; // px: from there on it is drawn open
const CROSS = 9;
const LABEL = "600 12px system-ui, sans-serif";

/**
 * Text of a magnified deviation, and the plate for it beside the wire's mark and within the window; or null.
 * @param {Pen} pen
 * @param {View} view
 * @param {Moment} state
 * @param {number} times
 * @returns {Plate | null}
 */
export function deviationPlate(pen, view, { deviation, wire }, times) {
  if (!times) return null;
  const text = `${deviation.um.toFixed(2)} µm ×${times}`;
  const [x, y] = magnified(view, deviation.foot, wire, times);
  pen.font = LABEL;
  const width = pen.measureText(text).width + 10;
  const left = Math.max(4, Math.min(x + 12, view.width - width - 4));
  const top = Math.max(4, Math.min(y - 28, view.height - 24));
  return { text, box: [left, top, left + width, top + 20] };
}

/**
 * Write it.
 * @param {Pen} pen
 * @param {Plate} plate
 * @param {Shades} shades
 */
function drawPlate(pen, { text, box: [left, top, right, bottom] }, shades) {
  pen.fillStyle = shades.page;
  pen.globalAlpha = 0.88;
  pen.fillRect(left, top, right - left, bottom - top);
  pen.globalAlpha = 1;
  pen.fillStyle = shades.ink;
  pen.font = LABEL;
  pen.textAlign = "left";
  pen.fillText(text, left + 5, top + 14);
}

/**
 * A cross of two strokes.
 * @param {Pen} pen
 * @param {number} x
 * @param {number} y
 * @param {string} colour
 */
function cross(pen, x, y, colour) {
  pen.strokeStyle = colour;
  pen.lineWidth = 2;
  pen.beginPath();
  pen.moveTo(x - CROSS, y);
  pen.lineTo(x + CROSS, y);
  pen.moveTo(x, y - CROSS);
  pen.lineTo(x, y + CROSS);
  pen.stroke();
}

/**
 * The wire's cross-section at its own size; drawn open where it is large, to show what is under it.
 * @param {Pen} pen
 * @param {View} view
 * @param {Place} place
 * @param {number} diameterUm
 * @param {string} colour
 */
function disc(pen, view, [x, y], diameterUm, colour) {
  const radius = Math.max(LEAST_RADIUS, (diameterUm / 2) * view.scale);
  pen.beginPath();
  pen.arc(view.toX(x), view.toY(y), radius, 0, 2 * Math.PI);
  pen.fillStyle = colour;
  pen.globalAlpha = 0.45;
  if (radius < LARGE) pen.fill();
  pen.globalAlpha = 1;
  pen.strokeStyle = colour;
  pen.lineWidth = 1.5;
  pen.stroke();
}

/**
 * A small round mark of what is really there.
 * @param {Pen} pen
 * @param {number} x
 * @param {number} y
 * @param {string} colour
 */
function dot(pen, x, y, colour) {
  pen.beginPath();
  pen.arc(x, y, 4, 0, 2 * Math.PI);
  pen.fillStyle = colour;
  pen.fill();
}

/**
 * Where a place shows whose way from the foot on the ideal curve is magnified.
 * @param {View} view
 * @param {Place} foot
 * @param {Place} place
 * @param {number} times
 * @returns {Place}
 */
function magnified(view, foot, place, times) {
  const x = view.toX(foot[0]) + (place[0] - foot[0]) * times * view.scale;
  const y = view.toY(foot[1]) - (place[1] - foot[1]) * times * view.scale;
  return [x, y];
}

/**
 * A line from the foot to where a place shows.
 * @param {Pen} pen
 * @param {View} view
 * @param {Place} foot
 * @param {Place} shown
 * @param {string} colour
 */
function whisker(pen, view, foot, [x, y], colour) {
  pen.strokeStyle = colour;
  pen.lineWidth = 2;
  pen.beginPath();
  pen.moveTo(view.toX(foot[0]), view.toY(foot[1]));
  pen.lineTo(x, y);
  pen.stroke();
}

/**
 * Draw the wire at a moment; deviations are shown `times` as large, 0 for not at all.
 * @param {Pen} pen
 * @param {View} view
 * @param {Moment} state
 * @param {number} times
 * @param {number} diameterUm
 * @param {Colours} colours
 */
export function drawWire(pen, view, state, times, diameterUm, colours) {
  const shades = colours();
  const plate = deviationPlate(pen, view, state, times);
  const { wire, x, y, deviation } = state;
  disc(pen, view, wire, diameterUm, shades.wire);
  const foot = plate ? deviation.foot : wire;
  const actual = magnified(view, foot, wire, plate ? times : 1);
  const commanded = magnified(view, foot, [x, y], plate ? times : 1);
  if (plate) {
    whisker(pen, view, foot, commanded, shades.steps);
    whisker(pen, view, foot, actual, shades.wire);
  }
  cross(pen, ...commanded, shades.steps);
  dot(pen, ...actual, shades.wire);
  if (plate) drawPlate(pen, plate, shades);
}
