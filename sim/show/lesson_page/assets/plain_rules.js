// Written by `make pages` from sim/teach/plain/rules.py.
import { Question, block_share, end_question, fault_share, program_attempts_share, question_share, shape_at, step_question } from "./plain_answers.js";
import { seed_of_task, task_of } from "./plain_tasks.js";
/** @import { Target } from "./plain_program.js" */

/**
 * Lines of a damaged program that are right answers, from 1, and what is wrong.
 * @typedef {object} FaultRule
 * @property {number[]} lines
 * @property {string} group
 */

/**
 * @param {number[]} lines
 * @param {string} group
 * @returns {FaultRule}
 */
export function FaultRule(lines, group) {
  return { lines, group };
}

/**
 * How an exercise is marked.
 * @typedef {object} Rules
 * @property {string} kind
 * @property {string} ask
 * @property {string[]} shapes
 * @property {number} tasks
 * @property {Target} target
 * @property {number[]} weights
 * @property {FaultRule[]} faults
 * @property {Question} question
 */

/**
 * @param {string} kind
 * @param {string} ask
 * @param {string[]} shapes
 * @param {number} tasks
 * @param {Target} target
 * @param {number[]} weights
 * @param {FaultRule[]} faults
 * @param {Question} question
 * @returns {Rules}
 */
export function Rules(kind, ask, shapes, tasks, target, weights, faults, question) {
  return { kind, ask, shapes, tasks, target, weights, faults, question };
}

/**
 * Share of a task, numbered from 0, that attempts earn; `seed` is that of the exercise in a sitting.
 * @param {Rules} rules
 * @param {number} seed
 * @param {number} task
 * @param {string[]} attempts
 * @returns {number}
 */
export function task_share(rules, seed, task, attempts) {
  if (rules.kind === "program") {
    return program_attempts_share(rules.target, rules.weights, attempts);
  }
  if (rules.kind === "fault") {
    return fault_share(rules.faults[task].lines, rules.faults[task].group, attempts);
  }
  if ((rules.kind === "predict") && (!["end", "next-step"].includes(rules.ask))) {
    return question_share(rules.question, attempts);
  }
  const shape = shape_at(rules.shapes, task);
  const own_seed = seed_of_task(seed, task);
  if (rules.kind === "block") {
    return block_share(task_of(shape, own_seed), attempts);
  }
  if (rules.ask === "end") {
    return question_share(end_question(task_of(shape, own_seed)), attempts);
  }
  return question_share(Question([step_question(shape, own_seed).right], 0.0), attempts);
}
