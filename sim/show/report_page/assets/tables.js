"use strict";
// Tables of the page: shown from their data, sorted by a column, turned over by pages.
(function (global) {
  const Drycut = (global.Drycut = global.Drycut || {});
  const { said } = Drycut.language;
  const MOST_ROWS = 200;
  const LONG = 25; // rows of a table that may be parted between two sheets of paper

  /** An element with properties and children. */
  function make(tag, properties, ...children) {
    const element = Object.assign(document.createElement(tag), properties);
    element.append(...children);
    return element;
  }

  /** The texts of both languages, of which the page shows one. */
  function both(text) {
    return [make("span", { lang: "en" }, text.en), make("span", { lang: "zh-CN" }, text.zh)];
  }

  class Table {
    /** Show a table in the place that the page has for it. */
    constructor(data) {
      this.columns = data.columns;
      this.rows = data.columns[0].values.map((_, row) => row);
      this.sortedBy = null;
      this.way = 1;
      this.first = 0;
      this.body = make("tbody");
      this.heads = this.columns.map((column, at) => this.head(column, at));
      const place = document.querySelector(`[data-table="${data.name}"]`);
      const table = make("table", {}, make("thead", {}, make("tr", {}, ...this.heads)), this.body);
      table.setAttribute("aria-labelledby", `title-${data.name}`);
      const box = make("div", { className: "box", tabIndex: 0 }, table);
      box.setAttribute("role", "region");
      box.setAttribute("aria-labelledby", `title-${data.name}`);
      place.append(box);
      place.classList.toggle("long", this.rows.length > LONG);
      this.box = box;
      if (this.rows.length > MOST_ROWS) place.append(this.turning());
      this.show();
      Drycut.language.onChange(() => this.show());
    }

    /** Head of a column, which sorts by it. */
    head(column, at) {
      const unit = column.unit ? [make("span", { className: "unit" }, column.unit)] : [];
      const button = make("button", { type: "button" }, ...both(column.head), ...unit);
      button.addEventListener("click", () => this.sort(at));
      const head = make("th", { scope: "col", className: column.kind }, button);
      head.setAttribute("aria-sort", "none");
      return head;
    }

    /** Sort by a column, by the one it is sorted by the other way round. */
    sort(at) {
      this.way = this.sortedBy === at ? -this.way : 1;
      this.sortedBy = at;
      this.rows = Drycut.cells.sorted(this.columns[at], this.way);
      this.heads.forEach((head, number) => {
        head.setAttribute("aria-sort", number !== at ? "none" : this.way > 0 ? "ascending" : "descending");
      });
      this.turnTo(0);
    }

    /** Show the rows from one on. */
    turnTo(first) {
      this.first = first;
      this.box.scrollTop = 0;
      this.show();
    }

    /** Fill the body with the rows that are to be seen. */
    show() {
      const rows = this.rows.slice(this.first, this.first + MOST_ROWS);
      this.body.replaceChildren(...rows.map((row) => this.row(row)));
      if (this.count) this.tellPlace(this.first + rows.length);
    }

    /** One row; its first cell names it. */
    row(row) {
      const cells = this.columns.map((column, at) => {
        const cell = document.createElement(at ? "td" : "th");
        if (!at) cell.scope = "row";
        Drycut.cells.fill(cell, column, column.values[row]);
        return cell;
      });
      return make("tr", {}, ...cells);
    }

    /** What turns the pages. */
    turning() {
      const last = Math.floor((this.rows.length - 1) / MOST_ROWS) * MOST_ROWS;
      const turn = (text, to) => {
        const button = make("button", { type: "button" }, ...both(text));
        button.addEventListener("click", () => this.turnTo(Math.min(last, Math.max(0, to()))));
        return button;
      };
      this.back = turn(said("back"), () => this.first - MOST_ROWS);
      this.next = turn(said("next"), () => this.first + MOST_ROWS);
      this.start = turn(said("first"), () => 0);
      this.end = turn(said("last"), () => last);
      this.count = make("span", { className: "count" });
      this.count.setAttribute("aria-live", "polite");
      const rest = make("p", { className: "rest" }, ...both(said("rest")));
      return make("div", {}, make("div", { className: "turning" }, this.start, this.back, this.count, this.next, this.end), rest);
    }

    /** Say which rows are to be seen. */
    tellPlace(end) {
      const [first, last, all] = [this.first + 1, end, this.rows.length].map((n) => n.toLocaleString("en-US"));
      this.count.replaceChildren(...both(said("rows", { first, last, all })));
      this.start.disabled = this.back.disabled = this.first === 0;
      this.next.disabled = this.end.disabled = end === this.rows.length;
    }
  }

  for (const data of JSON.parse(document.getElementById("tables").textContent)) new Table(data);
})(window);
