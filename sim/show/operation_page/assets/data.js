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
 * The stepped path: `sim.process.ticks.state.Way`.
 * @typedef {object} PanelWay
 * @property {number[]} before
 * @property {number[]} along_um
 * @property {number[]} width_um
 * @property {number[]} thread_um
 * @property {number[]} wait_s
 */

/**
 * What each block is stepped by: X, Y and J in µm, count direction (0 for X), turn and quadrant.
 * @typedef {object} PanelWords
 * @property {number[]} x_um
 * @property {number[]} y_um
 * @property {number[]} count_um
 * @property {number[]} axis
 * @property {number[]} turn
 * @property {number[]} quadrant
 */

/**
 * Sparks: `sim.process.ticks.state.Discharge`.
 * @typedef {object} PanelDischarge
 * @property {number} on_us
 * @property {number} off_us
 * @property {number} crater_um3
 * @property {number} spread_um3
 * @property {number} height_um
 */

/**
 * The law: `sim.process.ticks.state.Servo`.
 * @typedef {object} PanelServo
 * @property {number} law
 * @property {number} gain_um_s
 * @property {number} reset_s
 * @property {number} least_um_s
 * @property {number} most_um_s
 * @property {number} ring_um
 */

/**
 * What stops the cut: `sim.process.ticks.state.Bounds`; no area rate where nobody knows one.
 * @typedef {object} PanelBounds
 * @property {number} short_s
 * @property {number | null} area_rate_mm2_min
 * @property {number} thread_s
 * @property {number} restart_s
 * @property {number} jog_um_s
 * @property {number} is_from_start
 */

/**
 * What happens: `sim.process.ticks.state.Happenings`.
 * @typedef {object} PanelEvents
 * @property {number[]} kind
 * @property {number[]} for_s
 * @property {number[]} size
 * @property {number[]} at
 * @property {number[]} by_step
 * @property {number[]} by_time
 */

/**
 * A mode of sparks, and its craters.
 * @typedef {object} PanelMode
 * @property {string} name
 * @property {number} crater_um3
 * @property {number} spread_um3
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
