// What the page hands over to its script.
import { element } from "../../html/assets/elements.js";

/** @import { Panel } from "../../panel_page/assets/data.js" */

/** Written by `make pages` from the model in Python. */

/**
 * A set of drills on one cut.
 * @typedef {object} Operation
 * @property {number} set
 * @property {Panel} panel
 * @property {OperationDrill[]} drills
 * @property {string[]} kinds
 * @property {string[]} actions
 */

/**
 * A drill: what happened, the state of the loop then, and the way in twenty seconds from which on a cut goes on.
 * @typedef {object} OperationDrill
 * @property {string} kind
 * @property {number[]} state
 * @property {number} least_um
 */

/** Up to here. */

/**
 * The drills.
 * @returns {Operation}
 */
export function readDrills() {
  return JSON.parse(element("#drills", HTMLElement).textContent);
}
