// Quiz: before some blocks the replay stops and asks; the answer is weighed, and the replay goes on and shows it.
import * as language from "../../html/assets/language.js";
import { asked } from "./moment.js";
import { cardsIn } from "./quiz_cards.js";
import { saveScore } from "./quiz_score.js";

/**
 * @import { Question, ReplayDocument } from "./document.js"
 * @import { Player } from "./player.js"
 * @import { Boxes } from "./quiz_cards.js"
 */

/** @typedef {ReturnType<typeof quizIn>} Quiz */
/** @typedef {"off" | "begin" | "runs" | "asks" | "ended"} Stage */

/** The set that the address names, ``#quiz=17``; 0 where it names none. */
const linked = () => Number(asked("quiz")) || 0;

/**
 * The questions of a set by its number; without one, or with one that there is not, those of the scenario, else the first.
 * @param {ReplayDocument["quiz"]} quiz
 * @param {number} number
 */
function setOf({ own, pool, sets }, number) {
  const isSet = number >= 1 && number <= sets.length;
  if (!isSet && own.length) return { number: 0, questions: own };
  const set = isSet ? number : 1;
  return { number: sets.length ? set : 0, questions: (sets[set - 1] ?? []).map((at) => pool[at]) };
}

/**
 * Quiz in boxes of the page, over a player; `onAsk` hears of the question that is open, and of null where none is.
 * @param {Boxes} boxes
 * @param {ReplayDocument} doc
 * @param {Player} player
 * @param {(question: Question | null) => void} onAsk
 */
export function quizIn(boxes, doc, player, onAsk) {
  const { border_s: border } = doc.blocks;
  const cards = cardsIn(boxes, choose);
  /** @type {Map<Question, number>} */
  const given = new Map(); // question to the answer that was chosen
  let { number, questions } = setOf(doc.quiz, linked());
  let who = "";
  /** @type {Stage} */
  let stage = "off";
  /** @type {Question | null} */
  let open = null;

  /** How many were right, of all. */
  const score = () => ({ right: questions.filter((one) => given.get(one) === one.right).length, all: questions.length });

  /** Show what there is to see, in the language of the page. */
  function write() {
    if (stage === "begin" && !questions.length) cards.none();
    else if (stage === "begin") cards.begin();
    else if (stage === "asks" && open) {
      const place = { number: questions.indexOf(open) + 1, all: questions.length };
      cards.question(open, place, given.get(open) ?? null);
    } else if (stage === "ended") cards.score(score());
    else cards.close();
  }

  /**
   * Come to a stage.
   * @param {Stage} next
   * @param {Question | null} [question]
   */
  function come(next, question = null) {
    stage = next;
    open = question;
    write();
    onAsk(stage === "asks" && open && !given.has(open) ? open : null);
    if (cards.isOpen) cards.focus();
  }

  /**
   * Take an answer.
   * @param {number} at
   */
  function choose(at) {
    if (stage !== "asks" || !open || given.has(open) || at >= open.answers.length) return;
    given.set(open, at);
    come("asks", open);
    boxes.go.focus();
  }

  /** Begin with the set and the name that were written. */
  function begin() {
    const wanted = cards.asked();
    ({ number, questions } = setOf(doc.quiz, wanted.number));
    who = wanted.name;
    given.clear();
    come("runs");
    player.seek(0);
    player.play();
  }

  /** Go on: begin, after an answer, or close after the score. */
  function goOn() {
    if (stage === "begin" && questions.length) begin();
    else if (stage === "asks") {
      come("runs");
      player.play();
    } else toggle();
  }

  /** Begin the quiz, or end it. */
  function toggle() {
    if (stage === "off") {
      player.pause();
      ({ number, questions } = setOf(doc.quiz, linked() || number));
      cards.ask(number);
      come("begin");
      return;
    }
    come("off");
    player.pause();
  }

  for (const question of [...doc.quiz.own, ...doc.quiz.pool]) {
    player.addGate({
      t: Math.min(border[question.row], player.duration),
      isShut: () => stage === "runs" && questions.includes(question) && !given.has(question),
      reached: () => come("asks", question),
    });
  }
  player.addGate({
    t: player.duration,
    isShut: () => stage === "runs" && questions.every((question) => given.has(question)),
    reached: () => come("ended"),
  });
  boxes.go.addEventListener("click", goOn);
  boxes.save.addEventListener("click", () => saveScore(questions, given, { who, number }));
  boxes.start.addEventListener("submit", (event) => {
    event.preventDefault();
    goOn();
  });
  language.onChange(write);

  return {
    get isOn() { return stage !== "off"; },
    get isOpen() { return cards.isOpen; },
    get isAsking() { return stage === "asks"; },
    /** Whether the address leads to it. */
    get isLinked() { return linked() > 0; },
    /** Rows before whose blocks it asks, while it is on. */
    get rows() { return stage === "off" ? [] : questions.map(({ row }) => row); },
    toggle,
    choose,
  };
}
