// What the server answers (sim/serve/page/model.py): its JSON, by name and type. Places in a text count UTF-16 units.

/**
 * @import { Said } from "../../html/assets/language.js"
 * @import { FindingCount } from "../../index_page/assets/data.js"
 * @import { Curves, Place } from "../../replay/assets/document.js"
 */

/** @typedef {Finding["edits"][number]} Edit First, past, and the text in their place. */

/** Written by `make pages` from the model in Python. */

/**
 * What is found in a text, and its path.
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
 * A finding of a text.
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
 * @property {[number, number, string][]} edits that certainly mend it
 */

/**
 * The page of a code, Markdown.
 * @typedef {object} Explained
 * @property {Said} why
 * @property {Said} mend
 */

/**
 * A path: its columns, where each block stands in the text, and when it begins; `border_s` has n + 1.
 * @typedef {object} Path
 * @property {("line" | "arc" | "jump")[]} kind
 * @property {number[]} place_x_um
 * @property {number[]} place_y_um
 * @property {number[]} center_x_um of an arc
 * @property {number[]} center_y_um of an arc
 * @property {number[]} radius_um of an arc
 * @property {number[]} start_angle_rad of an arc
 * @property {number[]} sweep_rad of an arc
 * @property {number[]} length_um
 * @property {number[]} line
 * @property {number[]} first
 * @property {number[]} past
 * @property {string[]} name of each block as the listing has it
 * @property {number[]} border_s at the machine's feeds
 * @property {boolean[]} is_lead
 */

/**
 * A contour by its first and last blocks.
 * @typedef {object} Figure
 * @property {number} first
 * @property {number} last
 * @property {number} length_um
 * @property {boolean | null} closes null of a parting cut
 * @property {Place} thread_um
 */

/**
 * How large a program is.
 * @typedef {object} Size
 * @property {number} lines
 * @property {number} arcs
 * @property {number} rapids
 * @property {number} cut_um
 * @property {[number, number, number, number] | null} box_um
 * @property {number} steps
 * @property {Said} time about how long the cut takes
 */

/**
 * The places where the lines of two texts differ.
 * @typedef {object} Changes
 * @property {Change[]} places
 * @property {number} more places that are not told
 */

/**
 * Lines that are others than in an earlier text.
 * @typedef {object} Change
 * @property {number} line from 1, in the text after
 * @property {string} before
 * @property {string} after
 * @property {[number, number]} lines how many before and after; of long ones the first are told
 */

/**
 * The program that was made of a drawing, none where it was refused; what there is to say, and of its proof.
 * @typedef {object} Drafted
 * @property {FileText | null} program
 * @property {Said[]} told
 * @property {"pass" | "to-check" | "incomplete" | "fail"} verdict
 */

/**
 * A file as a text with lines that end with LF, and what brings back its bytes; of a drawing its number.
 * @typedef {object} FileText
 * @property {string} name
 * @property {string | null} text null where it is none
 * @property {string} encoding
 * @property {string} newline how all lines end; where they end in several ways, a letter for each
 * @property {string} number of the program whose file it is; empty where it came to the page
 * @property {string} [drawing]
 * @property {MachineFile} [machine]
 * @property {MachineFile[]} [technologies] one for each material that the file knows
 * @property {Said} [why] what was to be open at the start could not be, or is no machine
 * @property {Recent[]} [recent] where nothing is open at the start
 */

/**
 * A machine file that came to the page: the name by which a form names it, and what people call the machine.
 * @typedef {object} MachineFile
 * @property {string} name
 * @property {Said} title
 */

/**
 * A file that was opened before, and the number that it has as a program.
 * @typedef {object} Recent
 * @property {string} name
 * @property {string} folder
 * @property {string} number
 */

/**
 * A drawing: its curves as they lie beneath the program, and what there is to say; else why not.
 * @typedef {object} Looked
 * @property {string} [unit]
 * @property {Curves} [curves]
 * @property {Placement} [placement]
 * @property {Said[]} told
 * @property {Said | null} [why]
 */

/**
 * Where a drawing lies beneath a program: mirrored, x to −x, then turned about (0, 0), then shifted.
 * @typedef {object} Placement
 * @property {number} turn_rad
 * @property {Place} shift_um
 * @property {boolean} mirror
 */

/**
 * What would be cut of a drawing, as it lies beneath the program, not proved; else why nothing.
 * @typedef {object} Planned
 * @property {Curves} [path]
 * @property {boolean[]} [is_lead]
 * @property {number[]} [row_pass] pass of its figure that each block is of, from 1; 0 of others
 * @property {boolean[]} [is_left] whether the waste is on the left of each block
 * @property {PlannedFigure[]} [figures] in the order in which they are cut
 * @property {Said[]} [told]
 * @property {Said | null} [why]
 */

/**
 * A figure of a plan: its number, of each of its contours the first row and one past its last, and how it is cut. It
 * is cut from `entry_um` on the drawing, with the wire towards `out`, a unit vector; `is_ccw` is its direction in the
 * drawing, `is_inside` whether the wire runs inside of it. `tab_um` is where its tab begins, none where it has none.
 * @typedef {object} PlannedFigure
 * @property {number} number
 * @property {number[][]} spans
 * @property {Place} thread_um
 * @property {Place} entry_um
 * @property {Place} out
 * @property {boolean} is_ccw
 * @property {boolean} is_inside
 * @property {Place | null} tab_um
 */

/**
 * How far the check of a folder is.
 * @typedef {object} Rows
 * @property {Row[]} rows
 * @property {string} folder empty where none is open
 * @property {number} list another one once the folder was looked through again
 * @property {number} total
 * @property {number} left_out
 * @property {boolean} is_over
 */

/**
 * A program in a list.
 * @typedef {object} Row
 * @property {string} file
 * @property {string} title
 * @property {"pass" | "to-check" | "incomplete" | "fail" | "refused" | "fault"} verdict
 * @property {Said | null} message why there is no program
 * @property {FindingCount[]} findings the worst first
 * @property {Record<string, Said>} titles of their codes
 * @property {string} picture data of an SVG path
 * @property {number | null} cut_um
 * @property {[number, number, number, number] | null} box_um
 * @property {string} [number] of a program of the folder
 */

/**
 * How far a run is, or what more is made of it.
 * @typedef {object} RunState
 * @property {"pass" | "to-check" | "fail"} [verdict]
 * @property {Said} [machine]
 * @property {Finding[]} [findings] that the run itself made, beyond those of the check
 * @property {Record<string, Explained>} [pages] of their codes
 * @property {"idle" | "running" | "done" | "wrong" | "cancelled"} state
 * @property {"run" | "film" | "pictures" | "drills" | "program"} [job]
 * @property {number} [run]
 * @property {string} [stage]
 * @property {number} [at]
 * @property {number} [of]
 * @property {number} [share]
 * @property {Said | null} [why]
 * @property {MadeFile[]} [files] once it has ended well
 */

/**
 * A file of a run.
 * @typedef {object} MadeFile
 * @property {string} name
 * @property {number} bytes
 */

/** Up to here. */

export const SEVERITIES = /** @type {const} */ (["error", "warning", "note"]);

/** Words of the verdicts. */
export const VERDICTS = {
  pass: "verdict-pass", "to-check": "verdict-to-check", fail: "verdict-fail", incomplete: "verdict-incomplete", none: "verdict-none",
};
