// What the quiz shows: how it begins, a question with its answers, the score.
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/**
 * @import { Said } from "../../html/assets/language.js"
 * @import { Question } from "./document.js"
 */

/** @typedef {Record<"panel" | "count" | "ask" | "answers" | "said" | "go" | "save" | "start", HTMLElement>} Boxes */
/** @typedef {ReturnType<typeof cardsIn>} Cards */

/**
 * Cards in boxes of the page.
 * @param {Boxes} boxes
 * @param {(at: number) => void} onAnswer
 */
export function cardsIn({ panel, count, ask, answers, said, go, save, start }, onAnswer) {
  /**
   * Lay out a card.
   * @param {{ head: string, text: string, isStart?: boolean, goes?: boolean, saves?: boolean }} card
   */
  function lay({ head, text, isStart = false, goes = true, saves = false }) {
    panel.hidden = false;
    count.textContent = head;
    ask.textContent = text;
    answers.replaceChildren();
    said.textContent = said.className = "";
    start.hidden = !isStart;
    go.hidden = !goes;
    save.hidden = !saves;
  }

  /**
   * One answer as a button.
   * @param {Question} question
   * @param {Said} answer
   * @param {number} at
   * @param {number | null} chosen
   */
  function answerButton(question, answer, at, chosen) {
    const key = make("span", { className: "key" }, String(at + 1));
    const button = make("button", { className: "answer", type: "button" }, key, language.pick(answer));
    button.disabled = chosen !== null;
    if (chosen !== null && at === question.right) button.classList.add("right");
    else if (chosen === at) button.classList.add("wrong");
    button.addEventListener("click", () => onAnswer(at));
    return button;
  }

  return {
    get isOpen() { return !panel.hidden; },
    close() {
      panel.hidden = true;
    },
    /** Have the keyboard: no answer has it, which Space would give. */
    focus() {
      panel.focus();
    },
    /** That there is nothing to ask. */
    none() {
      lay({ head: language.say("quiz_title"), text: language.say("quiz_none") });
    },
    /** How it begins. */
    begin() {
      lay({ head: language.say("quiz_title"), text: language.say("quiz_begin"), isStart: true });
    },
    /**
     * A question, with the answer that was chosen, if any.
     * @param {Question} question
     * @param {{ number: number, all: number }} place
     * @param {number | null} chosen
     */
    question(question, place, chosen) {
      lay({ head: language.say("question", place), text: language.pick(question.ask), goes: chosen !== null });
      answers.replaceChildren(...question.answers.map((answer, at) => answerButton(question, answer, at, chosen)));
      if (chosen === null) return;
      const isRight = chosen === question.right;
      said.textContent = [language.say(isRight ? "right" : "wrong"), language.pick(question.why)].join(" ").trim();
      said.className = isRight ? "right" : "wrong";
    },
    /**
     * How many were right.
     * @param {{ right: number, all: number }} reached
     */
    score(reached) {
      lay({ head: language.say("quiz_finished"), text: language.say("score", reached), saves: true });
    },
    /** What was written into the fields of the beginning: a set's number, 0 for none, and who answers. */
    asked() {
      const [number, name] = ["number", "text"].map((type) => element(`input[type=${type}]`, HTMLInputElement, start));
      return { number: Math.trunc(Number(number.value)) || 0, name: name.value.trim() };
    },
    /**
     * Write a set's number into its field.
     * @param {number} number
     */
    ask(number) {
      element("input[type=number]", HTMLInputElement, start).value = number ? String(number) : "";
    },
  };
}
