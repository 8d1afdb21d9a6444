// What the page hands over to its script.
import { element } from "../../html/assets/elements.js";

/** Written by `make pages` from the model in Python. */

/**
 * A cut that a panel drives. `blocks` are names and `texts` the words of the blocks that are cut, `starts_um` where
 * their steps begin, `points` evenly spaced places along each, x and y by turns. `usual_s` is the time that a stretch
 * of `stretch_um` takes at the usual feed, `gap_um` the gap at the walls then, `start_um` the path before the first
 * wall, by block; `half` are the stretches before and behind that a wall is in reach of. `digest` is of all that
 * decides the cut: a sitting names it.
 * @typedef {object} Panel
 * @property {string} digest
 * @property {string[]} blocks
 * @property {string[]} texts
 * @property {number[][]} starts_um
 * @property {number[][]} points
 * @property {PanelWay} way
 * @property {PanelWords} words
 * @property {PanelDischarge} discharge
 * @property {PanelServo} servo
 * @property {PanelBounds} bounds
 * @property {PanelEvents} events
 * @property {PanelMode[]} modes
 * @property {string} mode
 * @property {string} law
 * @property {number[]} seeds
 * @property {number} set_share
 * @property {number} open_v
 * @property {number} stretch_um
 * @property {number} half
 * @property {number[]} usual_s
 * @property {number[]} gap_um
 * @property {number[]} start_um
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
 * What happens: `sim.process.ticks.state.Events`.
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

/** Up to here. */

/**
 * The cut that the panel drives.
 * @returns {Panel}
 */
export function readPanel() {
  return JSON.parse(element("#panel", HTMLElement).textContent);
}
