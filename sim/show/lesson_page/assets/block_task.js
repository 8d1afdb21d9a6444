// Write a block: the picture grows with what is typed, hints come one by one, and each word is marked.
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { draw } from "./picture.js";
import { mm, values } from "./places.js";
import { shape_at } from "./plain_answers.js";
import { read_listing } from "./plain_blocks.js";
import { curve_of, decoded } from "./plain_curves.js";
import { words_mark } from "./plain_marks.js";
import { seed_of_task, task_of } from "./plain_tasks.js";
import { stepperIn } from "./stepper.js";

/** @import { Point } from "./plain_curves.js" */
/** @import { Task } from "./plain_tasks.js" */
/** @import { Step } from "./step.js" */

const WORDS = /** @type {const} */ (["x", "y", "count", "axis", "sense"]);
const HINTS = 5;

/**
 * What a task asks for, in words.
 * @param {Task} task
 */
export function described({ shape, start, end, centre, block }) {
  const way = language.say(block.turn > 0 ? "counter_clockwise" : "clockwise");
  const what = block.turn === 0 ? "line" : shape === "circle" ? "circle" : "arc";
  return language.say(what, { ...values(start, end, centre), way });
}

/**
 * A block as it is written.
 * @param {Task["block"]} block
 */
export function written({ x, y, count_um, axis, turn, quadrant }) {
  return `B${x} B${y} B${count_um} G${"XY"[axis]} ${senseOf(turn)}${quadrant}`;
}

/** @param {number} turn */
function senseOf(turn) {
  return turn === 0 ? "L" : turn > 0 ? "NR" : "SR";
}

/**
 * Values of the texts that tell the words of a block.
 * @param {Task} task
 */
function wordsOf({ block }) {
  return {
    x: block.x, y: block.y, count: block.count_um, axis: `G${"XY"[block.axis]}`, quadrant: block.quadrant,
    word: senseOf(block.turn), sense: `${senseOf(block.turn)}${block.quadrant}`, near: "YX"[block.axis],
    way: language.say(block.turn > 0 ? "counter_clockwise" : "clockwise"),
  };
}

/**
 * A task of a block.
 * @param {Step} step
 */
export function blockTask({ form, rules, seed, number }) {
  const task = task_of(shape_at(rules.shapes, number), seed_of_task(seed, number));
  const kind = task.block.turn === 0 ? "line" : "arc";
  const input = element(".entry input", HTMLInputElement, form);
  const live = element(".live", HTMLElement, form);
  const words = element(".words", HTMLElement, form);
  const hint = element(".hint", HTMLButtonElement, form);
  const reasons = element(".reasons", HTMLElement, form);
  const picture = form.querySelector("svg.picture");
  const asked = curve_of(task.block, task.start);
  let hints = 0;
  /** @type {Point | null} */
  let stands = null;
  const stepper = stepperIn(form, (at) => {
    stands = at;
    paint();
  });

  /** Blocks that are typed so far. */
  const blocks = () => read_listing(input.value).blocks.slice(0, 1);

  /** Draw what is asked for, and what is typed. */
  function paint() {
    if (!picture) return;
    const marks = [
      { at: task.start, name: language.say("start_place") },
      ...(task.shape === "circle" ? [] : [{ at: task.end, name: language.say("end_place") }]),
      ...(task.block.turn === 0 ? [] : [{ at: task.centre, name: language.say("centre_place") }]),
      ...(stands ? [{ at: stands, name: "", kind: "wire" }] : []),
    ];
    draw(picture, { drawing: [asked], path: decoded(blocks(), task.start), marks });
  }

  /** Say what is typed. */
  function tell() {
    const listing = read_listing(input.value);
    const end = blocks().length ? curve_of(blocks()[0], task.start).end : null;
    live.textContent = end && !listing.unread.length
      ? language.say("reads_blocks", { blocks: listing.blocks.length, x: mm(end.x), y: mm(end.y) })
      : input.value.trim() ? language.say("one_block") : "";
  }

  /** Write the hints that were asked for. */
  function writeHints() {
    const told = Array.from({ length: hints }, (_, at) => language.say(`hint_${at + 1}_${kind}`, wordsOf(task)));
    reasons.replaceChildren(...told.map((text) => make("li", {}, text)));
    hint.disabled = hints >= HINTS;
  }

  input.addEventListener("input", () => {
    tell();
    stepper.load(blocks(), decoded(blocks(), task.start));
  });
  hint.addEventListener("click", () => {
    hints = Math.min(hints + 1, HINTS);
    writeHints();
  });

  /**
   * The words of an attempt, right or wrong, and why.
   * @param {string} text
   * @param {boolean} isLast
   */
  function reveal(text, isLast) {
    const mark = words_mark(task, text);
    const rights = { x: mark.x, y: mark.y, count: mark.count_length, axis: mark.axis, sense: mark.sense };
    words.replaceChildren(...WORDS.map((word) => make(
      "li", { className: rights[word] ? "right" : "wrong" },
      `${rights[word] ? "✓" : "✗"} ${language.say(`word_${word}`)}`,
      make("span", { className: "unseen" }, ` ${language.say(rights[word] ? "yes" : "no")}`),
    )));
    if (!isLast) return;
    const right = wordsOf(task);
    const told = WORDS.filter((word) => !rights[word]).map((word) => {
      const key = word === "axis" ? `why_axis_${kind}` : `why_${word}`;
      return language.say(key, { right: right[word], rule: language.say(`rule_xy_${kind}`) });
    });
    if (told.length) told.push(language.say("answer_is", { answer: written(task.block) }));
    reasons.replaceChildren(...told.map((line) => make("li", {}, line)));
  }

  return {
    answer: () => input.value.trim(),
    reveal,
    /** Write it in the language of the page. */
    write() {
      element(".ask", HTMLElement, form).textContent = language.say("write_block", { what: described(task) });
      element("figcaption", HTMLElement, form).textContent = language.say("caption");
      tell();
      paint();
    },
    close() {
      input.readOnly = true;
      hint.disabled = true;
    },
  };
}
