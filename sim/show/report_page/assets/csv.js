// All rows of a table as a file to take along (RFC 4180), in the language and the units of the page.
import { make } from "../../html/assets/elements.js";
import { pick } from "../../html/assets/language.js";
import { textOf } from "./cells.js";

/** @import { Filled, Value } from "./data.js" */

const MARK = "\ufeff"; // tells spreadsheets that it is UTF-8
const DIGITS = 12; // of a number in another unit

/**
 * What a file has for a value: numbers bare, and no text that a spreadsheet takes for a formula.
 * @param {Filled} column
 * @param {Value} value
 */
function cellOf(column, value) {
  if (value === null) return "";
  if (column.kind === "number") return String(Number((Number(value) / column.per).toPrecision(DIGITS)));
  const text = Array.isArray(value) ? value.map(([code]) => code).join(" ") : textOf(column, value);
  const bare = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(bare) ? `"${bare.replace(/"/g, '""')}"` : bare;
}

/**
 * Text of such a file with these rows.
 * @param {Filled[]} columns
 * @param {number[]} rows
 */
export function csvOf(columns, rows) {
  const heads = columns.map(({ head, unit }) => (unit ? `${pick(head)} ${unit}` : pick(head)));
  const lines = rows.map((row) => columns.map((column) => cellOf(column, column.values[row])).join(","));
  return `${MARK}${[heads.join(","), ...lines, ""].join("\r\n")}`;
}

/**
 * Save a text as a file.
 * @param {string} name
 * @param {string} text
 */
export function save(name, text) {
  const href = URL.createObjectURL(new Blob([text], { type: "text/csv;charset=utf-8" }));
  make("a", { href, download: name }).click();
  window.setTimeout(() => URL.revokeObjectURL(href), 1000); // the browser has begun to read it by then
}
