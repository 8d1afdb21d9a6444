// How large the program is, and its figures.
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Answer, Figure, Path, Size } from "./data.js" */

const MOST = 200;

/** @param {number} um */
export const mm = (um) => (Math.round(um) / 1000).toFixed(3);

/**
 * Names and values.
 * @param {Size} size
 * @returns {[name: string, value: string][]}
 */
export function rowsOf(size) {
  const { box_um: box } = size;
  /** @type {[name: string, value: string][]} */
  const rows = [
    [language.say("blocks"), language.say("blocks-of", { lines: size.lines, arcs: size.arcs, rapids: size.rapids })],
    [language.say("cut"), `${mm(size.cut_um)} mm`],
    [language.say("time"), language.pick(size.time)],
    [language.say("steps"), size.steps.toLocaleString("en")],
  ];
  if (box) {
    rows.push([language.say("extent"), `${mm(box[2] - box[0])} × ${mm(box[3] - box[1])} mm`]);
    rows.push([language.say("box"), `X ${mm(box[0])} … ${mm(box[2])}, Y ${mm(box[1])} … ${mm(box[3])} mm`]);
  }
  return rows;
}

/**
 * @param {Figure} figure
 * @param {number} number
 * @param {Path | null} path
 */
function figureRow(figure, number, path) {
  const [x, y] = figure.thread_um;
  const closes = figure.closes === null ? "parting-contour" : figure.closes ? "closed-contour" : "open-contour";
  return make(
    "tr", {},
    make("td", {}, String(number)),
    make("td", {}, `${path?.name[figure.first - 1]} – ${path?.name[figure.last - 1]}`),
    make("td", {}, `${mm(x)}, ${mm(y)}`),
    make("td", {}, mm(figure.length_um)),
    make("td", { className: closes }, language.say(closes)),
  );
}

/**
 * Show size and figures.
 * @param {HTMLElement} list
 * @param {HTMLElement} body of the table of figures
 * @param {Answer} answer
 */
export function showSize(list, body, { size, figures, path }) {
  const rows = size ? rowsOf(size) : [];
  element("#sizes", HTMLElement).hidden = !size;
  list.replaceChildren(...rows.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]));
  body.replaceChildren(...figures.slice(0, MOST).map((figure, at) => figureRow(figure, at + 1, path)));
}
