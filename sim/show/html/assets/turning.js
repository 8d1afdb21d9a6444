// What turns the pages of a long table, and says which rows are to be seen.
import { both, make } from "./elements.js";
import { said } from "./language.js";

/** @import { Said } from "./language.js" */

/**
 * Buttons and a place for a table of so many rows; `turnTo(first)` is called with the first row to show.
 * @param {number} rows
 * @param {number} most rows shown at once
 * @param {(first: number) => void} turnTo
 */
export function turningOf(rows, most, turnTo) {
  const last = Math.floor((rows - 1) / most) * most;
  let shown = 0;

  /**
   * A button that leads to another row.
   * @param {Said} text
   * @param {() => number} to
   */
  function turn(text, to) {
    const button = make("button", { type: "button" }, ...both(text));
    button.addEventListener("click", () => turnTo(Math.min(last, Math.max(0, to()))));
    return button;
  }

  const back = turn(said("back"), () => shown - most);
  const next = turn(said("next"), () => shown + most);
  const start = turn(said("first"), () => 0);
  const end = turn(said("last"), () => last);
  const count = make("span", { className: "count" });
  count.setAttribute("aria-live", "polite");
  const rest = make("p", { className: "rest" }, ...both(said("rest")));
  const box = make("div", {}, make("div", { className: "turning" }, start, back, count, next, end), rest);

  /**
   * Say which rows are to be seen, from `first` up to before `past`.
   * @param {number} first
   * @param {number} past
   */
  function tell(first, past) {
    shown = first;
    const [from, to, all] = [first + 1, past, rows].map((number) => number.toLocaleString("en-US"));
    count.replaceChildren(...both(said("rows", { first: from, last: to, all })));
    start.disabled = back.disabled = first === 0;
    next.disabled = end.disabled = past === rows;
  }

  return { box, tell };
}
