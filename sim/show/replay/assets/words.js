// What the page says of numbers and blocks, in its language.
import { pick, say } from "../../html/assets/language.js";

/**
 * @import { Decision } from "./decisions.js"
 * @import { Blocks, Finding, Piece, ReplayDocument } from "./document.js"
 */

/** @typedef {Pick<Blocks, "kind" | "name" | "label" | "sweep_rad">} Titled What a block is called by. */

const MINUS = "−";
const TURNS = { 1: "NR", "-1": "SR", 0: "L" };

/**
 * A number with so many decimals and a true minus; no −0.
 * @param {number} value
 * @param {number} digits
 */
export function number(value, digits = 0) {
  const text = Math.abs(value).toLocaleString("en-US", { minimumFractionDigits: digits, maximumFractionDigits: digits });
  return value < 0 && /[1-9]/.test(text) ? MINUS + text : text;
}

/**
 * µm as mm.
 * @param {number} um
 */
export const mm = (um) => number(um / 1000, 3);

/**
 * A time in hours, minutes and seconds, with hundredths under an hour.
 * @param {number} seconds
 */
export function clock(seconds) {
  const whole = Math.floor(seconds + 1e-9);
  const [hours, minutes, rest] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  /** @param {number} value */
  const two = (value) => String(value).padStart(2, "0");
  if (hours) return `${hours}:${two(minutes)}:${two(rest)}`;
  return `${two(minutes)}:${two(rest)}.${two(Math.min(99, Math.floor((seconds - whole) * 100 + 1e-6)))}`;
}

/**
 * A speed of the replay.
 * @param {number} times
 */
export const speed = (times) => `${Number(times.toPrecision(2)).toLocaleString("en-US", { maximumFractionDigits: 3 })}×`;

/**
 * A place as X, Y in mm.
 * @param {number} x
 * @param {number} y
 */
export const place = (x, y) => `X ${mm(x)}, Y ${mm(y)} mm`;

/**
 * What kind a block is.
 * @param {Titled} blocks
 * @param {number} row
 */
export function kind(blocks, row) {
  if (blocks.kind[row] === "jump") return say("jump");
  if (blocks.kind[row] === "line") return say("line");
  return blocks.sweep_rad[row] > 0 ? say("arc_left") : say("arc_right");
}

/**
 * Z of a block as 3B writes it.
 * @param {Blocks} blocks
 * @param {number} row
 */
export const code = (blocks, row) => `${TURNS[blocks.turn[row]]}${blocks.quadrant[row]}`;

/**
 * What a block's steps are counted by: words of the program where it has them, else the controller's own count.
 * @param {ReplayDocument} doc
 * @param {number} row
 * @returns {[name: string, value: string][]}
 */
function counting({ blocks, program }, row) {
  const [count, axis] = [number(blocks.count_um[row]), blocks.count_axis[row]];
  if (!program.is_worded) return [[say("counted"), say("counted_along", { count, axis })]];
  return [
    [say("count"), count],
    [say("axis"), `G${axis}`],
    ["Z", code(blocks, row)],
  ];
}

/**
 * Pairs of name and value that describe a block.
 * @param {ReplayDocument} doc
 * @param {number} row
 */
export function geometry(doc, row) {
  const { blocks } = doc;
  /** @type {[name: string, value: string][]} */
  const rows = [
    [say("from"), place(blocks.place_x_um[row], blocks.place_y_um[row])],
    [say("to"), place(blocks.place_x_um[row + 1], blocks.place_y_um[row + 1])],
  ];
  if (blocks.kind[row] === "arc") {
    rows.push(
      [say("center"), place(blocks.center_x_um[row], blocks.center_y_um[row])],
      [say("radius"), `${mm(blocks.radius_um[row])} mm`],
      [say("sweep"), `${number((Math.abs(blocks.sweep_rad[row]) * 180) / Math.PI, 3)}°`],
    );
  }
  rows.push([say("length"), `${mm(blocks.length_um[row])} mm`]);
  if (blocks.kind[row] !== "jump") rows.push(...counting(doc, row));
  return rows;
}

/**
 * Title of a block, such as “Block N18 (14 of 23) · line”.
 * @param {Titled} blocks
 * @param {number} row
 */
export function block(blocks, row) {
  const label = blocks.label[row];
  const which = { number: number(row + 1), count: number(blocks.kind.length) };
  return `${label ? say("labelled_block", { label, ...which }) : say("block", which)} · ${kind(blocks, row)}`;
}

/**
 * How many blocks there are in a group.
 * @param {number} n
 */
export const groupSize = (n) => say("group", { n: number(n) });

/**
 * A group of blocks, and what a click on it does.
 * @param {Titled} columns
 * @param {number} first
 * @param {number} past
 */
export const group = ({ name }, first, past) => say("group_of", { first: name[first], last: name[past - 1], n: number(past - first) });

/**
 * F and its sign.
 * @param {bigint} f
 */
export const weighed = (f) => `F = ${number(Number(f))} ${f >= 0 ? "≥" : "<"} 0`;

/**
 * Axis and sense of a step.
 * @param {Decision} made
 */
export const way = ({ axis, sign }) => (sign > 0 ? "+" : MINUS) + axis;

/**
 * A decision in short, as it stands beside its step.
 * @param {Decision} made
 */
export const decision = (made) => `${weighed(made.f)} → ${way(made)}`;

/**
 * What became free.
 * @param {Piece} freed
 * @param {Blocks} blocks
 */
export function piece({ kind: what, mass_g: grams, row }, { name: names }) {
  const mass = grams >= 1000 ? `${number(grams / 1000, 2)} kg` : `${number(grams, grams < 10 ? 2 : 0)} g`;
  const named = say(what === "slug" ? "slug" : "part");
  return say("freed", { piece: named, mass, block: names[row] });
}

/**
 * Texts of a finding.
 * @param {Finding} found
 */
export const finding = ({ texts }) => pick(texts);
