// Parts of a line of the program that are covered, as they would answer what the quiz asks.

/** @import { Blocks } from "./document.js" */

const COVER = "\u2592"; // a shaded square

/** @typedef {{ line: number, spans: [number, number][] }} Cover */

/**
 * What is covered in the line of a block; spans count from the block's first character.
 * @param {Blocks} blocks
 * @param {number} row
 * @param {[number, number][]} spans
 * @returns {Cover}
 */
export function coverOf(blocks, row, spans) {
  const from = blocks.character[row];
  return { line: blocks.line[row], spans: spans.map(([first, past]) => [from + first, from + past]) };
}

/**
 * A text with its spans covered.
 * @param {string} text
 * @param {[number, number][]} spans
 */
export function covered(text, spans) {
  return spans.reduce((left, [first, past]) => {
    const end = Math.min(past, left.length);
    return left.slice(0, first) + COVER.repeat(Math.max(end - first, 0)) + left.slice(end);
  }, text);
}
