// Puts the page together: its language, its tables, its links, and what of it is printed.
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { columnsOf, readTables } from "./data.js";
import { wireLinks } from "./links.js";
import { printBy } from "./paper.js";
import { Table, tellUnread } from "./tables.js";

/** @import { TableData } from "./data.js" */

/**
 * Show a table once its columns are unpacked; a browser that is too old to do so is told.
 * @param {TableData} data
 */
async function show(data) {
  try {
    new Table(data.name, await columnsOf(data));
  } catch (error) {
    tellUnread(data.name);
    throw error;
  }
}

language.begin();
wireLinks();
printBy(element("#print-everything", HTMLInputElement));

/** For tests and other scripts: `ready` once all tables are shown. */
export const tables = { ready: Promise.all(readTables().map(show)) };
