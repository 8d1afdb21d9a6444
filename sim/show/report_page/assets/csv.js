// All rows of a table as a file to take along, in the language and the units of the page.
import { cellOf, fileOf } from "../../html/assets/csv.js";
import { pick } from "../../html/assets/language.js";
import { textOf } from "./cells.js";

/** @import { Filled, Value } from "./data.js" */

const DIGITS = 12; // of a number in another unit

/**
 * What a file has for a value: numbers bare.
 * @param {Filled} column
 * @param {Value} value
 */
function filled(column, value) {
  if (value === null) return "";
  if (column.kind === "number") return String(Number((Number(value) / column.per).toPrecision(DIGITS)));
  return cellOf(Array.isArray(value) ? value.map(([code]) => code).join(" ") : textOf(column, value));
}

/**
 * Text of such a file with these rows.
 * @param {Filled[]} columns
 * @param {number[]} rows
 */
export function csvOf(columns, rows) {
  const heads = columns.map(({ head, unit }) => cellOf(unit ? `${pick(head)} ${unit}` : pick(head)));
  return fileOf([heads, ...rows.map((row) => columns.map((column) => filled(column, column.values[row])))]);
}
