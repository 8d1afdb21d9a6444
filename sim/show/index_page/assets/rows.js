// A row of the table: the picture of a program, where its files are, and what came of it.
import { both, make } from "../../html/assets/elements.js";
import { pick, said, say } from "../../html/assets/language.js";

/** @import { Said } from "../../html/assets/language.js" */
/** @import { FindingCount, Index, Listed, Program } from "./data.js" */

const SVG = "http://www.w3.org/2000/svg";
const NOTHING = "–";

/**
 * The row of a program.
 * @param {Program} program
 * @param {Index} index
 */
export function rowOf(program, index) {
  const verdict = make("span", { className: "word" }, ...both(said(program.verdict)));
  const kept = program.from_cache ? [make("span", { className: "aside" }, ...both(said("kept")))] : [];
  const row = make(
    "tr",
    { className: program.verdict },
    make("td", { className: "picture" }, ...picture(program, index.box)),
    make("th", { scope: "row" }, ...named(program)),
    make("td", { className: "verdict" }, verdict, ...kept),
    make("td", { className: "codes" }, ...codes(program.findings, index.titles)),
    timeOf(program),
    worstOf(program),
  );
  return row;
}

/**
 * How long it takes, with its interval.
 * @param {Program} program
 */
function timeOf({ time, time_within: within }) {
  const cell = figure("time", time || NOTHING);
  if (within) cell.append(make("span", { className: "aside" }, within));
  return cell;
}

/**
 * How far it is off: from the drawing, where there is one.
 * @param {Program} program
 */
function worstOf({ worst_um: um, drawing_um: ofDrawing }) {
  if (um === null) return figure("worst", NOTHING);
  const cell = figure("worst", um.toFixed(2), "µm");
  if (ofDrawing !== null) cell.append(make("span", { className: "aside" }, ...both(said("of-drawing"))));
  return cell;
}

/**
 * The path of a program, small.
 * @param {Listed} program
 * @param {[number, number]} box
 */
export function picture(program, box) {
  if (!program.picture) return [];
  const drawn = document.createElementNS(SVG, "svg");
  const path = document.createElementNS(SVG, "path");
  drawn.setAttribute("viewBox", `0 0 ${box[0]} ${box[1]}`);
  drawn.setAttribute("role", "img");
  drawn.setAttribute("aria-label", say("picture-of", { name: program.file }));
  path.setAttribute("d", program.picture);
  drawn.append(path);
  return [drawn];
}

/**
 * Name of a program: a link to its report where there is one, its title, and why there is none.
 * @param {Program} program
 */
function named(program) {
  const last = program.file.lastIndexOf("/") + 1;
  const folder = make("span", { className: "folder" }, program.file.slice(0, last));
  const name = [folder, make("span", { className: "name" }, program.file.slice(last))];
  const told = program.message ? [make("span", { className: "message" }, ...both(program.message))] : [];
  const title = both({ en: program.title, zh: program.title_zh ?? program.title });
  const titled = program.file.endsWith(program.title) ? [] : [make("span", { className: "title" }, ...title)];
  if (program.folder === null) return [make("span", { className: "file" }, ...name), ...titled, ...told];
  const there = program.folder.split("/").map(encodeURIComponent).join("/");
  const replay = make("a", { className: "replay", href: `${there}/replay.html` }, ...both(said("replay")));
  return [make("a", { className: "file", href: `${there}/report.html` }, ...name), ...titled, replay];
}

/**
 * The codes of findings, with how often each occurs.
 * @param {FindingCount[]} findings
 * @param {Record<string, Said>} titles
 */
export function codes(findings, titles) {
  if (!findings.length) return [NOTHING];
  return findings.flatMap((found) => {
    const title = pick(titles[found.code]);
    const text = found.count > 1 ? `${found.code} ×${found.count}` : found.code;
    return [make("span", { className: `code ${found.severity}`, title }, text), " "];
  });
}

/**
 * A cell with a number.
 * @param {string} name
 * @param {string} text
 * @param {string} unit
 */
function figure(name, text, unit = "") {
  const cell = make("td", { className: `number ${name}` }, text, ...(unit ? [" ", make("span", { className: "unit" }, unit)] : []));
  return cell;
}
