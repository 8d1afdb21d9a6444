// What a long table is searched by: the name of a block, or a part of its text or of a code.
import { make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { textOf } from "./cells.js";

/** @import { Filled, Value } from "./data.js" */

const SEARCHED = new Set(["text", "code", "codes"]);

/**
 * What tells whether a row has what is asked for: in its first column as a whole, in columns of texts as a part.
 * @param {Filled[]} columns
 * @param {string} asked
 */
export function fittingOf(columns, asked) {
  const wanted = asked.trim().toLowerCase();
  const [first] = columns;
  const searched = columns.filter((column) => SEARCHED.has(column.kind));
  /** @param {Value} value */
  const has = (value) => value !== null && String(value).toLowerCase().includes(wanted);
  const number = wanted.replace(/,/g, "");
  /** @param {Value} value */
  const is = (value) => value !== null && (String(value) === number || textOf(first, value).toLowerCase() === wanted);
  return (/** @type {number} */ row) => !wanted || is(first.values[row]) || searched.some((column) => has(column.values[row]));
}

/**
 * A field to ask in, and a place that says how many rows fit; `onAsk(text)` hears of what is asked.
 * @param {(asked: string) => void} onAsk
 */
export function searchOf(onAsk) {
  const field = document.createElement("input");
  field.type = "search";
  const told = make("span", { className: "told" });
  told.setAttribute("role", "status");
  const box = make("label", { className: "search" }, field, told);
  field.addEventListener("input", () => onAsk(field.value));

  return {
    box,
    /**
     * Say how many of all rows fit; nothing where all do.
     * @param {number} n
     * @param {number} all
     */
    tell(n, all) {
      const name = language.say("find");
      field.placeholder = name;
      field.setAttribute("aria-label", name);
      const [some, of] = [n, all].map((number) => number.toLocaleString("en-US"));
      told.textContent = n < all ? language.say("found", { n: some, all: of }) : "";
    },
  };
}
