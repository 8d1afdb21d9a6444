// The table of programs: a page of rows at a time, so that thousands are as fast as ten.
import { both, element, make } from "../../html/assets/elements.js";
import { onChange, said } from "../../html/assets/language.js";
import { turningOf } from "../../html/assets/turning.js";
import { sorted } from "./asked.js";

/** @import { Column } from "./asked.js" */
/** @import { Listed } from "./data.js" */

/** @typedef {[name: string, column: Column | null, unit: string]} Head of a column, by which the table may be sorted */

const MOST_ROWS = 200;
const WORST_FIRST = new Set(["verdict", "findings", "time_s", "worst_um", "cut_um"]);

/**
 * The table in its place.
 * @template {Listed} P
 */
export class Table {
  /**
   * @param {{ programs: P[] }} index
   * @param {Head[]} columns
   * @param {(program: P) => HTMLElement} rowOf
   */
  constructor(index, columns, rowOf) {
    this.index = index;
    this.rowOf = rowOf;
    /** @type {number[]} */
    this.rows = [];
    /** @type {Column | null} */
    this.sortedBy = null;
    this.way = 1;
    this.first = 0;
    /** @type {Map<Column, HTMLElement>} */
    this.heads = new Map();
    this.body = make("tbody", {});
    const heads = columns.map(([name, column, unit]) => this.head(name, column, unit));
    this.table = make("table", {}, make("thead", {}, make("tr", {}, ...heads)), this.body);
    this.none = make("p", { className: "none" });
    this.place = element("#programs", HTMLElement);
    this.turning = make("div", { className: "pages" });
    this.place.append(this.table, this.none, this.turning);
    onChange(() => this.show());
  }

  /**
   * Head of a column, which sorts by it.
   * @param {string} name
   * @param {Column | null} column
   * @param {string} unit
   */
  head(name, column, unit) {
    const words = [...both(said(name)), ...(unit ? [make("span", { className: "unit" }, ...both(said(unit)))] : [])];
    if (column === null) return make("th", { scope: "col", className: name }, make("span", {}, ...words));
    const button = make("button", { type: "button" }, ...words);
    button.addEventListener("click", () => this.sort(column));
    const head = make("th", { scope: "col", className: name }, button);
    head.setAttribute("aria-sort", "none");
    this.heads.set(column, head);
    return head;
  }

  /**
   * Sort by a column, by the one it is sorted by the other way round.
   * @param {Column} column
   */
  sort(column) {
    this.way = this.sortedBy === column ? -this.way : WORST_FIRST.has(column) ? -1 : 1;
    this.sortedBy = column;
    for (const [name, head] of this.heads) {
      head.setAttribute("aria-sort", name !== column ? "none" : this.way > 0 ? "ascending" : "descending");
    }
    this.take(this.rows);
  }

  /**
   * Take the programs of these numbers.
   * @param {number[]} rows
   */
  take(rows) {
    this.rows = this.sortedBy === null ? rows : sorted(this.index.programs, rows, this.sortedBy, this.way);
    const turns = this.rows.length > MOST_ROWS;
    this.pages = turns ? turningOf(this.rows.length, MOST_ROWS, (first) => this.turnTo(first)) : null;
    this.turning.replaceChildren(...(this.pages ? [this.pages.box] : []));
    this.first = 0;
    this.show();
  }

  /**
   * Show the rows from one on.
   * @param {number} first
   */
  turnTo(first) {
    this.first = first;
    this.show();
    this.place.scrollIntoView();
  }

  /** Fill the table with the rows that are to be seen. */
  show() {
    const rows = this.rows.slice(this.first, this.first + MOST_ROWS);
    this.body.replaceChildren(...rows.map((row) => this.rowOf(this.index.programs[row])));
    this.table.hidden = rows.length === 0;
    this.none.hidden = rows.length > 0;
    this.none.replaceChildren(...both(said(this.index.programs.length ? "none" : "empty")));
    this.pages?.tell(this.first, this.first + rows.length);
  }
}
