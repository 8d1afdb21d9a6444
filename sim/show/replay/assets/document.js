// The document that Python hands over to the page (sim/show/replay/document.py): its JSON, by name and type.
// Rows of blocks count from 0, steps from 1; places and lengths are µm of the program.

/** @import { Said } from "../../html/assets/language.js" */

/** @typedef {[x: number, y: number]} Place */

/**
 * @typedef {object} ReplayDocument
 * @property {string} schema
 * @property {string} drycut
 * @property {string} title
 * @property {string} provenance
 * @property {"pass" | "fail"} verdict
 * @property {number} duration_s
 * @property {Program} program
 * @property {string} machine
 * @property {string} interpolator "point-by-point", "card" …
 * @property {number} wire_diameter_um
 * @property {number} offset_um
 * @property {number} thickness_mm
 * @property {[Place, Place]} travel_um
 * @property {Place[] | null} work_um
 * @property {Clamp[]} clamps
 * @property {boolean} has_jumps
 * @property {Blocks} blocks
 * @property {Decoding | null} decoding null where the dialect decodes no words, and of long programs
 * @property {Plan} plan
 * @property {Stop[]} stops
 * @property {Contour[]} contours
 * @property {Pass[]} passes none where every edge is cut once
 * @property {Finding[]} findings
 * @property {Loss[]} losses
 * @property {Ending | null} ended
 * @property {Piece[]} pieces
 * @property {{ own: Question[], pool: Question[], sets: number[][] }} quiz of the scenario, of any program, and which of these make a set
 * @property {Tape} tape
 */

/**
 * @typedef {object} Program
 * @property {string} name
 * @property {string} dialect
 * @property {boolean} is_worded whether the steps are counted by words of the program, not by the controller's own
 * @property {string[]} lines
 */

/**
 * @typedef {object} Clamp
 * @property {string} name
 * @property {Place[]} outline_um
 */

/** @typedef {"center_x_um" | "center_y_um" | "radius_um" | "start_angle_rad" | "sweep_rad"} OfArcs */
/** @typedef {Pick<Blocks, "kind" | "place_x_um" | "place_y_um" | OfArcs>} Curves What a path is drawn by. */

/**
 * Columns of n blocks; `place_*`, `first_step` and `border_s` have n + 1. What only an arc has is null elsewhere, where
 * nothing asks for it.
 * @typedef {object} Blocks
 * @property {Kind[]} kind
 * @property {number[]} place_x_um
 * @property {number[]} place_y_um
 * @property {number[]} center_x_um of an arc
 * @property {number[]} center_y_um of an arc
 * @property {number[]} radius_um of an arc
 * @property {number[]} start_angle_rad of an arc
 * @property {number[]} sweep_rad of an arc
 * @property {number[]} length_um
 * @property {number[]} word_x_um
 * @property {number[]} word_y_um
 * @property {number[]} count_um
 * @property {Axis[]} count_axis
 * @property {number[]} quadrant
 * @property {(-1 | 0 | 1)[]} turn
 * @property {number[]} number
 * @property {number[]} line
 * @property {number[]} character
 * @property {number[]} characters
 * @property {string[]} name what people call it
 * @property {string[]} label where its number stands beside it; empty where it has none
 * @property {number[]} first_step
 * @property {number[]} border_s
 */

/**
 * How the blocks are decoded; `of_row` has for each row of the blocks the index of its decoded block, or −1.
 * @typedef {object} Decoding
 * @property {number[]} of_row
 * @property {DecodedBlock[]} blocks
 */

/**
 * @typedef {object} DecodedBlock
 * @property {string} text
 * @property {DecodeStep[]} steps
 * @property {string} buffer
 * @property {NamedText[]} ways
 */

/**
 * @typedef {object} DecodeStep
 * @property {string} order
 * @property {Said} word
 * @property {string} field
 * @property {Said} value
 */

/** @typedef {{ name: Said, text: Said }} NamedText */

/** @typedef {"jump" | "line" | "arc"} Kind */
/** @typedef {"X" | "Y"} Axis */

/**
 * Columns of p phases; `t_s` has p + 1.
 * @typedef {object} Plan
 * @property {number[]} t_s
 * @property {number[]} speed_um_s
 * @property {number[]} acceleration_um_s2
 * @property {number[] | null} jerk_um_s3
 */

/**
 * @typedef {object} Stop
 * @property {string} kind
 * @property {number} after so many blocks
 * @property {number} line
 */

/**
 * @typedef {object} Contour
 * @property {number} first_row
 * @property {number} last_row
 * @property {number} closure_exact_um
 * @property {number} closure_stepped_um
 */

/**
 * A pass over an edge: its rows without leads, and the name of its colour in the style sheet.
 * @typedef {object} Pass
 * @property {number} first_row
 * @property {number} last_row
 * @property {number} number
 * @property {PassPaint} paint
 * @property {Said} name
 */

/** @typedef {"kerf" | "trim-1" | "trim-2" | "trim-3" | "trim-4"} PassPaint */

/**
 * @typedef {object} Finding
 * @property {string} code
 * @property {"error" | "warning" | "note"} severity
 * @property {number | null} line
 * @property {number | null} block
 * @property {string} block_name as the listing has it; empty where no block is meant
 * @property {number | null} row
 * @property {number | null} t_s
 * @property {number[] | null} place_um
 * @property {{ en: FindingTexts, zh: FindingTexts }} texts
 */

/**
 * @typedef {object} FindingTexts
 * @property {string} title
 * @property {string} found
 * @property {string} expected
 * @property {string} machine
 * @property {string} hint
 * @property {string} message
 */

/**
 * @typedef {object} Loss
 * @property {string} kind
 * @property {Axis} axis
 * @property {number} row
 * @property {number} t_s
 * @property {number} amount_um
 * @property {Place} place_um
 */

/**
 * @typedef {object} Ending
 * @property {string} cause
 * @property {Axis} axis
 * @property {number} row
 * @property {number} t_s
 * @property {Place} place_um
 */

/**
 * @typedef {object} Piece
 * @property {string} kind
 * @property {number} row
 * @property {number} t_s
 * @property {number} area_mm2
 * @property {number} mass_g
 * @property {Place} center_um
 * @property {Place[]} outline_um
 * @property {Place[][]} holes_um
 */

/**
 * @typedef {object} Question
 * @property {number} row
 * @property {number} block
 * @property {string} name of the block
 * @property {string | null} about
 * @property {Said} ask
 * @property {Said[]} answers
 * @property {number} right
 * @property {Said} why
 * @property {[number, number][]} hidden first character from the beginning of the block, and one past the last, of what tells the answer
 */

/**
 * Steps and samples; texts are packed columns (sim/show/replay/tape.py).
 * @typedef {object} Tape
 * @property {number} tick_s
 * @property {number} grain_um
 * @property {Place} origin_um
 * @property {number} steps
 * @property {string} moves
 * @property {string} step_ticks
 * @property {number} samples
 * @property {string} sample_ticks
 * @property {string} table_x
 * @property {string} table_y
 * @property {string | null} wire_x
 * @property {string | null} wire_y
 * @property {string} foot_row
 */

/** @typedef {Finding & { t_s: number }} TimedFinding */

/**
 * Whether a finding has a time in the run.
 * @param {Finding} finding
 * @returns {finding is TimedFinding}
 */
export function isTimed(finding) {
  return finding.t_s !== null;
}
