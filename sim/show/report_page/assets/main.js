// Puts the page together: its language, its tables, its links, and what of it is printed.
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { columnsOf, readTables } from "./data.js";
import { wireLinks } from "./links.js";
import { printBy } from "./paper.js";
import { Table, tellUnread } from "./tables.js";

/** Show each table once its columns are unpacked; a browser that is too old to do so is told. */
async function showTables() {
  for (const { name, columns } of readTables().map((table) => ({ name: table.name, columns: columnsOf(table) }))) {
    try {
      new Table(name, await columns);
    } catch (error) {
      tellUnread(name);
      throw error;
    }
  }
}

language.begin();
wireLinks();
printBy(element("#print-everything", HTMLInputElement));

/** For tests and other scripts: `ready` once all tables are shown. */
export const tables = { ready: showTables() };
