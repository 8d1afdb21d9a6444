// Tables of the page: shown from their data, sorted by a column, turned over by pages.
import { both, element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { fill, sorted } from "./cells.js";
import { turningOf } from "../../html/assets/turning.js";

/** @import { Column, TableData } from "./data.js" */

const MOST_ROWS = 200;
const MOST_PRINTED = 2000; // rows: some forty sheets of paper
const LONG = 12; // rows of a table that may be parted between two sheets of paper

/** A table in the place that the page has for it. */
export class Table {
  /** @param {TableData} data */
  constructor(data) {
    this.columns = data.columns;
    this.rows = data.columns[0].values.map((_, row) => row);
    /** @type {number | null} */
    this.sortedBy = null;
    this.way = 1;
    this.first = 0;
    this.body = make("tbody", {});
    this.heads = this.columns.map((column, at) => this.head(column, at));
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...this.heads)), this.body);
    table.setAttribute("aria-labelledby", `title-${data.name}`);
    this.box = make("div", { className: "box", tabIndex: 0 }, table);
    this.box.setAttribute("role", "region");
    this.box.setAttribute("aria-labelledby", `title-${data.name}`);
    const place = element(`[data-table="${data.name}"]`, HTMLElement);
    place.append(this.box);
    place.classList.toggle("long", this.rows.length > LONG);
    const isTurned = this.rows.length > MOST_ROWS;
    this.turning = isTurned ? turningOf(this.rows.length, MOST_ROWS, (first) => this.turnTo(first)) : null;
    if (this.turning) place.append(this.turning.box);
    this.show();
    language.onChange(() => this.show());
    if (isTurned && this.rows.length <= MOST_PRINTED) this.printAll();
  }

  /** Have all rows while the page is printed. */
  printAll() {
    window.addEventListener("beforeprint", () => {
      this.box.parentElement?.classList.add("whole");
      this.fill(this.rows);
    });
    window.addEventListener("afterprint", () => {
      this.box.parentElement?.classList.remove("whole");
      this.show();
    });
  }

  /**
   * Fill the body with rows.
   * @param {number[]} rows
   */
  fill(rows) {
    this.body.replaceChildren(...rows.map((row) => this.row(row)));
  }

  /**
   * Head of a column, which sorts by it.
   * @param {Column} column
   * @param {number} at
   */
  head(column, at) {
    const unit = column.unit ? [make("span", { className: "unit" }, column.unit)] : [];
    const button = make("button", { type: "button" }, ...both(column.head), ...unit);
    button.addEventListener("click", () => this.sort(at));
    const head = make("th", { scope: "col", className: column.kind }, button);
    head.setAttribute("aria-sort", "none");
    return head;
  }

  /**
   * Sort by a column, by the one it is sorted by the other way round.
   * @param {number} at
   */
  sort(at) {
    this.way = this.sortedBy === at ? -this.way : 1;
    this.sortedBy = at;
    this.rows = sorted(this.columns[at], this.way);
    this.heads.forEach((head, number) => {
      head.setAttribute("aria-sort", number !== at ? "none" : this.way > 0 ? "ascending" : "descending");
    });
    this.turnTo(0);
  }

  /**
   * Show the rows from one on.
   * @param {number} first
   */
  turnTo(first) {
    this.first = first;
    this.box.scrollTop = 0;
    this.show();
  }

  /** Fill the body with the rows that are to be seen. */
  show() {
    const rows = this.rows.slice(this.first, this.first + MOST_ROWS);
    this.fill(rows);
    this.turning?.tell(this.first, this.first + rows.length);
  }

  /**
   * One row; its first cell names it.
   * @param {number} row
   */
  row(row) {
    const cells = this.columns.map((column, at) => {
      const cell = at ? make("td", {}) : make("th", { scope: "row" });
      fill(cell, column, column.values[row]);
      return cell;
    });
    return make("tr", {}, ...cells);
  }
}
