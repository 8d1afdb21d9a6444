// What tells the blocks of a path apart where they have room: their numbers, and arrows that show which way they go.

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
 * The middle of a block, and which way it goes there: a direction of length 1, Y upwards.
 * @param {Path} path
 * @param {number} row
 * @returns {[x: number, y: number, wayX: number, wayY: number]}
 */
function middleOf(path, row) {
  const [x, y, toX, toY] = [path.place_x_um[row], path.place_y_um[row], path.place_x_um[row + 1], path.place_y_um[row + 1]];
  if (path.kind[row] === "arc") {
    const [radius, sweep] = [path.radius_um[row], path.sweep_rad[row]];
    const angle = path.start_angle_rad[row] + sweep / 2;
    const sense = Math.sign(sweep);
    return [
      path.center_x_um[row] + radius * Math.cos(angle), path.center_y_um[row] + radius * Math.sin(angle),
      -sense * Math.sin(angle), sense * Math.cos(angle),
    ];
  }
  const length = Math.hypot(toX - x, toY - y) || 1;
  return [(x + toX) / 2, (y + toY) / 2, (toX - x) / length, (toY - y) / length];
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
    const [x, y, wayX, wayY] = middleOf(path, row);
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
