// Which programs are to be seen, and in which order.

/** @import { Listed, Verdict } from "./data.js" */

/** @typedef {"file" | "verdict" | "findings" | "time_s" | "worst_um" | "cut_um"} Column */

/**
 * What is asked for; an empty text asks for nothing.
 * @typedef {object} Asked
 * @property {string} text words that must all occur
 * @property {Verdict | ""} verdict
 * @property {string} code
 */

/** @type {Record<Verdict, number>} */
const WORST = { pass: 0, "to-check": 1, incomplete: 2, refused: 3, fault: 4, fail: 5 };
const WEIGHT = { error: 1e8, warning: 1e4, note: 1 };

/**
 * What of a program is searched.
 * @param {Listed & { title_zh?: string | null }} program
 */
export function searched(program) {
  const codes = program.findings.map((found) => found.code);
  const titles = [program.title, program.title_zh ?? ""];
  return [program.file, ...titles, ...Object.values(program.message ?? {}), ...codes].join("\n").toLowerCase();
}

/**
 * Numbers of the programs that fit, rising.
 * @param {Listed[]} programs
 * @param {string[]} texts what of each is searched
 * @param {Asked} asked
 */
export function fitting(programs, texts, asked) {
  const words = asked.text.toLowerCase().split(/\s+/).filter(Boolean);
  return [...programs.keys()].filter((at) => {
    const { verdict, findings } = programs[at];
    if (asked.verdict && verdict !== asked.verdict) return false;
    if (asked.code && !findings.some((found) => found.code === asked.code)) return false;
    return words.every((word) => texts[at].includes(word));
  });
}

/**
 * What a column sorts a program by; null stands last.
 * @param {Listed} program
 * @param {Column} column
 */
function key(program, column) {
  if (column === "verdict") return WORST[program.verdict];
  if (column === "findings") return program.findings.reduce((sum, found) => sum + WEIGHT[found.severity] * found.count, 0);
  return /** @type {Record<string, string | number | null>} */ (/** @type {unknown} */ (program))[column];
}

/**
 * Numbers of programs in the order of a column, `way` 1 rising or -1 falling; equal ones as they stand in the index.
 * @param {Listed[]} programs
 * @param {number[]} rows
 * @param {Column} column
 * @param {number} way
 */
export function sorted(programs, rows, column, way) {
  const keys = new Map(rows.map((row) => [row, key(programs[row], column)]));
  return [...rows].sort((a, b) => {
    const [one, other] = [keys.get(a) ?? null, keys.get(b) ?? null];
    if (one === null || other === null) return Number(one === null) - Number(other === null) || a - b;
    return (one < other ? -way : one > other ? way : 0) || a - b;
  });
}
