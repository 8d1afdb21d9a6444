// Files of rows to take along (RFC 4180).
import { make } from "./elements.js";

const MARK = "\ufeff"; // tells spreadsheets that it is UTF-8

/**
 * A text as a cell: none that a spreadsheet takes for a formula.
 * @param {string} text
 */
export function cellOf(text) {
  const bare = /^[=+\-@\t\r]/.test(text) ? `'${text}` : text;
  return /[",\r\n]/.test(bare) ? `"${bare.replace(/"/g, '""')}"` : bare;
}

/**
 * Text of a file with these lines, the first of them heads.
 * @param {string[][]} lines cells as the file has them
 */
export function fileOf(lines) {
  return `${MARK}${[...lines.map((cells) => cells.join(",")), ""].join("\r\n")}`;
}

/**
 * Save a text as a file.
 * @param {string} name
 * @param {string} text
 * @param {string} type of the file
 */
export function save(name, text, type = "text/csv") {
  const href = URL.createObjectURL(new Blob([text], { type: `${type};charset=utf-8` }));
  make("a", { href, download: name }).click();
  window.setTimeout(() => URL.revokeObjectURL(href), 1000); // the browser has begun to read it by then
}
