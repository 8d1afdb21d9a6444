// What tells the blocks of a path apart where they have room: their numbers, and arrows that show which way they go.
import { placeOn } from "../../replay/assets/path.js";

/** @import { Path } from "./data.js" */
/** @import { Path as Drawn } from "../../replay/assets/path.js" */
/** @import { Shades } from "../../replay/assets/palette.js" */
/** @import { Pen } from "../../replay/assets/pen.js" */
/** @import { View } from "../../replay/assets/view.js" */

const ROOMY = 34; // px of a block that has its number and its arrow
const MOST = 400; // blocks that have them at once
const ARROW = 5; // px
const BESIDE = 12; // px from the path to the middle of a number

/**
 * Which way a block goes in its middle: a direction of length 1, Y upwards.
 * @param {Path} path
 * @param {number} row
 * @returns {[x: number, y: number]}
 */
function wayOf(path, row) {
  if (path.kind[row] === "arc") {
    const [angle, sense] = [path.start_angle_rad[row] + path.sweep_rad[row] / 2, Math.sign(path.sweep_rad[row])];
    return [-sense * Math.sin(angle), sense * Math.cos(angle)];
  }
  const [x, y] = [path.place_x_um[row + 1] - path.place_x_um[row], path.place_y_um[row + 1] - path.place_y_um[row]];
  const length = Math.hypot(x, y) || 1;
  return [x / length, y / length];
}

/**
 * Draw them for the blocks that show.
 * @param {Pen} pen
 * @param {View} view
 * @param {Path} path
 * @param {Drawn} drawn
 * @param {Shades} shades
 */
export function drawBlockMarks(pen, view, path, drawn, shades) {
  const rows = drawn.rowsNear(view.bounds()).filter((row) => path.length_um[row] * view.scale >= ROOMY);
  if (rows.length > MOST) return;
  pen.font = "12px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  for (const row of rows) {
    const [x, y] = placeOn(path, row, 0.5);
    const [wayX, wayY] = wayOf(path, row);
    const [px, py] = [view.toX(x), view.toY(y)];
    pen.fillStyle = path.kind[row] === "jump" ? shades.jump : shades.ink;
    pen.beginPath();
    pen.moveTo(px + ARROW * wayX, py - ARROW * wayY);
    pen.lineTo(px - ARROW * (wayX - wayY), py + ARROW * (wayY + wayX));
    pen.lineTo(px - ARROW * (wayX + wayY), py + ARROW * (wayY - wayX));
    pen.fill();
    pen.strokeStyle = shades.page;
    pen.lineWidth = 3;
    pen.lineJoin = "round";
    const [textX, textY] = [px + BESIDE * wayY, py + BESIDE * wayX];
    pen.strokeText(path.name[row], textX, textY);
    pen.fillText(path.name[row], textX, textY);
  }
  pen.textBaseline = "alphabetic";
}
