// What lies under the path of the picture: the axes of the program, how wide the wire will cut, and what is cut by now.
import { countUpTo } from "../../replay/assets/numbers.js";

/** @import { Shades } from "../../replay/assets/palette.js" */
/** @import { Path as Drawn } from "../../replay/assets/path.js" */
/** @import { Pen } from "../../replay/assets/pen.js" */
/** @import { View } from "../../replay/assets/view.js" */
/** @import { Shown } from "./playing.js" */

const WIDE = 3; // px of a kerf that shows beside its path
const AXIS = 44; // px of an axis of the program from its origin

/**
 * The axes of the program from its origin.
 * @param {Pen} pen
 * @param {View} view
 * @param {Shades} shades
 */
export function drawAxes(pen, view, shades) {
  const [x, y] = [view.toX(0), view.toY(0)];
  pen.strokeStyle = pen.fillStyle = shades.muted;
  pen.lineWidth = 1;
  pen.beginPath();
  pen.moveTo(x, y - AXIS);
  pen.lineTo(x, y);
  pen.lineTo(x + AXIS, y);
  pen.stroke();
  pen.font = "12px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.fillText("X", x + AXIS + 8, y + 4);
  pen.fillText("Y", x, y - AXIS - 6);
}

/**
 * A band as wide as the wire will cut, where that shows.
 * @param {Pen} pen
 * @param {View} view
 * @param {Drawn} program
 * @param {number} widthUm
 * @param {Shades} shades
 */
export function drawBand(pen, view, program, widthUm, shades) {
  const width = widthUm * view.scale;
  if (width < WIDE) return;
  pen.globalAlpha = 0.45;
  pen.strokeStyle = shades.kerf;
  pen.lineWidth = width;
  program.stroke(pen, view, (kind) => kind !== "jump");
  pen.globalAlpha = 1;
}

/**
 * What is cut by now, and the pieces that are free.
 * @param {Pen} pen
 * @param {View} view
 * @param {Shown} shown
 * @param {number} ratio
 * @param {boolean} isMoving
 */
export function drawPlayed(pen, view, { show, moment, isPlaying, time }, ratio, isMoving) {
  const last = Math.max(0, countUpTo(show.sampleT, moment.t) - 1);
  show.kerf.draw(pen, view, ratio, isMoving, last, moment.wire);
  show.pieces?.draw(pen, view, { ratio, isMoving, t: moment.t, now: time, mayFall: isPlaying });
}
