// The index that Python hands over to the page (sim/show/index_page/page.py): its JSON, by name and type.
import { element } from "../../html/assets/elements.js";

/** @import { Said } from "../../html/assets/language.js" */

/** @typedef {Program["verdict"]} Verdict */
/** @typedef {Pick<Program, "file" | "title" | "verdict" | "message" | "findings" | "picture">} Listed what any list has */

/** Written by `make pages` from the model in Python. */

/**
 * All of a shop.
 * @typedef {object} Index
 * @property {Program[]} programs
 * @property {Record<string, Said>} titles of the codes that occur
 * @property {[number, number]} box width and height of the pictures
 */

/**
 * A program as the page has it; what its run tells is null where there is none. `title_zh` is there where that is
 * another one, findings have the worst first. `drawing_um` is how far the cut is off the drawing that it was held
 * against, `folder` that of its files, beside the page.
 * @typedef {object} Program
 * @property {string} file
 * @property {string} title
 * @property {string | null} title_zh
 * @property {boolean} to_check
 * @property {FindingCount[]} findings
 * @property {number | null} time_s
 * @property {number | null} time_least_s
 * @property {number | null} time_most_s
 * @property {number | null} max_um
 * @property {number | null} drawing_um
 * @property {string | null} folder
 * @property {boolean} from_cache
 * @property {"pass" | "to-check" | "incomplete" | "fail" | "refused" | "fault"} verdict
 * @property {Said | null} message why there is no report
 * @property {string} time in hours, minutes and seconds; empty where nothing ran
 * @property {string} time_within its least and its most, as long; empty without an interval
 * @property {number | null} worst_um that from the drawing, else that of the wire
 * @property {string} picture data of an SVG path
 */

/**
 * How many findings a code has.
 * @typedef {object} FindingCount
 * @property {string} code
 * @property {"error" | "warning" | "note"} severity
 * @property {number} count
 */

/** Up to here. */

/**
 * The index of the page.
 * @returns {Index}
 */
export function readIndex() {
  return JSON.parse(element("#index", HTMLElement).textContent);
}
