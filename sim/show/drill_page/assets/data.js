// What the page hands over to its script.
import { element } from "../../html/assets/elements.js";

/** @import { Said } from "../../html/assets/language.js" */

/** Written by `make pages` from the model in Python. */

/**
 * The number of the set, its tasks, and what the kinds of fault and the levels are called.
 * @typedef {object} Drills
 * @property {number} set
 * @property {Drill[]} drills
 * @property {Record<string, Said>} groups
 * @property {Record<string, Said>} levels
 */

/**
 * A task: lines of the program that are right answers, what is wrong, and what gives it away.
 * @typedef {object} Drill
 * @property {number[]} lines
 * @property {string} group
 * @property {"words" | "picture" | "sums"} level
 */

/** Up to here. */

/**
 * The number of the set, and its tasks.
 * @returns {Drills}
 */
export function readDrills() {
  return JSON.parse(element("#drills", HTMLElement).textContent);
}
