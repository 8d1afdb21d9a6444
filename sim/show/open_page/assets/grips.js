// Grips of a planned figure: an arrow that turns its cut round, a knob on the wire's side, a bar where the tab begins, and
// the ways of its passes, where they lie far enough apart to be told.
import { placeOn } from "../../replay/assets/path.js";

/** @import { Planned, PlannedFigure } from "./data.js" */
/** @import { Curves, Place } from "../../replay/assets/document.js" */
/** @import { Pen } from "../../replay/assets/pen.js" */
/** @import { Shades } from "../../replay/assets/palette.js" */
/** @import { View } from "../../replay/assets/view.js" */

/**
 * What of a figure can be dragged.
 * @typedef {object} Grips
 * @property {PlannedFigure} figure
 * @property {Place} heading unit vector in which its cut starts
 */

/**
 * What is taken hold of: a grip by its name, or a pass, from 1, where it was and the unit vector that leads away from the
 * contour there.
 * @typedef {{ name: "direction" | "side" | "tab" } | { name: "pass", pass: number, from: Place, out: Place }} Grip
 */

/**
 * The fields that grips change, as they stand.
 * @typedef {object} Wishes
 * @property {string} direction
 * @property {string} side
 * @property {string} tab mm
 * @property {number[]} passes mm
 */

const AHEAD = 40; // px from where a cut starts to the arrow; as far behind lies the bar of a tab that is none yet
const ASIDE = 15; // px to the knob on the wire's side
const SIZE = 8; // px of a grip
const APART = 8; // px between contour and pass, at least, where passes can be dragged
const TAB_STEP_MM = 0.05;
const PASS_STEP_MM = 0.005;
const MORE_MM = 0.05; // that one pass more lies outside of the others
const MOST_PASSES = 4; // that clicks add

/**
 * Unit vector in which a block of a path runs at its start.
 * @param {Curves} path
 * @param {number} row
 * @returns {Place}
 */
function headingOf(path, row) {
  const [[x, y], [toX, toY]] = [placeOn(path, row, 0), placeOn(path, row, 0.001)];
  const length = Math.hypot(toX - x, toY - y) || 1;
  return [(toX - x) / length, (toY - y) / length];
}

/**
 * The grips of a figure of a plan; null where it has none.
 * @param {Planned} plan
 * @param {number} number of the figure
 * @returns {Grips | null}
 */
export function gripsOf(plan, number) {
  const figure = plan.figures?.find((each) => each.number === number) ?? plan.figures?.[0];
  if (!figure || !plan.path) return null;
  for (let [row, past] = figure.spans[0]; row < past; row++) {
    if (plan.row_pass?.[row]) return { figure, heading: headingOf(plan.path, row) };
  }
  return null;
}

/**
 * Where the grips lie, µm; a figure that the wire runs inside of has no tab.
 * @param {Grips} grips
 * @param {number} pxUm µm of a px
 * @returns {{ direction: Place, side: Place, tab: Place | null }}
 */
export function placesOf({ figure, heading }, pxUm) {
  const [x, y] = figure.entry_um;
  /**
   * @param {Place} along
   * @param {number} px
   * @returns {Place}
   */
  const beside = ([byX, byY], px) => [x + byX * px * pxUm, y + byY * px * pxUm];
  return {
    direction: beside(heading, AHEAD),
    side: beside(figure.out, ASIDE),
    tab: figure.is_inside ? null : figure.tab_um ?? beside(heading, -AHEAD),
  };
}

/**
 * The grip at a place; null where there is none.
 * @param {Grips} grips
 * @param {Place} place
 * @param {number} nearUm
 * @param {number} pxUm
 * @returns {Grip | null}
 */
export function gripAt(grips, [x, y], nearUm, pxUm) {
  const places = placesOf(grips, pxUm);
  for (const name of /** @type {const} */ (["direction", "side", "tab"])) {
    const at = places[name];
    if (at && Math.hypot(at[0] - x, at[1] - y) < nearUm) return { name };
  }
  return null;
}

/**
 * The pass whose way lies at a place; null where none does, or where the picture is too small to tell.
 * @param {Planned} plan
 * @param {number} row of the plan's path there, −1 where there is none
 * @param {Place} from
 * @param {Wishes} wishes
 * @param {number} pxUm
 * @returns {Grip | null}
 */
export function passAt(plan, row, from, wishes, pxUm) {
  if (row < 0 || !plan.path || !plan.row_pass || !plan.is_left) return null;
  const pass = plan.row_pass[row];
  if (!pass || 1000 * (wishes.passes[pass - 1] ?? 0) < APART * pxUm) return null;
  const [x, y] = headingBeside(plan.path, row, from);
  return { name: "pass", pass, from, out: plan.is_left[row] ? [-y, x] : [y, -x] };
}

/**
 * Unit vector in which a block of a path runs beside a place.
 * @param {Curves} path
 * @param {number} row
 * @param {Place} place
 * @returns {Place}
 */
function headingBeside(path, row, [x, y]) {
  if (path.kind[row] !== "arc") return headingOf(path, row);
  const [outX, outY] = [x - path.center_x_um[row], y - path.center_y_um[row]];
  const turn = Math.sign(path.sweep_rad[row]) / (Math.hypot(outX, outY) || 1);
  return [-turn * outY, turn * outX];
}

/**
 * A length, mm, in whole steps.
 * @param {number} mm
 * @param {number} step
 */
function inSteps(mm, step) {
  return Number((Math.round(mm / step) * step).toFixed(3));
}

/**
 * What is wished once a grip is dragged to a place, from what was wished before.
 * @param {Grip} grip
 * @param {Grips} grips
 * @param {Place} place
 * @param {Wishes} wishes
 * @returns {Wishes}
 */
export function dragged(grip, { figure, heading }, place, wishes) {
  const [byX, byY] = [place[0] - figure.entry_um[0], place[1] - figure.entry_um[1]];
  /** @param {Place} along */
  const isBehind = ([x, y]) => byX * x + byY * y < 0;
  if (grip.name === "pass") {
    const { pass, from, out } = grip;
    const moved = wishes.passes[pass - 1] + ((place[0] - from[0]) * out[0] + (place[1] - from[1]) * out[1]) / 1000;
    return { ...wishes, passes: wishes.passes.map((mm, at) => (at === pass - 1 ? Math.max(inSteps(moved, PASS_STEP_MM), 0) : mm)) };
  }
  if (grip.name === "tab") {
    const tab = inSteps(Math.hypot(byX, byY) / 1000, TAB_STEP_MM);
    return { ...wishes, tab: tab > 2 * Math.max(...wishes.passes) ? String(tab) : "" };
  }
  return isBehind(grip.name === "direction" ? heading : figure.out) ? turned(grip.name, figure, wishes) : wishes;
}

/**
 * What is wished once a cut is turned round, or runs on the other side.
 * @param {"direction" | "side"} name
 * @param {PlannedFigure} figure
 * @param {Wishes} wishes
 * @returns {Wishes}
 */
export function turned(name, figure, wishes) {
  if (name === "direction") return { ...wishes, direction: figure.is_ccw ? "cw" : "ccw" };
  return { ...wishes, side: figure.is_inside ? "outside" : "inside" };
}

/**
 * What is wished with one pass more, outside of the others; of four, the last one stays.
 * @param {Wishes} wishes
 * @returns {Wishes}
 */
export function withMore(wishes) {
  const { passes } = wishes;
  return { ...wishes, passes: passes.length < MOST_PASSES ? [inSteps(passes[0] + MORE_MM, PASS_STEP_MM), ...passes] : passes.slice(-1) };
}

/**
 * Draw the grips of a figure.
 * @param {Pen} pen
 * @param {View} view
 * @param {Grips} grips
 * @param {Shades} shades
 */
export function drawGrips(pen, view, grips, shades) {
  const { direction, side, tab } = placesOf(grips, 1 / view.scale);
  const [x, y] = [view.toX(grips.figure.entry_um[0]), view.toY(grips.figure.entry_um[1])];
  const [byX, byY] = [grips.heading[0], -grips.heading[1]];
  pen.strokeStyle = pen.fillStyle = shades.accent;
  pen.lineWidth = 2;
  pen.beginPath();
  pen.moveTo(x, y);
  pen.lineTo(view.toX(side[0]), view.toY(side[1]));
  pen.stroke();
  pen.beginPath();
  pen.arc(view.toX(side[0]), view.toY(side[1]), 0.6 * SIZE, 0, 2 * Math.PI);
  pen.fill();
  const [atX, atY] = [view.toX(direction[0]), view.toY(direction[1])];
  pen.beginPath();
  pen.moveTo(atX + SIZE * byX, atY + SIZE * byY);
  for (const across of [1, -1]) pen.lineTo(atX - SIZE * (byX - across * byY), atY - SIZE * (byY + across * byX));
  pen.closePath();
  pen.fill();
  if (!tab) return;
  const [barX, barY] = [view.toX(tab[0]), view.toY(tab[1])];
  const isTab = Boolean(grips.figure.tab_um);
  pen.lineWidth = isTab ? 6 : 3;
  pen.beginPath();
  pen.moveTo(barX - 1.3 * SIZE * byY, barY + 1.3 * SIZE * byX);
  pen.lineTo(barX + 1.3 * SIZE * byY, barY - 1.3 * SIZE * byX);
  pen.stroke();
}
