// The tables that Python hands over to the page (sim/show/report_page/tables.py): its JSON, by name and type.
import { element } from "../../html/assets/elements.js";

/** @import { Said } from "../../html/assets/language.js" */

/** @typedef {[code: string, address: string]} Code A finding of a block, and where in the page it stands. */
/** @typedef {number | string | Code[] | null} Value */

/**
 * One column of a table.
 * @typedef {object} Column
 * @property {Said} head
 * @property {Value[]} values one a row; null shows as a dash
 * @property {"number" | "text" | "code" | "word" | "codes"} kind
 * @property {string} unit
 * @property {number} per a number shows divided by it
 * @property {number} digits
 * @property {Record<string, Said>} words what the keys of a column of words say
 */

/**
 * A table: its name in the page, and what stands in it.
 * @typedef {object} TableData
 * @property {string} name
 * @property {Column[]} columns
 */

/**
 * All tables of the page.
 * @returns {TableData[]}
 */
export function readTables() {
  return JSON.parse(element("#tables", HTMLElement).textContent);
}
