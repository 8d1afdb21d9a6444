// What the page hands over to its script.
import { element } from "../../html/assets/elements.js";

/** @import { Said } from "../../html/assets/language.js" */
/** @import { Rules } from "./plain_rules.js" */

/** Written by `make pages` from the model in Python. */

/**
 * A lesson: its digest, by which a hand-in names it, whether numbers are a pupil's own, and its exercises.
 * @typedef {object} Lesson
 * @property {string} lesson
 * @property {Said} title
 * @property {string} numbers
 * @property {number} seed
 * @property {Exercise[]} exercises
 */

/**
 * An exercise: what it is called, its points, and how it is marked. `program` and `feed_mm_min` are what it asks
 * about, `offset_um` and `is_inside` what it wants of a program.
 * @typedef {object} Exercise
 * @property {Said} title
 * @property {number} points
 * @property {Rules} rules
 * @property {string} program
 * @property {number} feed_mm_min
 * @property {number} offset_um
 * @property {boolean} is_inside
 */

/**
 * What a pupil hands in, ``NAME.drycut.json``, as the page of a lesson writes it.
 * @typedef {object} HandInDocument
 * @property {"drycut.hand-in/1"} schema
 * @property {string} lesson
 * @property {string} name
 * @property {string} group
 * @property {number} seed
 * @property {string[][][]} answers
 * @property {number[]} points
 * @property {number[]} seconds
 */

/** Up to here. */

/**
 * The lesson.
 * @returns {Lesson}
 */
export function readLesson() {
  return JSON.parse(element("#lesson", HTMLElement).textContent);
}
