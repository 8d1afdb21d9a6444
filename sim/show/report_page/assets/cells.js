"use strict";
// Cells of tables: what a value says, and in which order values stand.
(function (global) {
  const Drycut = (global.Drycut = global.Drycut || {});
  const NOTHING = "–";
  const formats = new Map();

  /** A number with so many digits, thousands apart. */
  function format(number, digits) {
    if (!formats.has(digits)) {
      const fixed = { minimumFractionDigits: digits, maximumFractionDigits: digits };
      formats.set(digits, new Intl.NumberFormat("en-US", fixed));
    }
    const text = formats.get(digits).format(number);
    return /^-[0.,]*$/.test(text) ? text.slice(1) : text;
  }

  /** Text of a value of a column. */
  function textOf(column, value) {
    if (value === null) return NOTHING;
    if (column.kind === "number") return format(value / column.per, column.digits);
    if (column.kind === "word") return Drycut.language.pick(column.words[value]);
    return String(value);
  }

  /** Links to the findings of a block. */
  function links(codes) {
    const made = document.createDocumentFragment();
    for (const [code, address] of codes) {
      const link = document.createElement("a");
      link.href = "#" + address;
      link.textContent = code;
      made.append(link, " ");
    }
    return made;
  }

  /** Put a value into its cell. */
  function fill(cell, column, value) {
    cell.className = column.kind;
    if (column.kind === "codes") cell.append(links(value));
    else cell.textContent = textOf(column, value);
  }

  /** Order of two values of a column, of which neither is null. */
  function order(column, one, other) {
    if (column.kind === "number") return one - other;
    if (column.kind === "codes") return one.length - other.length || (String(one) < String(other) ? -1 : 1);
    const [a, b] = [textOf(column, one), textOf(column, other)];
    return a < b ? -1 : a > b ? 1 : 0;
  }

  /** Row numbers in the order of a column, `way` 1 rising or -1 falling; rows without a value last. */
  function sorted(column, way) {
    const values = column.values;
    const rows = values.map((_, row) => row);
    return rows.sort((a, b) => {
      const [one, other] = [values[a], values[b]];
      if (one === null || other === null) return (one === null) - (other === null) || a - b;
      return way * order(column, one, other) || a - b;
    });
  }

  Drycut.cells = { fill, sorted };
})(window);
