// Say what it does: where a block ends, which step comes next, when a piece falls, how long it takes.
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { written } from "./block_task.js";
import { draw } from "./picture.js";
import { mm, short } from "./places.js";
import { shape_at, step_question } from "./plain_answers.js";
import { read_listing } from "./plain_blocks.js";
import { Point, arc_to, curve_of, decoded, length_of, line_to, point_on } from "./plain_curves.js";
import { after_steps } from "./plain_stepping.js";
import { seed_of_task, task_of } from "./plain_tasks.js";

/** @import { Step } from "./step.js" */

const SEEN_UM = 16; // of a path, where single steps are looked at

/**
 * What a task asks for, besides how it is answered.
 * @typedef {object} Asking
 * @property {string} code what is shown of a program
 * @property {() => string} ask
 * @property {() => string} right the answer
 * @property {() => string} caption below the picture
 * @property {(isClosed: boolean) => import("./picture.js").Scene} scene
 */

/**
 * Where a block ends.
 * @param {Step} step
 * @returns {Asking}
 */
function endAsking({ rules, seed, number }) {
  const task = task_of(shape_at(rules.shapes, number), seed_of_task(seed, number));
  return {
    code: written(task.block),
    ask: () => language.say("end_of", { x0: mm(task.start.x), y0: mm(task.start.y) }),
    right: () => `${mm(task.end.x)}, ${mm(task.end.y)}`,
    caption: () => language.say("caption_end"),
    scene: (isClosed) => ({
      drawing: [],
      path: isClosed ? [curve_of(task.block, task.start)] : [],
      marks: [
        { at: task.start, name: language.say("start_place") },
        ...(isClosed ? [{ at: task.end, name: language.say("end_place") }] : []),
      ],
    }),
  };
}

/**
 * Which step comes next.
 * @param {Step} step
 * @returns {Asking}
 */
function stepAsking({ rules, seed, number }) {
  const { task, steps, stepper, right } = step_question(shape_at(rules.shapes, number), seed_of_task(seed, number));
  const from = task.block.turn === 0 ? task.start : task.centre;
  const places = Array.from({ length: steps + 1 }, (_, done) => after_steps(task.block, done));
  const stood = places.map(({ x, y }) => Point(from.x + x, from.y + y));
  const exact = task.block.turn === 0
    ? line_to(task.start, point_on(curve_of(task.block, task.start), SEEN_UM / length_of(curve_of(task.block, task.start))))
    : arc_to(task.start, task.centre, task.block.turn * SEEN_UM / Math.hypot(task.block.x, task.block.y));
  return {
    code: written(task.block),
    ask: () => language.say("step_of", {
      steps, x: stepper.x, y: stepper.y, deviation: stepper.deviation, count: stepper.count_left,
      from: language.say(task.block.turn === 0 ? "from_start" : "from_centre"),
    }),
    right: () => ["+X", "−X", "+Y", "−Y"][right],
    caption: () => language.say("caption_steps"),
    scene: () => ({
      drawing: [exact],
      path: stood.slice(1).map((end, at) => line_to(stood[at], end)),
      marks: [{ at: stood[steps], name: "" }],
    }),
  };
}

/**
 * When a piece falls, or how long a program takes.
 * @param {Step} step
 * @returns {Asking}
 */
function programAsking({ rules, exercise }) {
  const { program, feed_mm_min: feed } = exercise;
  const path = decoded(read_listing(program).blocks, Point(0, 0));
  return {
    code: program,
    ask: () => language.say(rules.ask === "falls" ? "falls_of" : "time_of", { feed }),
    right: () => short(rules.question.right[0]),
    caption: () => language.say("caption_program"),
    scene: () => ({ drawing: [], path, marks: [{ at: Point(0, 0), name: language.say("thread_place") }] }),
  };
}

const ASKINGS = { end: endAsking, "next-step": stepAsking, falls: programAsking, time: programAsking };

/**
 * A task that is answered by numbers or a choice.
 * @param {Step} step
 */
export function numberTask(step) {
  const { form, rules } = step;
  const asking = ASKINGS[/** @type {keyof ASKINGS} */ (rules.ask)](step);
  const input = form.querySelector(".entry input");
  const reasons = element(".reasons", HTMLElement, form);
  const picture = form.querySelector("svg.picture");
  let isClosed = false;
  element(".ask", HTMLElement, form).after(make("pre", { className: "code mono" }, asking.code));

  /** Draw it. */
  function paint() {
    if (picture) draw(picture, asking.scene(isClosed));
  }

  /** The answer as it stands. */
  function answer() {
    if (input instanceof HTMLInputElement) return input.value.trim();
    const found = form.querySelector("input[type=radio]:checked");
    return found instanceof HTMLInputElement ? found.value : "";
  }

  return {
    answer,
    /**
     * The answer, once no attempt is left and it was not right.
     * @param {string} _
     * @param {boolean} isLast
     * @param {boolean} isRight
     */
    reveal(_, isLast, isRight) {
      const told = isLast && !isRight ? [make("li", {}, language.say("answer_is", { answer: asking.right() }))] : [];
      reasons.replaceChildren(...told);
    },
    write() {
      element(".ask", HTMLElement, form).textContent = asking.ask();
      element("figcaption", HTMLElement, form).textContent = asking.caption();
      paint();
    },
    close() {
      isClosed = true;
      for (const each of form.querySelectorAll("input")) each.disabled = true;
      paint();
    },
  };
}
