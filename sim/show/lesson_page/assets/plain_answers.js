// Written by `make pages` from sim/teach/plain/answers.py.
import { folded } from "./plain_blocks.js";
import { words_mark } from "./plain_marks.js";
import { program_mark, program_share, written_of } from "./plain_program.js";
import { after_steps, next_way } from "./plain_stepping.js";
import { chosen, next_seed, task_of } from "./plain_tasks.js";
/** @import { Target } from "./plain_program.js" */
/** @import { Stepper, Way } from "./plain_stepping.js" */
/** @import { Task } from "./plain_tasks.js" */

export const MOST_TRIES = 2;

export const WAYS = ["+X", "-X", "+Y", "-Y"];

const _MOST_STEPS = 12;

/**
 * What is asked for in numbers: those that are right, and how far each may be off.
 * @typedef {object} Question
 * @property {number[]} right
 * @property {number} within
 */

/**
 * @param {number[]} right
 * @param {number} within
 * @returns {Question}
 */
export function Question(right, within) {
  return { right, within };
}

/**
 * A block that stands after some steps, and which of `WAYS` comes next, from 0.
 * @typedef {object} StepQuestion
 * @property {Task} task
 * @property {number} steps
 * @property {Stepper} stepper
 * @property {number} right
 */

/**
 * @param {Task} task
 * @param {number} steps
 * @param {Stepper} stepper
 * @param {number} right
 * @returns {StepQuestion}
 */
export function StepQuestion(task, steps, stepper, right) {
  return { task, steps, stepper, right };
}

/**
 * The shape of a task, numbered from 0: the shapes take turns.
 * @param {string[]} shapes
 * @param {number} task
 * @returns {string}
 */
export function shape_at(shapes, task) {
  return shapes[task % shapes.length];
}

/**
 * A question for the next step, by a seed.
 * @param {string} shape
 * @param {number} seed
 * @returns {StepQuestion}
 */
export function step_question(shape, seed) {
  const task = task_of(shape, seed);
  const steps = chosen(next_seed(next_seed(seed)), 1, _MOST_STEPS);
  const stepper = after_steps(task.block, steps);
  const way = next_way(task.block, stepper);
  return StepQuestion(task, steps, stepper, way_number(way));
}

/**
 * Which of `WAYS` a step is, from 0.
 * @param {Way} way
 * @returns {number}
 */
export function way_number(way) {
  if (way.x !== 0) {
    return (way.x > 0) ? 0 : 1;
  }
  return (way.y > 0) ? 2 : 3;
}

/**
 * Where the block of a task ends, in mm, to 2 µm.
 * @param {Task} task
 * @returns {Question}
 */
export function end_question(task) {
  return Question([task.end.x / 1000.0, task.end.y / 1000.0], 0.0020001);
}

/**
 * The share that attempts earn: the best of the first one and half of the second one.
 * @param {number[]} shares
 * @returns {number}
 */
export function share_of(shares) {
  let best = 0.0;
  for (let number = 0; number < Math.min(MOST_TRIES, shares.length); number += 1) {
    best = Math.max(best, shares[number] / (number + 1));
  }
  return best;
}

/**
 * Share of a block that was to be written.
 * @param {Task} task
 * @param {string[]} attempts
 * @returns {number}
 */
export function block_share(task, attempts) {
  return share_of(attempts.map((text) => words_mark(task, text).share));
}

/**
 * Share of a program in 3B that was to be written.
 * @param {Target} target
 * @param {number[]} weights
 * @param {string[]} attempts
 * @returns {number}
 */
export function program_attempts_share(target, weights, attempts) {
  const shares = attempts.map((text) => program_share(program_mark(target, written_of(text, target.thread)), weights));
  return share_of(shares);
}

/**
 * Share of a fault that was to be found; an attempt is its line and what is wrong, as ``12 axis``.
 * @param {number[]} lines
 * @param {string} group
 * @param {string[]} attempts
 * @returns {number}
 */
export function fault_share(lines, group, attempts) {
  /** @type {number[]} */
  const shares = [];
  for (const attempt of attempts) {
    const words = attempt.split(" ");
    const numbers = numbers_of(words[0]);
    const is_line = (numbers.length === 1) && (lines.includes(numbers[0]));
    const is_group = (words.length === 2) && (words[1] === group);
    shares.push((is_line ? 0.5 : 0.0) + (is_group ? 0.5 : 0.0));
  }
  return share_of(shares);
}

/**
 * Share of a question in numbers: all or nothing.
 * @param {Question} question
 * @param {string[]} attempts
 * @returns {number}
 */
export function question_share(question, attempts) {
  /** @type {number[]} */
  const shares = [];
  for (const attempt of attempts) {
    const numbers = numbers_of(attempt);
    let wrong = 0;
    for (let number = 0; number < Math.min(numbers.length, question.right.length); number += 1) {
      wrong += (Math.abs(numbers[number] - question.right[number]) <= question.within) ? 0 : 1;
    }
    shares.push(((wrong === 0) && (numbers.length === question.right.length)) ? 1.0 : 0.0);
  }
  return share_of(shares);
}

/**
 * Numbers of a text with blanks, commas or semicolons between them; none where one of them cannot be read.
 * @param {string} text
 * @returns {number[]}
 */
export function numbers_of(text) {
  /** @type {number[]} */
  const numbers = [];
  for (const word of folded(text).replaceAll(",", " ").replaceAll(";", " ").split(" ")) {
    if (word.length > 0) {
      if (!_is_number(word)) {
        return [];
      }
      numbers.push(Number(word));
    }
  }
  return numbers;
}

/**
 * Whether a word is digits with at most one point between them, and a sign before them.
 * @param {string} word
 * @returns {boolean}
 */
function _is_number(word) {
  const start = ("+-".includes(word[0])) ? 1 : 0;
  let points = 0;
  let digits = 0;
  for (let number = start; number < word.length; number += 1) {
    points += (word[number] === ".") ? 1 : 0;
    digits += ("0" <= word[number] && word[number] <= "9") ? 1 : 0;
  }
  return (0 < digits && digits <= 15) && (points <= 1) && (((digits + points) + start) === word.length);
}
