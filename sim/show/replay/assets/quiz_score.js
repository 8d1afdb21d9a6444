// The score of a quiz as a file to take along: a line for each question, in the language of the page.
import { cellOf, fileOf, save } from "../../html/assets/csv.js";
import { pick, say } from "../../html/assets/language.js";

/** @import { Question } from "./document.js" */

/**
 * Save what was answered.
 * @param {Question[]} questions
 * @param {Map<Question, number>} given the answer that was chosen
 * @param {{ who: string, number: number }} about who answered, and which set; 0 for the scenario's own questions
 */
export function saveScore(questions, given, { who, number }) {
  const heads = [
    say("csv_who"), say("csv_set"), say("csv_number"), say("csv_block"), say("csv_question"), say("csv_answer"),
    say("csv_right_answer"), say("csv_is_right"),
  ];
  const lines = questions.map((question, at) => {
    const chosen = given.get(question) ?? -1;
    const answer = question.answers[chosen] ? pick(question.answers[chosen]) : "";
    const right = pick(question.answers[question.right]);
    const texts = [who, String(number || ""), String(at + 1), question.name, pick(question.ask), answer, right];
    return [...texts, chosen === question.right ? "1" : "0"].map(cellOf);
  });
  save("quiz.csv", fileOf([heads.map(cellOf), ...lines]));
}
