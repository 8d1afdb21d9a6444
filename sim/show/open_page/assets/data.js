// What the server answers (sim/serve/page/answers.py): its JSON, by name and type. Places in a text count UTF-16 units.

/**
 * @import { Said } from "../../html/assets/language.js"
 * @import { Found, Verdict } from "../../index_page/assets/data.js"
 * @import { Curves } from "../../replay/assets/document.js"
 */

/**
 * A file as a text with lines that end with LF, and what brings back its bytes; of a drawing its number.
 * @typedef {object} FileText
 * @property {string} [drawing]
 * @property {string} name
 * @property {string | null} text null where it is none
 * @property {string} encoding
 * @property {string} newline how all lines end; where they end in several ways, a letter for each
 * @property {string} number of the program whose file it is; empty where it came to the page
 * @property {Said | null} [why] what was to be open at the start could not be
 */

/** @typedef {[first: number, past: number, text: string]} Edit */

/**
 * A drawing (sim/serve/page/drafter.py): its curves as they lie beneath the program, and what there is to say; else why not.
 * @typedef {object} Looked
 * @property {Curves} [curves]
 * @property {Said[]} told
 * @property {Said | null} [why]
 */

/**
 * The program that was made of a drawing; none where it was refused, and what there is to say.
 * @typedef {object} Drafted
 * @property {FileText | null} program
 * @property {Said[]} told
 * @property {boolean} is_proved
 */

/**
 * @typedef {object} Finding
 * @property {string} code
 * @property {"error" | "warning" | "note"} severity
 * @property {Said} title
 * @property {Said} message
 * @property {Said} hint
 * @property {number} line from 1; 0 of the whole program
 * @property {number} block
 * @property {string} block_name as the listing has it
 * @property {number} first
 * @property {number} past
 * @property {Edit[]} edits that certainly mend it
 */

/**
 * The page of a code, Markdown.
 * @typedef {object} Explained
 * @property {Said} why
 * @property {Said} mend
 */

/**
 * Where each block stands in the text.
 * @typedef {object} Sources
 * @property {number[]} line
 * @property {number[]} first
 * @property {number[]} past
 * @property {string[]} name of each block as the listing has it
 */

/**
 * A path: when each block begins at the machine's feeds, one more than blocks, and which of them are leads.
 * @typedef {Curves & Sources & { length_um: number[], border_s: number[], is_lead: boolean[] }} Path
 */

/**
 * @typedef {object} Figure
 * @property {number} first
 * @property {number} last
 * @property {number} length_um
 * @property {boolean | null} closes null of a parting cut
 * @property {[x: number, y: number]} thread_um
 */

/**
 * @typedef {object} Size
 * @property {number} lines
 * @property {number} arcs
 * @property {number} rapids
 * @property {number} cut_um
 * @property {[left: number, bottom: number, right: number, top: number] | null} box_um
 * @property {number} steps
 * @property {Said} time about how long the cut takes
 */

/**
 * @typedef {object} Answer
 * @property {string} name
 * @property {string} dialect
 * @property {"pass" | "to-check" | "incomplete" | "fail" | "none"} verdict
 * @property {string} settings why the settings near its file do not count; else empty
 * @property {Finding[]} findings
 * @property {Record<string, Explained>} pages of their codes
 * @property {Path | null} path
 * @property {Figure[]} figures
 * @property {Size | null} size
 * @property {Said} machine whose feeds and travel count
 */

/**
 * Lines that are others than in an earlier text (sim/serve/page/app.py).
 * @typedef {object} Place
 * @property {number} line from 1, in the text after
 * @property {string} before
 * @property {string} after
 * @property {[before: number, after: number]} lines how many; of long ones the first are told
 */

/**
 * @typedef {object} Changes
 * @property {Place[]} places
 * @property {number} more places that are not told
 */

/**
 * A program in a list (sim/serve/page/programs.py).
 * @typedef {object} Row
 * @property {string} file
 * @property {string} title
 * @property {Verdict} verdict
 * @property {Said | null} message why there is no program
 * @property {Found[]} findings the worst first
 * @property {Record<string, Said>} titles of their codes
 * @property {string} picture data of an SVG path
 * @property {number | null} cut_um
 * @property {[left: number, bottom: number, right: number, top: number] | null} box_um
 * @property {string} [number] of a program of the folder
 */

/**
 * How far the check of a folder is (sim/serve/page/programs.py).
 * @typedef {object} Rows
 * @property {string} folder empty where none is open
 * @property {number} list another one once the folder was looked through again
 * @property {number} total
 * @property {number} left_out
 * @property {boolean} is_over
 * @property {Row[]} rows
 */

/**
 * A file of a run.
 * @typedef {object} MadeFile
 * @property {string} name
 * @property {number} bytes
 */

/**
 * How far a run is, or what more is made of it (sim/serve/page/runs.py).
 * @typedef {object} RunState
 * @property {"idle" | "running" | "done" | "wrong" | "cancelled"} state
 * @property {"run" | "film" | "pictures" | "program"} [job]
 * @property {number} [run]
 * @property {string} [stage]
 * @property {number} [at]
 * @property {number} [of]
 * @property {number} [share]
 * @property {"pass" | "to-check" | "fail"} [verdict]
 * @property {Said} [machine]
 * @property {Said | null} [why]
 * @property {Finding[]} [findings] that the run itself made, beyond those of the check
 * @property {Record<string, Explained>} [pages] of their codes
 * @property {MadeFile[]} [files] once it has ended well
 */

export const SEVERITIES = /** @type {const} */ (["error", "warning", "note"]);

/** Words of the verdicts. */
export const VERDICTS = {
  pass: "verdict-pass", "to-check": "verdict-to-check", fail: "verdict-fail", incomplete: "verdict-incomplete", none: "verdict-none",
};
