// Written by `make pages` from sim/teach/plain/blocks.py.

export const MOST_DIGITS = 8;

export const MOST_CHARACTERS = 200000;

const _DIGITS = "0123456789";

const _BLANKS = " \t";

const _REMARKS = ";/(*";

const _HEADERS = ["CAXA", "CONNER", "CORNER", "OFFSET", "LENGTH", "START"];

/**
 * A block in its words.
 * @typedef {object} Block
 * @property {number} x
 * @property {number} y
 * @property {number} count_um
 * @property {number} axis
 * @property {number} turn
 * @property {number} quadrant
 * @property {number} line
 */

/**
 * @param {number} x
 * @param {number} y
 * @param {number} count_um
 * @param {number} axis
 * @param {number} turn
 * @param {number} quadrant
 * @param {number} line
 * @returns {Block}
 */
export function Block(x, y, count_um, axis, turn, quadrant, line) {
  return { x, y, count_um, axis, turn, quadrant, line };
}

/**
 * A pause ``D`` or the end ``DD``, behind so many blocks, and the line where it stands, from 1.
 * @typedef {object} Mark
 * @property {boolean} is_end
 * @property {number} after
 * @property {number} line
 */

/**
 * @param {boolean} is_end
 * @param {number} after
 * @param {number} line
 * @returns {Mark}
 */
export function Mark(is_end, after, line) {
  return { is_end, after, line };
}

/**
 * A place in a text: line and column, from 1.
 * @typedef {object} Place
 * @property {number} line
 * @property {number} column
 */

/**
 * @param {number} line
 * @param {number} column
 * @returns {Place}
 */
export function Place(line, column) {
  return { line, column };
}

/**
 * A text that was read.
 * @typedef {object} Listing
 * @property {Block[]} blocks
 * @property {Mark[]} marks
 * @property {Place[]} unread
 * @property {number} behind_end
 */

/**
 * @param {Block[]} blocks
 * @param {Mark[]} marks
 * @param {Place[]} unread
 * @param {number} behind_end
 * @returns {Listing}
 */
export function Listing(blocks, marks, unread, behind_end) {
  return { blocks, marks, unread, behind_end };
}

/**
 * What stands at a place of a line: a number, or a letter's meaning; `past` is where it ends, −1 if nothing.
 * @typedef {object} _Word
 * @property {number} value
 * @property {number} past
 */

/**
 * @param {number} value
 * @param {number} past
 * @returns {_Word}
 */
function _Word(value, past) {
  return { value, past };
}

const _NOTHING = _Word(0, -1);

/**
 * The blocks and marks of a text. What is longer than `MOST_CHARACTERS` is unread from its first line on.
 * @param {string} text
 * @returns {Listing}
 */
export function read_listing(text) {
  const listing = Listing([], [], [], 0);
  if (text.length > MOST_CHARACTERS) {
    return Listing([], [], [Place(1, 1)], 0);
  }
  let behind = 0;
  const lines = folded(text).split("\n");
  for (let number = 0; number < lines.length; number += 1) {
    if ((listing.marks.length > 0) && listing.marks[listing.marks.length - 1].is_end) {
      behind += _is_remark(lines[number]) ? 0 : 1;
    } else {
      _read_line(lines[number], number + 1, listing);
    }
  }
  return Listing(listing.blocks, listing.marks, listing.unread, behind);
}

/**
 * A text in capitals and half-width characters, its lines ended by a line feed, each as long as before.
 * @param {string} text
 * @returns {string}
 */
export function folded(text) {
  const narrow = [];
  for (const character of text.replaceAll("\r\n", "\n").replaceAll("\r", "\n")) {
    const code = (/** @type {number} */ (character.codePointAt(0)));
    if (65281 <= code && code <= 65374) {
      narrow.push(String.fromCodePoint(code - 65248));
    } else if ([12288, 160].includes(code)) {
      narrow.push(" ");
    } else {
      narrow.push(character);
    }
  }
  return _capitals(narrow.join(""));
}

/**
 * ASCII letters as capitals; others stay, for some become two.
 * @param {string} text
 * @returns {string}
 */
function _capitals(text) {
  const capitals = [];
  for (const character of text) {
    const is_small = "a" <= character && character <= "z";
    capitals.push(is_small ? String.fromCodePoint((/** @type {number} */ (character.codePointAt(0))) - 32) : character);
  }
  return capitals.join("");
}

/**
 * Whether a line is blank, a remark or a header.
 * @param {string} line
 * @returns {boolean}
 */
function _is_remark(line) {
  const at = _past_blanks(line, 0);
  return (at === line.length) || (_REMARKS.includes(line[at])) || _begins_header(line, at);
}

/**
 * @param {string} line
 * @param {number} at
 * @returns {boolean}
 */
function _begins_header(line, at) {
  return _HEADERS.some((header) => line.slice(at, at + header.length) === header);
}

/**
 * Read a line, folded, into a listing, up to the first place that cannot be read, or the end of the program.
 * @param {string} line
 * @param {number} number
 * @param {Listing} listing
 * @returns {void}
 */
function _read_line(line, number, listing) {
  let at = _past_blanks(line, 0);
  while (at < line.length) {
    if ((";/*".includes(line[at])) || _begins_header(line, at)) {
      return;
    }
    let past;
    if (line[at] === "(") {
      const closing = line.indexOf(")", at);
      past = (closing < 0) ? line.length : (closing + 1);
    } else {
      past = _read_word(line, at, number, listing);
    }
    if (past < 0) {
      listing.unread.push(Place(number, at + 1));
      return;
    }
    if ((listing.marks.length > 0) && listing.marks[listing.marks.length - 1].is_end) {
      return;
    }
    at = _past_blanks(line, past);
  }
}

/**
 * Read a block or a mark, with its label, into a listing; where it ends, −1 where none stands there.
 * @param {string} line
 * @param {number} at
 * @param {number} number
 * @param {Listing} listing
 * @returns {number}
 */
function _read_word(line, at, number, listing) {
  const begin = _past_label(line, at);
  const past = _read_block(line, begin, number, listing);
  return (past >= 0) ? past : _read_mark(line, begin, number, listing);
}

/**
 * @param {string} line
 * @param {number} at
 * @returns {number}
 */
function _past_blanks(line, at) {
  let past = at;
  while ((past < line.length) && (_BLANKS.includes(line[past]))) {
    past += 1;
  }
  return past;
}

/**
 * @param {string} line
 * @param {number} at
 * @returns {number}
 */
function _past_digits(line, at) {
  let past = at;
  while ((past < line.length) && (_DIGITS.includes(line[past]))) {
    past += 1;
  }
  return past;
}

/**
 * Where a label as ``N7:``, ``N7``, ``7:`` or ``7`` ends, and the blanks behind it; `at` where there is none.
 * @param {string} line
 * @param {number} at
 * @returns {number}
 */
function _past_label(line, at) {
  const has_letter = line[at] === "N";
  const first = has_letter ? _past_blanks(line, at + 1) : at;
  let past = _past_digits(line, first);
  if (past === first) {
    return at;
  }
  past = _past_blanks(line, past);
  if ((past < line.length) && (line[past] === ":")) {
    past = _past_blanks(line, past + 1);
  }
  return past;
}

/**
 * The number behind a letter B, 0 where no digit stands there.
 * @param {string} line
 * @param {number} at
 * @returns {_Word}
 */
function _number(line, at) {
  if ((at >= line.length) || (line[at] !== "B")) {
    return _NOTHING;
  }
  const first = _past_blanks(line, at + 1);
  const past = _past_digits(line, first);
  let start = first;
  while ((start < (past - 1)) && (line[start] === "0")) {
    start += 1;
  }
  if ((past - start) > MOST_DIGITS) {
    return _NOTHING;
  }
  return _Word((past > start) ? Math.trunc(Number(line.slice(start, past))) : 0, _past_blanks(line, past));
}

/**
 * Read a block into a listing; where it ends, −1 where none stands there.
 * @param {string} line
 * @param {number} at
 * @param {number} number
 * @param {Listing} listing
 * @returns {number}
 */
function _read_block(line, at, number, listing) {
  const x = _number(line, at);
  const y = (x.past >= 0) ? _number(line, x.past) : _NOTHING;
  const count = (y.past >= 0) ? _number(line, y.past) : _NOTHING;
  const axis = (count.past >= 0) ? _axis(line, count.past) : _NOTHING;
  const turn = (axis.past >= 0) ? _turn(line, axis.past) : _NOTHING;
  if ((turn.past < 0) || (turn.past >= line.length) || (!"1234".includes(line[turn.past]))) {
    return -1;
  }
  const past = turn.past + 1;
  if ((past < line.length) && (_DIGITS.includes(line[past]))) {
    return -1;
  }
  const quadrant = Math.trunc(Number(line[turn.past]));
  listing.blocks.push(Block(x.value, y.value, count.value, axis.value, turn.value, quadrant, number));
  return past;
}

/**
 * ``GX`` as 0, ``GY`` as 1.
 * @param {string} line
 * @param {number} at
 * @returns {_Word}
 */
function _axis(line, at) {
  if ((at >= line.length) || (line[at] !== "G")) {
    return _NOTHING;
  }
  const letter = _past_blanks(line, at + 1);
  if ((letter >= line.length) || (!"XY".includes(line[letter]))) {
    return _NOTHING;
  }
  return _Word((line[letter] === "X") ? 0 : 1, _past_blanks(line, letter + 1));
}

/**
 * ``L`` as 0, ``NR`` as 1, ``SR`` as −1.
 * @param {string} line
 * @param {number} at
 * @returns {_Word}
 */
function _turn(line, at) {
  if (at >= line.length) {
    return _NOTHING;
  }
  if (line[at] === "L") {
    return _Word(0, _past_blanks(line, at + 1));
  }
  if (!"NS".includes(line[at])) {
    return _NOTHING;
  }
  const letter = _past_blanks(line, at + 1);
  if ((letter >= line.length) || (line[letter] !== "R")) {
    return _NOTHING;
  }
  return _Word((line[at] === "N") ? 1 : (-1), _past_blanks(line, letter + 1));
}

/**
 * Read ``D`` or ``DD`` into a listing; where it ends, −1 where none stands there.
 * @param {string} line
 * @param {number} at
 * @param {number} number
 * @param {Listing} listing
 * @returns {number}
 */
function _read_mark(line, at, number, listing) {
  let past = at;
  while ((past < line.length) && (line[past] === "D")) {
    past += 1;
  }
  const is_word = (past === line.length) || (" \t;/(B".includes(line[past]));
  if (!((1 <= (past - at) && (past - at) <= 2) && is_word)) {
    return -1;
  }
  listing.marks.push(Mark((past - at) === 2, listing.blocks.length, number));
  return past;
}
