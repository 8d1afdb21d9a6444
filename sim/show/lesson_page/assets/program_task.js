// Write the program of a drawing: it is drawn and read as one types, and marked by its parts.
import { element, elements, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { draw } from "./picture.js";
import { mm } from "./places.js";
import { read_listing } from "./plain_blocks.js";
import { decoded } from "./plain_curves.js";
import { PARTS, parts_of, program_mark, written_of } from "./plain_program.js";
import { stepperIn } from "./stepper.js";

/** @import { Point } from "./plain_curves.js" */
/** @import { ProgramMark } from "./plain_program.js" */
/** @import { Step } from "./step.js" */

/**
 * A task of a program.
 * @param {Step} step
 */
export function programTask({ form, rules, exercise }) {
  const { target } = rules;
  const nominal = target.variants.find(({ name }) => name === "no-offset") ?? target.variants[0];
  const input = element(".entry textarea", HTMLTextAreaElement, form);
  const live = element(".live", HTMLElement, form);
  const reasons = element(".reasons", HTMLElement, form);
  const picture = form.querySelector("svg.picture");
  /** @type {Point | null} */
  let stands = null;
  /** @type {Point | null} */
  let slip = null;
  const stepper = stepperIn(form, (at) => {
    stands = at;
    paint();
  });

  /** Draw the drawing, and what is typed. */
  function paint() {
    if (!picture) return;
    const path = decoded(read_listing(input.value).blocks, target.thread);
    const marks = [
      { at: target.thread, name: language.say("thread_place") },
      ...(stands ? [{ at: stands, name: "", kind: "wire" }] : []),
      ...(slip ? [{ at: slip, name: "", kind: "slip" }] : []),
    ];
    draw(picture, { drawing: nominal.curves, path, marks });
  }

  /** Say what is typed, or where it cannot be read. */
  function tell() {
    const listing = read_listing(input.value);
    const path = decoded(listing.blocks, target.thread);
    if (listing.unread.length) {
      const [{ line, column }] = listing.unread;
      live.textContent = language.say("unread", { line, column });
    } else if (path.length) {
      const { x, y } = path[path.length - 1].end;
      live.textContent = language.say("reads_blocks", { blocks: path.length, x: mm(x), y: mm(y) });
    } else {
      live.textContent = "";
    }
  }

  input.addEventListener("input", () => {
    slip = null;
    tell();
    const { blocks } = read_listing(input.value);
    stepper.load(blocks, decoded(blocks, target.thread));
  });

  /**
   * Why parts of a mark are wrong.
   * @param {ProgramMark} mark
   */
  function why(mark) {
    const lines = [];
    if (!mark.closes) lines.push(language.say("not_closed"));
    if (mark.closes && !mark.shape) {
      lines.push(language.say("off_at", { far: mm(mark.off_um), x: mm(mark.at.x), y: mm(mark.at.y), block: mark.at_block }));
    }
    if (mark.shape && !mark.offset) lines.push(language.say(`fits_${mark.fits}`, { by: mm(exercise.offset_um * (mark.fits === "wrong-side" ? 2 : 1)) }));
    if (mark.shape && mark.moved_um > target.within_um) lines.push(language.say("moved_by", { far: mm(mark.moved_um) }));
    if (mark.wrong_block > 0) lines.push(language.say("wrong_block", { block: mark.wrong_block }));
    return lines;
  }

  /**
   * The parts of an attempt, right or wrong, and why.
   * @param {string} text
   */
  function reveal(text) {
    const mark = program_mark(target, written_of(text, target.thread));
    const parts = parts_of(mark);
    for (const item of elements(".parts li", form)) {
      const part = parts[PARTS.indexOf(item.dataset.part ?? "")];
      item.className = part > 0 ? "right" : "wrong";
      element(".sign", HTMLElement, item).textContent = part > 0 ? "✓" : "✗";
    }
    slip = mark.closes && !mark.shape ? mark.at : null;
    reasons.replaceChildren(...why(mark).map((line) => make("li", {}, line)));
    paint();
  }

  return {
    answer: () => input.value.trim(),
    reveal,
    /** Write it in the language of the page. */
    write() {
      const direction = target.turn === 0 ? "any_direction" : target.turn > 0 ? "counter_clockwise" : "clockwise";
      element(".ask", HTMLElement, form).textContent = language.say(exercise.offset_um > 0 ? "write_program" : "write_program_0", {
        x: mm(target.thread.x), y: mm(target.thread.y), offset: mm(exercise.offset_um),
        side: language.say(exercise.is_inside ? "inside" : "outside"), direction: language.say(direction),
      });
      element("figcaption", HTMLElement, form).textContent = language.say("caption");
      tell();
      paint();
    },
    close() {
      input.readOnly = true;
    },
  };
}
