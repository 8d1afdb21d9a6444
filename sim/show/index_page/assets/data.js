// The index that Python hands over to the page (sim/show/index_page/page.py): its JSON, by name and type.
import { element } from "../../html/assets/elements.js";

/** @import { Said } from "../../html/assets/language.js" */

/** @typedef {"pass" | "to-check" | "incomplete" | "fail" | "refused" | "fault"} Verdict incomplete of a check alone */

/**
 * Findings of one code.
 * @typedef {object} Found
 * @property {string} code
 * @property {"error" | "warning" | "note"} severity
 * @property {number} count
 */

/**
 * One program; what its run tells is null where there is none.
 * @typedef {object} Program
 * @property {string} file
 * @property {string} title
 * @property {string | null} title_zh in Chinese, where that is another one
 * @property {Verdict} verdict
 * @property {Said | null} message why there is no report
 * @property {Found[]} findings the worst first
 * @property {boolean} to_check
 * @property {number | null} time_s
 * @property {string} time in hours, minutes and seconds; empty where nothing ran
 * @property {number | null} max_um
 * @property {number | null} drawing_um deviation from the drawing, where it was held against one
 * @property {number | null} worst_um that from the drawing, else that of the wire
 * @property {string | null} folder of its files, beside the page
 * @property {boolean} from_cache
 * @property {string} picture data of an SVG path
 */

/** @typedef {Pick<Program, "file" | "title" | "verdict" | "message" | "findings" | "picture">} Listed what any list has */

/**
 * All of a shop.
 * @typedef {object} Index
 * @property {Program[]} programs
 * @property {Record<string, Said>} titles of the codes that occur
 * @property {[width: number, height: number]} box of the pictures
 */

/**
 * The index of the page.
 * @returns {Index}
 */
export function readIndex() {
  return JSON.parse(element("#index", HTMLElement).textContent);
}
