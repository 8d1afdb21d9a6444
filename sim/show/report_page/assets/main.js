// Puts the page together: its language, its tables and its links.
import * as language from "../../html/assets/language.js";
import { readTables } from "./data.js";
import { wireLinks } from "./links.js";
import { Table } from "./tables.js";

language.begin();
for (const data of readTables()) new Table(data);
wireLinks();
