// The status bar: the verdict, how much is cut and left, how large the part is, and where the pointer is.
import { VERDICTS } from "./data.js";
import { mm } from "./size.js";
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import * as words from "../../replay/assets/words.js";

/** @import { Answer, Path } from "./data.js" */
/** @import { Shown } from "./playing.js" */

/** @typedef {ReturnType<typeof wireStatus>} Status */
/** @typedef {Answer["verdict"]} Verdict */

/** From the worst to the best. @type {Verdict[]} */
const WORST = ["none", "fail", "incomplete", "to-check", "pass"];

/**
 * The worse of two verdicts.
 * @param {Verdict} one
 * @param {Verdict} other
 */
export const worse = (one, other) => WORST[Math.min(WORST.indexOf(one), WORST.indexOf(other))];

/**
 * How much is cut before each block of a path, µm; n + 1 of n blocks.
 * @param {Path} path
 */
function cutBefore(path) {
  let sum = 0;
  return [0, ...path.kind.map((kind, row) => (sum += kind === "jump" ? 0 : path.length_um[row]))];
}

/** The status bar of the page. */
export function wireStatus() {
  const verdict = element("#counts", HTMLElement);
  /** @param {string} name */
  const reading = (name) => element(`#reading-${name}`, HTMLElement);
  /** @type {Answer | null} */
  let known = null;
  /** @type {Path | null} */
  let path = null;
  /** @type {number[]} */
  let cut = [0];
  /** @type {Shown | null} */
  let shown = null;

  /**
   * @param {string} name
   * @param {string} text
   */
  function read(name, text) {
    const found = reading(name);
    if (found.textContent !== text) found.textContent = text;
  }

  /** How far the wire is, and how long it will take. */
  function showMoment() {
    const whole = cut[cut.length - 1];
    if (!path || !shown) {
      read("cut", whole ? `${mm(whole)} mm` : "–");
      read("remaining", path ? words.clock(path.border_s[path.kind.length]) : "–");
      return;
    }
    const { block, t, remaining_s: left } = shown.moment;
    const { border_s: border } = shown.show.replay.doc.blocks;
    const took = border[block + 1] - border[block];
    const share = took > 0 ? Math.min(1, Math.max(0, (t - border[block]) / took)) : 1;
    const done = cut[block] + share * (cut[block + 1] - cut[block]);
    read("cut", `${mm(done)} / ${mm(whole)} mm · ${whole ? Math.floor((100 * done) / whole + 1e-9) : 0} %`);
    read("remaining", words.clock(left));
  }

  /**
   * The path that is measured.
   * @param {Path | null} newPath
   */
  function takePath(newPath) {
    if (path === newPath) return;
    path = newPath;
    cut = path ? cutBefore(path) : [0];
  }

  /** Write all that does not change with time. */
  function show() {
    const box = known?.size?.box_um;
    read("extent", box ? `${mm(box[2] - box[0])} × ${mm(box[3] - box[1])} mm` : "–");
    read("machine", known ? language.pick(known.machine) : "–");
    reading("machine").title = reading("machine").textContent;
    showMoment();
  }

  return {
    show,
    /**
     * What is known of the text, null of none, and the verdict over all.
     * @param {Answer | null} answer
     * @param {Verdict | null} over
     */
    judge(answer, over) {
      known = answer;
      takePath(answer ? answer.path : null);
      verdict.className = over ?? "";
      verdict.textContent = over ? language.say(VERDICTS[over]) : "–";
      element("#dialect", HTMLElement).textContent = answer?.dialect ?? "";
      show();
    },
    /**
     * A moment of what is played.
     * @param {Shown | null} newShown
     */
    at(newShown) {
      shown = newShown;
      showMoment();
    },
    /**
     * Half the width that the wire cuts, µm.
     * @param {number} um
     */
    cutBy(um) { read("kerf-half", `${mm(um)} mm`); },
    /**
     * Where the pointer is; null where it is not over the picture.
     * @param {[x: number, y: number] | null} place
     */
    cursor(place) { read("cursor", place ? `X ${mm(place[0])}  Y ${mm(place[1])}` : ""); },
  };
}
