// Quiz: before some blocks the replay stops and asks; the answer is weighed, and the replay goes on and shows it.
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { pick } from "./words.js";

/**
 * @import { Said } from "../../html/assets/language.js"
 * @import { Question, ReplayDocument } from "./document.js"
 * @import { Player } from "./player.js"
 */

/** @typedef {Record<"panel" | "count" | "ask" | "answers" | "said" | "go", HTMLElement>} Boxes */
/** @typedef {{ right: number, all: number }} Score */
/** @typedef {ReturnType<typeof quizIn>} Quiz */

/**
 * Quiz in boxes of the page, over a player.
 * @param {Boxes} boxes
 * @param {ReplayDocument} doc
 * @param {Player} player
 */
export function quizIn({ panel, count, ask, answers, said, go }, doc, player) {
  const { border_s: border } = doc.blocks;
  /** @type {Map<Question, boolean>} */
  const given = new Map(); // question to whether its answer was right
  let isOn = false;
  /** @type {Question | null} */
  let open = null;
  /** @type {number | null} */
  let chosen = null;
  /** @type {Score | null} */
  let score = null; // of a quiz that is done

  /** How many were right. */
  const right = () => [...given.values()].filter(Boolean).length;

  /** Write what is open, in the language of the page: a question and what came of its answer, or the score. */
  function write() {
    if (open) writeQuestion(open);
    else if (score) writeScore(score);
  }

  /**
   * Write a question.
   * @param {Question} question
   */
  function writeQuestion(question) {
    const number = doc.quiz.indexOf(question) + 1;
    count.textContent = pick(`Question ${number} of ${doc.quiz.length}`, `第 ${number} 题，共 ${doc.quiz.length} 题`);
    ask.textContent = language.pick(question.ask);
    answers.replaceChildren(...question.answers.map((answer, at) => answerButton(question, answer, at)));
    said.textContent = chosen === null ? "" : verdict(question);
    said.className = chosen === null ? "" : chosen === question.right ? "right" : "wrong";
    go.hidden = chosen === null;
  }

  /**
   * Whether the answer was right, and why.
   * @param {Question} question
   */
  function verdict(question) {
    const first = chosen === question.right ? pick("Right.", "正确。") : pick("No; the right answer is marked.", "不对，正确答案已标出。");
    return [first, language.pick(question.why)].filter(Boolean).join(" ");
  }

  /**
   * One answer as a button.
   * @param {Question} question
   * @param {Said} answer
   * @param {number} at
   */
  function answerButton(question, answer, at) {
    const key = make("span", { className: "key" }, String(at + 1));
    const button = make("button", { className: "answer", type: "button" }, key, language.pick(answer));
    button.disabled = chosen !== null;
    if (chosen !== null && at === question.right) button.classList.add("right");
    else if (chosen === at) button.classList.add("wrong");
    button.addEventListener("click", () => choose(at));
    return button;
  }

  /**
   * Take an answer.
   * @param {number} at
   */
  function choose(at) {
    if (!open || chosen !== null || at >= open.answers.length) return;
    chosen = at;
    given.set(open, at === open.right);
    write();
    go.focus();
  }

  /**
   * Ask a question.
   * @param {Question} question
   */
  function show(question) {
    open = question;
    chosen = null;
    panel.hidden = false;
    write();
    element("button", HTMLElement, answers).focus();
  }

  /**
   * Write the score.
   * @param {Score} reached
   */
  function writeScore(reached) {
    count.textContent = pick("Quiz finished", "测验结束");
    ask.textContent = pick(`${reached.right} of ${reached.all} answers were right.`, `共答 ${reached.all} 题，答对 ${reached.right} 题。`);
    answers.replaceChildren();
    said.textContent = "";
    go.hidden = false;
  }

  /** The score, once all were asked; the next quiz begins anew. */
  function showScore() {
    score = { right: right(), all: given.size };
    given.clear();
    panel.hidden = false;
    write();
    go.focus();
  }

  /** Go on after an answer; after the last one with the score. */
  function goOn() {
    const wasQuestion = open !== null;
    open = null;
    panel.hidden = true;
    if (wasQuestion) player.play();
  }

  for (const question of doc.quiz) {
    const t = Math.min(border[question.row], player.duration);
    player.addGate({ t, isShut: () => isOn && !given.has(question), reached: () => show(question) });
  }
  player.addGate({
    t: player.duration,
    isShut: () => isOn && given.size === doc.quiz.length && given.size > 0,
    reached: showScore,
  });
  go.addEventListener("click", goOn);
  language.onChange(write);

  return {
    get isOn() { return isOn; },
    get isOpen() { return !panel.hidden; },
    /** Begin the quiz from the start of the run, or end it. */
    toggle() {
      isOn = !isOn;
      given.clear();
      open = null;
      panel.hidden = true;
      player.seek(0);
      if (isOn) player.play();
      else player.pause();
    },
    choose,
  };
}
