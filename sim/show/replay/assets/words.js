// What the page says of numbers, in both languages; texts that stand still are in the page itself.
import * as language from "../../html/assets/language.js";

/**
 * @import { Decision } from "./decisions.js"
 * @import { Blocks, Finding, Piece } from "./document.js"
 */

const MINUS = "−";
const TURNS = { 1: "NR", "-1": "SR", 0: "L" };

/**
 * The text of the page's language.
 * @param {string} en
 * @param {string} zh
 */
export const pick = (en, zh) => language.pick({ en, zh });

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
 * @param {Blocks} blocks
 * @param {number} row
 */
export function kind(blocks, row) {
  if (blocks.kind[row] === "jump") return pick("jump", "空走");
  if (blocks.kind[row] === "line") return pick("line", "直线");
  return blocks.sweep_rad[row] > 0 ? pick("arc, counter-clockwise", "逆圆弧") : pick("arc, clockwise", "顺圆弧");
}

/**
 * Z of a block as 3B writes it.
 * @param {Blocks} blocks
 * @param {number} row
 */
export const code = (blocks, row) => `${TURNS[blocks.turn[row]]}${blocks.quadrant[row]}`;

/**
 * Pairs of name and value that describe a block.
 * @param {Blocks} blocks
 * @param {number} row
 */
export function geometry(blocks, row) {
  /** @type {[name: string, value: string][]} */
  const rows = [
    [pick("from", "起点"), place(blocks.place_x_um[row], blocks.place_y_um[row])],
    [pick("to", "终点"), place(blocks.place_x_um[row + 1], blocks.place_y_um[row + 1])],
  ];
  if (blocks.kind[row] === "arc") {
    rows.push(
      [pick("centre", "圆心"), place(blocks.center_x_um[row], blocks.center_y_um[row])],
      [pick("radius", "半径"), `${mm(blocks.radius_um[row])} mm`],
      [pick("sweep", "圆心角"), `${number((Math.abs(blocks.sweep_rad[row]) * 180) / Math.PI, 3)}°`],
    );
  }
  rows.push([pick("length", "长度"), `${mm(blocks.length_um[row])} mm`]);
  if (blocks.kind[row] !== "jump") {
    rows.push(
      [pick("count J", "计数长度 J"), number(blocks.count_um[row])],
      [pick("axis G", "计数方向 G"), `G${blocks.count_axis[row]}`],
      ["Z", code(blocks, row)],
    );
  }
  return rows;
}

/**
 * Title of a block, such as “Block 3 of 6 · N3 · line”.
 * @param {Blocks} blocks
 * @param {number} row
 */
export function block(blocks, row) {
  const count = blocks.kind.length;
  const name = pick(`Block ${number(row + 1)} of ${number(count)}`, `第 ${number(row + 1)} 段，共 ${number(count)} 段`);
  return [name, blocks.label[row], kind(blocks, row)].filter(Boolean).join(" · ");
}

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
 */
export function piece({ kind: what, mass_g: grams, row }) {
  const mass = grams >= 1000 ? `${number(grams / 1000, 2)} kg` : `${number(grams, grams < 10 ? 2 : 0)} g`;
  const name = what === "slug" ? pick("slug", "废料") : pick("part", "零件");
  return pick(`${name} ${mass}, free in block ${row + 1}`, `${name} ${mass}，第 ${row + 1} 段脱落`);
}

/**
 * Texts of a finding.
 * @param {Finding} found
 */
export const finding = ({ texts }) => language.pick(texts);
