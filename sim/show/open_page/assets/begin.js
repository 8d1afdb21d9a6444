// What a page that holds nothing offers: a file, or an example to begin with.
import * as asked from "./asked.js";
import { element, elements } from "../../html/assets/elements.js";

/** @import { FileText } from "./data.js" */

/**
 * The offer over the empty picture.
 * @param {() => void} open lets a file be picked
 * @param {(read: FileText) => void} take opens an example
 * @param {() => void} onFailure
 */
export function wireBegin(open, take, onFailure) {
  const box = element("#begin", HTMLElement);
  for (const button of elements("[data-open]", box)) button.addEventListener("click", open);
  for (const button of elements("[data-start]", box)) {
    button.addEventListener("click", () => asked.example(button.dataset.start ?? "").then(take, onFailure));
  }
  return {
    /** @param {boolean} isShown */
    show(isShown) { box.hidden = !isShown; },
  };
}
