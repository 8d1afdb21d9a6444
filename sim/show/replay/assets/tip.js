// A tooltip: a title and pairs of name and value, beside a point of the window.
import { make } from "../../html/assets/elements.js";

const GAP = 14;

/**
 * Tooltip in an element.
 * @param {HTMLElement} box
 */
export function tipIn(box) {
  return {
    hide() { box.hidden = true; },
    /**
     * Show a title and pairs beside (x, y).
     * @param {string} title
     * @param {[name: string, value: string][]} pairs
     * @param {number} x
     * @param {number} y
     */
    show(title, pairs, x, y) {
      const rows = pairs.flatMap(([name, value]) => [make("dt", {}, name), make("dd", {}, value)]);
      box.replaceChildren(make("strong", {}, title), make("dl", {}, ...rows));
      box.hidden = false;
      const { width, height } = box.getBoundingClientRect();
      const left = x + GAP + width > window.innerWidth ? Math.max(4, x - GAP - width) : x + GAP;
      const top = y + GAP + height > window.innerHeight ? Math.max(4, y - GAP - height) : y + GAP;
      box.style.transform = `translate(${left}px, ${top}px)`;
    },
  };
}
