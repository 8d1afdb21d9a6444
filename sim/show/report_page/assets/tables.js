// Tables of the page: shown from their data, sorted by a column; long ones are searched and turned over by pages.
import { both, element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { turningOf } from "../../html/assets/turning.js";
import { fill, rowsOf, sorted } from "./cells.js";
import { save } from "../../html/assets/csv.js";
import { csvOf } from "./csv.js";
import { fittingOf, searchOf } from "./search.js";

/** @import { Filled } from "./data.js" */

const MOST_ROWS = 200;
const MOST_PRINTED = 2000; // rows: some forty sheets of paper
const LONG = 12; // rows of a table that may be parted between two sheets of paper

/** @param {string} name */
const placeOf = (name) => element(`[data-table="${name}"]`, HTMLElement);

/**
 * Say that a browser is too old for a table.
 * @param {string} name
 */
export function tellUnread(name) {
  placeOf(name).append(make("p", { className: "unread" }, ...both(language.said("unread"))));
}

/** A table in the place that the page has for it. */
export class Table {
  /**
   * @param {string} name
   * @param {Filled[]} columns
   */
  constructor(name, columns) {
    this.name = name;
    this.columns = columns;
    this.order = rowsOf(columns[0]); // of all rows
    this.rows = this.order; // those that fit what is asked for
    this.asked = "";
    /** @type {number | null} */
    this.sortedBy = null;
    this.way = 1;
    this.first = 0;
    this.most = MOST_ROWS;
    this.body = make("tbody", {});
    this.heads = this.columns.map((column, at) => this.head(column, at));
    const table = make("table", {}, make("thead", {}, make("tr", {}, ...this.heads)), this.body);
    table.setAttribute("aria-labelledby", `title-${name}`);
    this.box = make("div", { className: "box", tabIndex: 0 }, table);
    this.box.setAttribute("role", "region");
    this.box.setAttribute("aria-labelledby", `title-${name}`);
    this.pages = make("div", { className: "pages" });
    const place = placeOf(name);
    place.append(this.box, this.pages);
    place.classList.toggle("long", this.order.length > LONG);
    if (this.order.length > MOST_ROWS) this.box.before(this.tools());
    this.take();
    language.onChange(() => this.show());
    window.addEventListener("beforeprint", () => this.print(true));
    window.addEventListener("afterprint", () => this.print(false));
  }

  /** What a long table is searched by, and saved. */
  tools() {
    this.search = searchOf((asked) => {
      this.asked = asked;
      this.take();
    });
    const button = make("button", { type: "button" }, ...both(language.said("csv")));
    button.addEventListener("click", () => save(`${this.name}.csv`, csvOf(this.columns, this.order)));
    return make("div", { className: "tools" }, this.search.box, button);
  }

  /** Take the rows that fit what is asked for, in order, and show the first of them. */
  take() {
    this.rows = this.asked ? this.order.filter(fittingOf(this.columns, this.asked)) : this.order;
    const isTurned = this.rows.length > this.most;
    this.turning = isTurned ? turningOf(this.rows.length, MOST_ROWS, (first) => this.turnTo(first)) : null;
    this.pages.replaceChildren(...(this.turning ? [this.turning.box] : []));
    this.turnTo(0);
  }

  /**
   * On paper have all rows, unless they are too many.
   * @param {boolean} isPaper
   */
  print(isPaper) {
    if (this.rows.length <= MOST_ROWS || this.rows.length > MOST_PRINTED) return;
    this.most = isPaper ? MOST_PRINTED : MOST_ROWS;
    this.take();
  }

  /**
   * Head of a column, which sorts by it.
   * @param {Filled} column
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
    this.order = sorted(this.columns[at], this.way);
    this.heads.forEach((head, number) => {
      head.setAttribute("aria-sort", number !== at ? "none" : this.way > 0 ? "ascending" : "descending");
    });
    this.take();
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
    const rows = this.rows.slice(this.first, this.first + this.most);
    this.body.replaceChildren(...rows.map((row) => this.row(row)));
    this.search?.tell(this.rows.length, this.order.length);
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
