// The keyboard: every key names an action; a key that the focused control uses itself is left to it.

import { element } from "../../html/assets/elements.js";

/**
 * @import { Actions } from "./controls.js"
 * @import { Quiz } from "./quiz.js"
 */

/**
 * Name of the action of each key, as the page hands it over.
 * @returns {Record<string, string>}
 */
export const readKeys = () => JSON.parse(element("#keys", HTMLElement).textContent ?? "{}");
/** @type {Record<string, string>} */
const SHIFTED = { ArrowLeft: "panLeft", ArrowRight: "panRight", ArrowUp: "panUp", ArrowDown: "panDown" };
/**
 * Keys that a focused control uses itself, by its tag.
 * @type {Record<string, string[]>}
 */
const OWN = {
  BUTTON: [" ", "Enter"],
  SELECT: [" ", "Enter", "ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "Home", "End", "PageUp", "PageDown"],
  INPUT: ["ArrowUp", "ArrowDown", "ArrowLeft", "ArrowRight", "Home", "End", "PageUp", "PageDown"],
};

/**
 * Whether the focused control uses a key itself.
 * @param {KeyboardEvent} event
 */
function isOwn({ target, key }) {
  return target instanceof Element && Boolean(OWN[target.tagName]?.includes(key));
}

/**
 * Action of a key press, or null.
 * @param {KeyboardEvent} event
 * @param {Record<string, string>} keys
 */
export function actionOf(event, keys) {
  if (event.ctrlKey || event.metaKey || event.altKey || isOwn(event)) return null;
  if (event.shiftKey && SHIFTED[event.key]) return SHIFTED[event.key];
  return keys[event.key.length === 1 ? event.key.toLowerCase() : event.key] || null;
}

/**
 * Have keys call actions; an open dialog has them for itself; digits answer an open question, Esc ends the quiz.
 * @param {Actions} actions
 * @param {Quiz} quiz
 */
export function wireKeys(actions, quiz) {
  const keys = readKeys();
  document.addEventListener("keydown", (event) => {
    if (document.querySelector("dialog[open]")) return;
    if (quiz.isOpen) {
      if (event.key === "Escape") quiz.toggle();
      else if (quiz.isAsking && /^[1-9]$/.test(event.key)) quiz.choose(Number(event.key) - 1);
      return;
    }
    const action = actionOf(event, keys);
    if (!action) return;
    event.preventDefault();
    actions[action]();
  });
}
