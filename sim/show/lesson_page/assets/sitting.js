// A sitting: who answers, by which numbers, all attempts, and how long each exercise took.
import { task_share } from "./plain_rules.js";
import { seed_of, seed_of_task } from "./plain_tasks.js";

/** @import { HandInDocument, Lesson } from "./data.js" */

/** @typedef {ReturnType<typeof newSitting>} Sitting */

/**
 * A sitting that begins.
 * @param {Lesson} lesson
 * @param {string} name who answers
 * @param {string} group the class
 */
export function newSitting(lesson, name, group) {
  const own = lesson.numbers === "own" ? `${lesson.seed} ${name} ${group}` : `${lesson.seed}`;
  const seed = seed_of(own);
  /** @type {string[][][]} */
  const answers = lesson.exercises.map(({ rules }) => Array.from({ length: rules.tasks }, () => []));
  const seconds = lesson.exercises.map(() => 0);

  /**
   * The seed of an exercise.
   * @param {number} exercise
   */
  const seedOf = (exercise) => seed_of_task(seed, exercise);

  /**
   * Share of a task that was earned so far.
   * @param {number} exercise
   * @param {number} task
   */
  function share(exercise, task) {
    return task_share(lesson.exercises[exercise].rules, seedOf(exercise), task, answers[exercise][task]);
  }

  /**
   * Points of an exercise.
   * @param {number} exercise
   */
  function points(exercise) {
    const { rules, points: most } = lesson.exercises[exercise];
    const shares = answers[exercise].map((_, task) => share(exercise, task));
    return most * shares.reduce((sum, each) => sum + each, 0) / rules.tasks;
  }

  return {
    name, group, seed, answers, seconds, seedOf, share, points,
    /** @returns {HandInDocument} */
    handIn: () => ({
      schema: "drycut.hand-in/1", lesson: lesson.lesson, name, group, seed, answers,
      points: lesson.exercises.map((_, exercise) => points(exercise)),
      seconds: seconds.map((each) => Math.round(each)),
    }),
  };
}
