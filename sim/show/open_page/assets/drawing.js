// The drawing of the page: laid beneath the program, made into one, and what a run is held against.
import * as asked from "./asked.js";
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { IN_PLACE, lifted, moved, numberAt, placesIn, toggled } from "./picks.js";

/** @import { Said } from "../../html/assets/language.js" */
/** @import { Curves } from "../../replay/assets/document.js" */
/** @import { Drafted, FileText, RunState } from "./data.js" */

/**
 * What the drawing is told, and whom it tells.
 * @typedef {object} Around
 * @property {() => { name: string, text: string }} current the program as it stands
 * @property {() => Record<string, string>} values of the form of the run
 * @property {(coming: Promise<RunState>) => void} follow shows how far a job is
 * @property {(read: FileText) => void} begin opens a program
 * @property {(curves: Curves | null) => void} beneath draws it under the path
 * @property {(picks: [x: number, y: number][], starts: [x: number, y: number][]) => void} picked marks what is picked, and
 *   thread points
 * @property {(key: string) => void} tell says what went wrong
 */

/**
 * The drawing of the page, and its buttons.
 * @param {Around} around
 */
export function wireDrawing(around) {
  const name = element("#drawing-name", HTMLElement);
  const buttons = element("#drawing", HTMLElement);
  const list = element("#drawing-told", HTMLElement);
  const written = element("#as", HTMLSelectElement);
  const passes = element("#passes", HTMLInputElement);
  const tab = element("#tab", HTMLInputElement);
  const lag = element("#lag", HTMLInputElement);
  const noCore = element("#no-core", HTMLInputElement);
  const common = element("#common-edges", HTMLInputElement);
  const picks = element("#picks", HTMLInputElement);
  const starts = element("#starts", HTMLInputElement);
  const setsStarts = element("#click-starts", HTMLInputElement);
  const join = element("#join", HTMLInputElement);
  const unit = element("#unit", HTMLSelectElement);
  let placement = IN_PLACE;
  let number = "";
  let making = "";
  let led = "";
  /**
   * The text of the last program that was made, and the verdict of its proof.
   * @type {{ text: string | null, verdict: Drafted["verdict"] }}
   */
  let proved = { text: null, verdict: "pass" };
  let file = "";
  /** @type {Said[]} */
  let made = [];
  /** @type {Said[]} */
  let seen = [];

  /** Show which drawing there is, and what was told of it. */
  function show() {
    name.textContent = number ? file : language.say("no-drawing");
    buttons.hidden = element("#drawn", HTMLElement).hidden = element("#picks-hint", HTMLElement).hidden = !number;
    const [picked, threaded] = [picks, starts].map((field) => (number ? placesIn(field.value, placement) : []));
    around.picked(picked, threaded);
    if (!made.length) list.className = "";
    list.replaceChildren(...(made.length ? made : seen).map((said) => make("li", {}, language.pick(said))));
  }

  /** How it is read. */
  function reading() {
    return { join_mm: join.value.trim(), unit: unit.value };
  }

  /** Take the drawing away. */
  function away() {
    number = picks.value = starts.value = "";
    made = seen = [];
    around.beneath(null);
    show();
  }

  /** Lay it beneath the program as it stands. */
  async function look() {
    made = []; // that was of the program before
    if (!number) return;
    const before = number;
    seen = [language.said("stage-drawing")];
    show();
    try {
      const found = await asked.look({ ...around.values(), ...around.current(), ...reading(), drawing: number });
      if (before !== number) return;
      if (found.curves) {
        seen = found.told;
        placement = found.placement ?? IN_PLACE;
        around.beneath(found.curves);
      } else {
        away();
        seen = [found.why ?? language.said("no-look")];
      }
      show();
    } catch {
      around.tell("no-server");
    }
  }

  element("#away", HTMLElement).addEventListener("click", away);
  element("#make", HTMLElement).addEventListener("click", () => {
    // Its offsets are worked into the program; those of the form of the run a controller would add to them.
    making = number;
    led = lag.value.trim();
    const own = { language: written.value, offset_mm: passes.value.trim(), tab_mm: tab.value.trim(), picks: picks.value, starts: starts.value };
    const [no_core, common_edges] = [noCore, common].map((box) => (box.checked ? "yes" : ""));
    const how = { led_um: lag.value.trim(), no_core, common_edges, ...reading() };
    around.follow(asked.draft({ ...around.values(), drawing: number, ...own, ...how }));
  });
  for (const field of [join, unit]) field.addEventListener("change", look);
  for (const field of [picks, starts]) field.addEventListener("input", show);
  language.onChange(show);

  return {
    /**
     * Pick what lies at a place of the picture, µm, or set a thread point there, as a click is to; or take the one near it
     * back. Whether there is a drawing to be clicked on.
     * @param {[x: number, y: number]} place
     * @param {number} nearUm
     */
    pick(place, nearUm) {
      if (!number || element("#panel-drawing", HTMLElement).hidden) return false;
      const field = setsStarts.checked ? starts : picks;
      field.value = toggled(field.value, lifted(placement, place), nearUm);
      show();
      return true;
    },
    /**
     * Take hold of the mark at a place of the picture, µm: what moves it to others, null where there is none.
     * @param {[x: number, y: number]} place
     * @param {number} nearUm
     * @returns {((place: [x: number, y: number]) => void) | null}
     */
    mark(place, nearUm) {
      if (!number || element("#panel-drawing", HTMLElement).hidden) return null;
      for (const field of [starts, picks]) {
        const of = numberAt(field.value, placement, place, nearUm);
        if (of < 0) continue;
        return (to) => {
          field.value = moved(field.value, of, lifted(placement, to));
          show();
        };
      }
      return null;
    },
    /** Its number; empty where there is none. */
    number: () => number,
    look,
    /**
     * Another drawing.
     * @param {string} newNumber
     * @param {string} newFile
     */
    async take(newNumber, newFile) {
      [number, file, made, placement] = [newNumber, newFile, [], IN_PLACE];
      picks.value = starts.value = "";
      element("#tab-drawing", HTMLElement).click();
      show();
      await look();
    },
    /**
     * The verdict of the proof of a text; pass where it is not the program that was made of the drawing.
     * @param {string} now
     */
    verdictOf: (now) => (now === proved.text ? proved.verdict : "pass"),
    /** A program was made of it. */
    async done() {
      try {
        const { program, told, verdict } = await asked.drafted(making);
        if (program) {
          proved = { text: program.text, verdict };
          if (led) element("[name=lag_um]", HTMLInputElement).value = led; // it is made for that wire
          around.begin(program);
        }
        made = told;
        list.className = verdict === "pass" ? "proved" : verdict === "to-check" ? "doubted" : "unproved";
        show();
      } catch {
        around.tell("no-server");
      }
    },
  };
}
