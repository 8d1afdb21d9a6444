// What the page hands over to its script.
import { element } from "../../html/assets/elements.js";

/**
 * A task: lines of the program that are right answers, what is wrong, and what gives it away.
 * @typedef {object} Drill
 * @property {number[]} lines
 * @property {string} group
 * @property {"words" | "picture" | "sums"} level
 */

/**
 * The number of the set, and its tasks.
 * @returns {{ set: number, drills: Drill[] }}
 */
export function readDrills() {
  return JSON.parse(element("#drills", HTMLElement).textContent);
}
