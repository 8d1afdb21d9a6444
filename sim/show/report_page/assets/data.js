// The tables that Python hands over to the page (sim/show/report_page/tables.py): its JSON, by name and type.
import { element } from "../../html/assets/elements.js";
import { unpacked } from "../../html/assets/packed.js";

/** @import { Said } from "../../html/assets/language.js" */
/** @import { Packed } from "../../html/assets/packed.js" */

/** @typedef {Exclude<Column["values"], Packed>[number]} Value */
/** @typedef {Extract<Value, unknown[]>[number]} Code A finding of a block, and where in the page it stands. */
/** @typedef {Omit<Column, "values"> & { values: ArrayLike<Value> }} Filled A column with its values at hand. */

/** Written by `make pages` from the model in Python. */

/**
 * A table: its name in the page, and what stands in it.
 * @typedef {object} TableData
 * @property {string} name
 * @property {Column[]} columns
 */

/**
 * One column of a table, as `Column` says; a long one has its values packed.
 * @typedef {object} Column
 * @property {Said} head
 * @property {(number | string | [string, string][] | null)[] | Packed} values one a row; null shows as a dash
 * @property {"number" | "text" | "code" | "word" | "codes"} kind
 * @property {string} unit
 * @property {number} per a number shows divided by it
 * @property {number} digits
 * @property {Record<string, Said>} words what the keys of a column of words say
 */

/** Up to here. */

/**
 * All tables of the page.
 * @returns {TableData[]}
 */
export function readTables() {
  return JSON.parse(element("#tables", HTMLElement).textContent);
}

/**
 * Columns of a table with their values at hand; an error where the browser cannot unpack them.
 * @param {TableData} table
 * @returns {Promise<Filled[]>}
 */
export function columnsOf({ columns }) {
  return Promise.all(columns.map(async (column) => ({ ...column, values: await unpacked(column.values) })));
}
