// Cells of tables: what a value says, and in which order values stand.
import * as language from "../../html/assets/language.js";

/** @import { Code, Filled, Value } from "./data.js" */

const NOTHING = "–";
const collator = new Intl.Collator("en", { numeric: true }); // N9 before N10
/** @type {Map<number, Intl.NumberFormat>} */
const formats = new Map();

/**
 * What writes numbers with so many digits.
 * @param {number} digits
 */
function formatOf(digits) {
  const known = formats.get(digits);
  if (known) return known;
  const made = new Intl.NumberFormat("en-US", { minimumFractionDigits: digits, maximumFractionDigits: digits });
  formats.set(digits, made);
  return made;
}

/**
 * A number with so many digits, thousands apart.
 * @param {number} number
 * @param {number} digits
 */
function format(number, digits) {
  const text = formatOf(digits).format(number);
  return /^-[0.,]*$/.test(text) ? text.slice(1) : text;
}

/**
 * Text of a value of a column.
 * @param {Filled} column
 * @param {Value} value
 */
export function textOf(column, value) {
  if (value === null) return NOTHING;
  if (column.kind === "number") return format(Number(value) / column.per, column.digits);
  if (column.kind === "word") return language.pick(column.words[String(value)]);
  return String(value);
}

/**
 * Links to the findings of a block.
 * @param {Code[]} codes
 */
function links(codes) {
  const made = document.createDocumentFragment();
  for (const [code, address] of codes) {
    const link = document.createElement("a");
    link.href = `#${address}`;
    link.textContent = code;
    made.append(link, " ");
  }
  return made;
}

/**
 * Put a value into its cell.
 * @param {HTMLElement} cell
 * @param {Filled} column
 * @param {Value} value
 */
export function fill(cell, column, value) {
  cell.className = column.kind;
  if (Array.isArray(value)) cell.append(links(value));
  else cell.textContent = textOf(column, value);
}

/**
 * Order of two values of a column, of which neither is null.
 * @param {Filled} column
 * @param {NonNullable<Value>} one
 * @param {NonNullable<Value>} other
 */
function order(column, one, other) {
  if (column.kind === "number") return Number(one) - Number(other);
  if (Array.isArray(one) && Array.isArray(other)) return one.length - other.length || (String(one) < String(other) ? -1 : 1);
  return collator.compare(textOf(column, one), textOf(column, other));
}

/**
 * Row numbers as they stand.
 * @param {Filled} column
 */
export const rowsOf = ({ values }) => Array.from(values, (_, row) => row);

/**
 * Row numbers in the order of a column, `way` 1 rising or -1 falling; rows without a value last.
 * @param {Filled} column
 * @param {number} way
 */
export function sorted(column, way) {
  const { values } = column;
  return rowsOf(column).sort((a, b) => {
    const [one, other] = [values[a], values[b]];
    if (one === null || other === null) return Number(one === null) - Number(other === null) || a - b;
    return way * order(column, one, other) || a - b;
  });
}
