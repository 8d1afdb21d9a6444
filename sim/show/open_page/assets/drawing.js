// The drawing of the page: laid beneath the program, made into one, and what a run is held against.
import * as asked from "./asked.js";
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { IN_PLACE, lifted, moved, numberAt, placesIn, toggled } from "./picks.js";
import { completed, reordered, wirePlan } from "./plan.js";

/** @import { Said } from "../../html/assets/language.js" */
/** @import { Curves, Place } from "../../replay/assets/document.js" */
/** @import { Drafted, FileText, Planned, PlannedFigure, RunState } from "./data.js" */

/**
 * What the drawing is told, and whom it tells.
 * @typedef {object} Around
 * @property {() => { name: string, text: string }} current the program as it stands
 * @property {() => Record<string, string>} values of the form of the run
 * @property {(coming: Promise<RunState>) => void} follow shows how far a job is
 * @property {(read: FileText) => void} begin opens a program
 * @property {(curves: Curves | null) => void} beneath draws it under the path
 * @property {(picks: Place[], starts: Place[], entries: Place[]) => void} picked marks what is picked, thread points, and
 *   where cuts start
 * @property {(plan: Planned | null) => void} planned draws a plan over it
 * @property {(place: [x: number, y: number], nearUm: number) => PlannedFigure | null} figureAt the figure of the plan at a
 *   place
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
  const slugTab = element("#slug-tab", HTMLInputElement);
  const lag = element("#lag", HTMLInputElement);
  const roughFirst = element("#rough-first", HTMLInputElement);
  const noCore = element("#no-core", HTMLInputElement);
  const common = element("#common-edges", HTMLInputElement);
  const picks = element("#picks", HTMLInputElement);
  const starts = element("#starts", HTMLInputElement);
  const entries = element("#entries", HTMLInputElement);
  const order = element("#order", HTMLInputElement);
  const side = element("#wire-side", HTMLSelectElement);
  const direction = element("#direction", HTMLSelectElement);
  const clickDoes = element("#click-does", HTMLSelectElement);
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
  /** @type {Planned | null} */
  let planned = null;
  /** @type {PlannedFigure[]} of the last plan that there was */
  let figures = [];
  let isPlanning = false;
  const plan = wirePlan(toPlan, (found) => {
    const isFirst = !figures.length;
    planned = found;
    if (found?.figures) figures = found.figures;
    around.planned(found);
    show();
    if (isFirst && figures.length && order.value) plan(); // now it is known which figures are behind those that are named
  });

  /** What is asked of the plan that is to be shown; null where none is. */
  function toPlan() {
    if (!number || !isPlanning) return null;
    const laid = { ...wishes(), placement: JSON.stringify(placement) };
    return figures.length ? laid : { ...laid, order: "" };
  }

  /** Show which drawing there is, and what was told of it. */
  function show() {
    name.textContent = number ? file : language.say("no-drawing");
    buttons.hidden = element("#drawn", HTMLElement).hidden = element("#picks-hint", HTMLElement).hidden = !number;
    const [picked, threaded, entered] = [picks, starts, entries].map((field) => (number ? placesIn(field.value, placement) : []));
    around.picked(picked, threaded, entered);
    if (!made.length) list.className = "";
    const ofPlan = planned?.told ?? (planned?.why ? [planned.why] : []);
    const lines = made.length ? made : [...seen, ...ofPlan];
    list.replaceChildren(...lines.map((said) => make("li", {}, language.pick(said))));
  }

  /** Plan anew: something is asked for otherwise. */
  function changed() {
    isPlanning = true;
    made = [];
    show();
    plan();
  }

  /** How it is read. */
  function reading() {
    return { join_mm: join.value.trim(), unit: unit.value };
  }

  /** What is asked of a program. */
  function wishes() {
    const texts = { language: written, offset_mm: passes, tab_mm: tab, slug_tab_mm: slugTab, led_um: lag, picks, starts, entries, wire_side: side, direction };
    const own = Object.fromEntries(Object.entries(texts).map(([key, field]) => [key, field.value.trim()]));
    const [rough_first, no_core, common_edges] = [roughFirst, noCore, common].map((box) => (box.checked ? "yes" : ""));
    return { ...around.values(), drawing: number, ...own, rough_first, no_core, common_edges, order: completed(order.value, figures), ...reading() };
  }

  /** Take the drawing away. */
  function away() {
    number = picks.value = starts.value = entries.value = order.value = "";
    made = seen = [];
    around.beneath(null);
    plan();
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
        plan();
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
    around.follow(asked.draft(wishes()));
  });
  for (const field of [join, unit]) field.addEventListener("change", look);
  picks.addEventListener("input", () => { order.value = ""; }); // figures have other numbers then
  for (const field of [picks, starts, entries, order, passes, tab, lag, noCore, common, side, direction]) field.addEventListener("input", changed);
  language.onChange(show);

  return {
    /**
     * Pick what lies at a place of the picture, µm, set a thread point or the start of a cut there, or put its figure in
     * the order, as a click is to; or take that back. Whether there is a drawing to be clicked on.
     * @param {[x: number, y: number]} place
     * @param {number} nearUm
     */
    pick(place, nearUm) {
      if (!number || element("#panel-drawing", HTMLElement).hidden) return false;
      if (clickDoes.value === "order") {
        const figure = around.figureAt(place, nearUm);
        if (figure) order.value = reordered(order.value, figure.number);
      } else {
        const field = { starts, entries }[clickDoes.value] ?? picks;
        field.value = toggled(field.value, lifted(placement, place), nearUm);
        if (field === picks) order.value = "";
      }
      changed();
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
      for (const field of [starts, entries, picks]) {
        const of = numberAt(field.value, placement, place, nearUm);
        if (of < 0) continue;
        return (to) => {
          field.value = moved(field.value, of, lifted(placement, to));
          changed();
        };
      }
      return null;
    },
    /** Its number; empty where there is none. */
    number: () => number,
    /** Lay it beneath another program, which is drawn in place of the plan. */
    look() {
      isPlanning = isPlanning && !around.current().text.trim();
      return look();
    },
    /**
     * Another drawing.
     * @param {string} newNumber
     * @param {string} newFile
     */
    async take(newNumber, newFile) {
      [number, file, made, placement] = [newNumber, newFile, [], IN_PLACE];
      picks.value = starts.value = entries.value = order.value = "";
      [planned, figures, isPlanning] = [null, [], !around.current().text.trim()];
      around.planned(null);
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
          isPlanning = false; // it is drawn now as it is written
          plan();
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
