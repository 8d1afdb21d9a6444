// The document that Python hands over to the page (sim/show/replay/document.py): its JSON, by name and type.
// Rows of blocks count from 0, steps from 1; places and lengths are µm of the program.

/** @import { Said } from "../../html/assets/language.js" */

/** @typedef {[x: number, y: number]} Place */
/** @typedef {Blocks["kind"][number]} Kind */
/** @typedef {Loss["axis"]} Axis */
/** @typedef {Pass["paint"]} PassPaint */

/** Written by `make pages` from the model in Python. */

/**
 * A recorded run; rows of blocks count from 0, steps from 1; places and lengths are µm of the program.
 * @typedef {object} ReplayDocument
 * @property {"drycut.replay/1"} schema
 * @property {string} drycut
 * @property {string} title
 * @property {string} provenance
 * @property {"pass" | "to-check" | "fail"} verdict
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
 * @property {Curves | null} drawing that the cut was held against, as it lies on the part
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
 * @property {Quiz} quiz
 * @property {Tape} tape
 */

/**
 * The program's text, line by line.
 * @typedef {object} Program
 * @property {string} name
 * @property {string} dialect
 * @property {boolean} is_worded whether the steps are counted by words of the program, not by the controller's own
 * @property {string[]} lines
 */

/**
 * A clamp, seen from above.
 * @typedef {object} Clamp
 * @property {string} name
 * @property {Place[]} outline_um
 */

/**
 * Columns of n curves, each from the end of the one before it; `place_*` have n + 1. What only an arc has is null
 * elsewhere, where nothing asks for it.
 * @typedef {object} Curves
 * @property {("line" | "arc" | "jump")[]} kind
 * @property {number[]} place_x_um
 * @property {number[]} place_y_um
 * @property {number[]} center_x_um of an arc
 * @property {number[]} center_y_um of an arc
 * @property {number[]} radius_um of an arc
 * @property {number[]} start_angle_rad of an arc
 * @property {number[]} sweep_rad of an arc
 * @property {number[]} length_um
 */

/**
 * Columns of n blocks, as of curves; `first_step` and `border_s` have n + 1.
 * @typedef {object} Blocks
 * @property {("line" | "arc" | "jump")[]} kind
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
 * @property {("X" | "Y")[]} count_axis
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
 * @property {number[] | null} reach_um half the width of the kerf, where a technology has it by pass
 */

/**
 * How the blocks are decoded; `of_row` has for each row of the blocks the index of its decoded block, or −1.
 * @typedef {object} Decoding
 * @property {number[]} of_row
 * @property {DecodedBlock[]} blocks
 */

/**
 * A block, word by word, the buffer that it leaves, and its way.
 * @typedef {object} DecodedBlock
 * @property {string} text
 * @property {DecodeStep[]} steps
 * @property {string} buffer
 * @property {NamedText[]} ways
 */

/**
 * A word decoded, and the field that it sets.
 * @typedef {object} DecodeStep
 * @property {string} order
 * @property {Said} word
 * @property {string} field
 * @property {Said} value
 */

/**
 * A text with the name of what it tells.
 * @typedef {object} NamedText
 * @property {Said} name
 * @property {Said} text
 */

/**
 * Columns of p phases; `t_s` has p + 1.
 * @typedef {object} Plan
 * @property {number[]} t_s
 * @property {number[]} speed_um_s
 * @property {number[]} acceleration_um_s2
 * @property {number[] | null} jerk_um_s3
 */

/**
 * A pause or the end.
 * @typedef {object} Stop
 * @property {string} kind
 * @property {number} after so many blocks
 * @property {number} line
 */

/**
 * A contour by the rows of its first and last blocks.
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
 * @property {"kerf" | "trim-1" | "trim-2" | "trim-3" | "trim-4"} paint
 * @property {Said} name
 */

/**
 * A finding; row, time and place are null where it has none.
 * @typedef {object} Finding
 * @property {string} code
 * @property {"error" | "warning" | "note"} severity
 * @property {number | null} line
 * @property {number | null} block
 * @property {string} block_name as the listing has it; empty where no block is meant
 * @property {number | null} row
 * @property {number | null} t_s
 * @property {Place | null} place_um
 * @property {BothTexts} texts
 */

/**
 * Texts of a finding in both languages.
 * @typedef {object} BothTexts
 * @property {FindingTexts} en
 * @property {FindingTexts} zh
 */

/**
 * What is said of a finding in one language.
 * @typedef {object} FindingTexts
 * @property {string} title
 * @property {string} found
 * @property {string} expected
 * @property {string} machine
 * @property {string} hint
 * @property {string} message
 */

/**
 * Steps that a stepper lost, or where a servo tripped.
 * @typedef {object} Loss
 * @property {string} kind
 * @property {"X" | "Y"} axis
 * @property {number} row
 * @property {number} t_s
 * @property {number} amount_um
 * @property {Place} place_um
 */

/**
 * Where the machine stopped before its program was through, and why.
 * @typedef {object} Ending
 * @property {string} cause
 * @property {"X" | "Y"} axis
 * @property {number} row
 * @property {number} t_s
 * @property {Place} place_um
 */

/**
 * A piece that comes free.
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
 * Questions of the scenario, those of any program, and which of these make a set.
 * @typedef {object} Quiz
 * @property {Question[]} own
 * @property {Question[]} pool
 * @property {number[][]} sets
 */

/**
 * A question about a block.
 * @typedef {object} Question
 * @property {number} row
 * @property {number} block
 * @property {string} name of the block
 * @property {string | null} about
 * @property {Said} ask
 * @property {Said[]} answers
 * @property {number} right
 * @property {Said} why
 * @property {[number, number][]} hidden where in the text of the block its answer stands: first character, one past the last
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

/** Up to here. */

/** @typedef {Finding & { t_s: number }} TimedFinding */

/**
 * Whether a finding has a time in the run.
 * @param {Finding} finding
 * @returns {finding is TimedFinding}
 */
export function isTimed(finding) {
  return finding.t_s !== null;
}
