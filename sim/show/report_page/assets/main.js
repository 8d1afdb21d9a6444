// Puts the page together: its language, its tables, its links, and what of it is printed.
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { readTables } from "./data.js";
import { wireLinks } from "./links.js";
import { printBy } from "./paper.js";
import { Table } from "./tables.js";

language.begin();
for (const data of readTables()) new Table(data);
wireLinks();
printBy(element("#print-everything", HTMLInputElement));
