// The plan of a drawing: what would be cut, asked for anew with each change, and drawn over the drawing.
import * as asked from "./asked.js";

/** @import { Planned, PlannedFigure } from "./data.js" */
/** @import { Path as Drawn } from "../../replay/assets/path.js" */
/** @import { Shades } from "../../replay/assets/palette.js" */
/** @import { Pen } from "../../replay/assets/pen.js" */
/** @import { View } from "../../replay/assets/view.js" */

/**
 * Ask for plans: one at a time, and of those that are wanted meanwhile the last one alone.
 * @param {() => Record<string, string> | null} wanted what is asked for now; null where no plan is to be shown
 * @param {(plan: Planned | null) => void} show
 */
export function wirePlan(wanted, show) {
  let isAsking = false;
  let isStale = false;

  async function ask() {
    isStale = true;
    if (isAsking) return;
    isAsking = true;
    while (isStale) {
      isStale = false;
      const now = wanted();
      try {
        show(now && (await asked.plan(now)));
      } catch {
        show(null);
      }
    }
    isAsking = false;
  }

  return ask;
}

/**
 * The numbers that a text lists.
 * @param {string} text
 */
function listed(text) {
  return (text.match(/\d+/g) ?? []).map(Number);
}

/**
 * An order of all figures: those that a text lists first, the others behind them as they are planned. A text that is none
 * stays as it is.
 * @param {string} text
 * @param {PlannedFigure[]} figures
 */
export function completed(text, figures) {
  const first = listed(text);
  if (!first.length || /[^\d\s\p{P}]/u.test(text)) return text.trim(); // the server says what is wrong
  return [...first, ...figures.map(({ number }) => number).filter((number) => !first.includes(number))].join(",");
}

/**
 * What stands in a field once a figure is named in it behind the others, or no longer.
 * @param {string} text
 * @param {number} number
 */
export function reordered(text, number) {
  const all = listed(text);
  return (all.includes(number) ? all.filter((each) => each !== number) : [...all, number]).join(",");
}

/**
 * The figure whose way or thread point lies at a place, µm; null where none is near.
 * @param {PlannedFigure[]} figures
 * @param {[x: number, y: number]} place
 * @param {number} row of the plan's path at the place, −1 where none is
 * @param {number} nearUm
 */
export function figureAt(figures, place, row, nearUm) {
  const away = figures.map(({ thread_um: [x, y] }) => Math.hypot(x - place[0], y - place[1]));
  const nearest = Math.min(...away);
  if (nearest < nearUm) return figures[away.indexOf(nearest)];
  return figures.find(({ spans }) => spans.some(([first, past]) => first <= row && row < past)) ?? null;
}

const DISC = 9; // px: radius of the disc that has the number
const MOST = 200; // discs that have numbers; of more, the picture is covered

/**
 * Draw a plan: ways of the wire, leads in their colour, jumps dashed, at thread points the numbers of the figures, and
 * where these are cut in another order, when each is cut.
 * @param {Pen} pen
 * @param {View} view
 * @param {Planned} plan
 * @param {Drawn} drawn
 * @param {Shades} shades
 */
export function drawPlan(pen, view, plan, drawn, shades) {
  const { is_lead: isLead = [], figures = [] } = plan;
  pen.lineWidth = 2;
  pen.strokeStyle = shades.accent;
  drawn.stroke(pen, view, (kind, row) => kind !== "jump" && !isLead[row]);
  pen.strokeStyle = shades.start;
  drawn.stroke(pen, view, (_, row) => isLead[row] ?? false);
  pen.lineWidth = 1.5;
  pen.strokeStyle = shades.jump;
  pen.setLineDash([6, 4]);
  drawn.stroke(pen, view, (kind) => kind === "jump");
  pen.setLineDash([]);
  const isOther = figures.some(({ number }, at) => number !== at + 1);
  if (figures.length <= MOST) figures.forEach((figure, at) => drawNumber(pen, view, figure, isOther ? at + 1 : 0, shades));
}

/**
 * A disc with the number of a figure at its thread point, and above it when it is cut.
 * @param {Pen} pen
 * @param {View} view
 * @param {PlannedFigure} figure
 * @param {number} rank from 1; 0 where numbers are ranks
 * @param {Shades} shades
 */
function drawNumber(pen, view, { number, thread_um: [x, y] }, rank, shades) {
  const [across, down] = [view.toX(x), view.toY(y)];
  pen.fillStyle = shades.page;
  pen.strokeStyle = shades.start;
  pen.lineWidth = 2;
  pen.beginPath();
  pen.arc(across, down, DISC, 0, 2 * Math.PI);
  pen.fill();
  pen.stroke();
  pen.font = "bold 11px system-ui, sans-serif";
  pen.textAlign = "center";
  pen.textBaseline = "middle";
  pen.fillStyle = shades.ink;
  pen.fillText(String(number), across, down);
  if (!rank) return;
  pen.strokeStyle = shades.page;
  pen.lineWidth = 3;
  pen.fillStyle = shades.jump;
  pen.strokeText(`${rank}.`, across + DISC, down - 1.8 * DISC);
  pen.fillText(`${rank}.`, across + DISC, down - 1.8 * DISC);
}
