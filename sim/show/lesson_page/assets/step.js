// One task on the page: its attempts, what each of them earned, and what comes next.
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { blockTask } from "./block_task.js";
import { faultTask } from "./fault_task.js";
import { numberTask } from "./number_task.js";
import { MOST_TRIES } from "./plain_answers.js";
import { programTask } from "./program_task.js";

/** @import { Exercise } from "./data.js" */
/** @import { Sitting } from "./sitting.js" */

/**
 * What a task is made of.
 * @typedef {object} Step
 * @property {HTMLElement} form
 * @property {Exercise} exercise
 * @property {Exercise["rules"]} rules
 * @property {number} seed of the exercise
 * @property {number} number of the task, from 0
 */

const TASKS = { block: blockTask, program: programTask, fault: faultTask, predict: numberTask };

/**
 * A task in its form.
 * @param {HTMLElement} form
 * @param {Exercise} exercise
 * @param {Sitting} sitting
 * @param {() => void} onDone
 */
export function stepIn(form, exercise, sitting, onDone) {
  const at = Number(form.dataset.exercise);
  const number = Number(form.dataset.task);
  const { rules } = exercise;
  const task = TASKS[/** @type {keyof TASKS} */ (rules.kind)]({ form, exercise, rules, seed: sitting.seedOf(at), number });
  const verdict = element("p.said", HTMLElement, form);
  const check = element(".check", HTMLButtonElement, form);
  const next = element(".next", HTMLButtonElement, form);
  const pass = element(".pass", HTMLButtonElement, form);
  const attempts = sitting.answers[at][number];
  let isEmpty = false;

  const share = () => sitting.share(at, number);
  const isRight = () => attempts.length > 0 && share() * attempts.length > 0.999;
  const isClosed = () => isRight() || attempts.length >= MOST_TRIES;

  /** What the attempts came to, in words. */
  function told() {
    if (isEmpty) return language.say("nothing");
    if (!attempts.length) return "";
    if (isRight()) return language.say(attempts.length > 1 ? "right_second" : "right");
    const percent = Math.round(100 * share());
    if (isClosed()) return percent ? language.say("done_partly", { percent }) : language.say("done_wrong");
    return percent ? language.say("partly", { percent }) : language.say("wrong");
  }

  /** Write all in the language of the page. */
  function write() {
    task.write();
    if (attempts.length) task.reveal(attempts[attempts.length - 1], isClosed(), isRight());
    verdict.textContent = told();
    verdict.className = `said ${isRight() ? "right" : attempts.length || isEmpty ? "wrong" : ""}`;
  }

  /** Take what was answered. */
  function weigh() {
    const answer = task.answer();
    isEmpty = !answer;
    if (answer) attempts.push(answer);
    if (isClosed()) {
      task.close();
      check.hidden = true;
      pass.hidden = true;
      next.hidden = false;
      next.focus();
    }
    write();
  }

  form.addEventListener("submit", () => (isClosed() ? onDone() : weigh()));
  next.addEventListener("click", onDone);
  pass.addEventListener("click", onDone);
  language.onChange(write);
  write();

  return {
    exercise: at,
    /**
     * Show it, or hide it on the screen.
     * @param {boolean} isShown
     */
    show(isShown) {
      form.classList.toggle("aside-now", !isShown);
      if (!isShown) return;
      window.scrollTo(0, 0);
      element("h2", HTMLElement, form).focus();
    },
  };
}
