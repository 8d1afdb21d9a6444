// The read-outs beside the table; a text is set only where it has changed.
import { elements } from "../../html/assets/elements.js";
import { pick, say } from "../../html/assets/language.js";
import { passOfRows } from "./passes.js";
import { clock, mm, number, way, weighed } from "./words.js";

/**
 * @import { Decision } from "./decisions.js"
 * @import { ReplayDocument } from "./document.js"
 * @import { Model } from "./model.js"
 * @import { Moment } from "./player.js"
 */

const MANY = 10000; // blocks: their number has no room beside that of the running one

/**
 * How F stands for the next step, as the controller works it out.
 * @param {Decision} made
 */
function formula(made) {
  /** @param {number} value */
  const squared = (value) => (value < 0 ? `(${number(value)})²` : `${number(value)}²`);
  const [x, y] = [number(made.x), number(made.y)];
  const [wordX, wordY] = [number(made.wordX), number(made.wordY)];
  if (made.kind === "arc") {
    const toward = say(made.toward === "center" ? "toward_center" : "from_center");
    return `F = x² + y² − R² = ${squared(made.x)} + ${squared(made.y)} − ${number(Number(made.rSquared))}; ${weighed(made.f)} → ${way(made)} ${toward}`;
  }
  const terms = made.motion === "L1" || made.motion === "L3"
    ? `Xe·y − Ye·x = ${wordX}·${y} − ${wordY}·${x}`
    : `Ye·x − Xe·y = ${wordY}·${x} − ${wordX}·${y}`;
  return `F = ${terms}; ${weighed(made.f)} → ${way(made)}`;
}

/**
 * Read-outs in elements of a page, found by `data-out`.
 * @param {ParentNode} page
 * @param {ReplayDocument} doc
 * @param {Pick<Model, "decision">} model
 */
export function readoutsIn(page, doc, model) {
  const rows = doc.blocks.kind.length;
  const passes = passOfRows(doc);
  const isCard = doc.interpolator === "card";
  const fields = new Map(elements("[data-out]", page).map((field) => [field.dataset.out, field]));

  /**
   * Write one read-out.
   * @param {string} name
   * @param {string} text
   */
  function write(name, text) {
    const field = fields.get(name);
    if (field && field.textContent !== text) field.textContent = text;
  }

  /**
   * Name the pass that a block belongs to, beside its colour.
   * @param {number} row
   */
  function writePass(row) {
    const pass = passes[row];
    write("pass", pass ? pick(pass.name) : "–");
    fields.get("pass")?.style.setProperty("--tone", pass ? `var(--${pass.paint})` : "transparent");
  }

  /**
   * What is left of a block's count, or nothing to tell: with the word of its axis where the program has words.
   * @param {Moment} moment
   */
  function left({ block, count_left: count }) {
    if (count === null) return "–";
    return `${number(count)} ${doc.program.is_worded ? "G" : ""}${doc.blocks.count_axis[block]}`;
  }

  /**
   * The block that runs: its label where it has one, and its place among all where that has room.
   * @param {number} row
   */
  function running(row) {
    const place = rows < MANY ? `${number(row + 1)} / ${number(rows)}` : number(row + 1);
    return [doc.blocks.label[row], place].filter(Boolean).join(" · ");
  }

  return {
    /**
     * Show a moment.
     * @param {Moment} moment
     */
    show(moment) {
      const next = moment.isAsked ? null : model.decision(moment.step + 1);
      write("x", mm(moment.x));
      write("y", mm(moment.y));
      write("left", moment.isAsked ? "–" : left(moment));
      write("feed", number((moment.feed_um_s * 60) / 1000, 2));
      write("block", running(moment.block));
      write("step", number(moment.step));
      write("elapsed", clock(moment.t));
      write("remaining", clock(moment.remaining_s));
      write("deviation", number(moment.deviation.um, 2));
      write("f", next ? `${weighed(next.f)} → ${way(next)}` : "–");
      writePass(moment.block);
      write("formula", next ? formula(next) : isCard ? say("no_f") : "");
    },
  };
}
