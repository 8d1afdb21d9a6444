// A list of programs: those of the folder that is open, or several files that were dropped; each is opened by a click.
import * as asked from "./asked.js";
import { VERDICTS as SAID } from "./data.js";
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { fitting, searched } from "../../index_page/assets/asked.js";
import { codes, picture } from "../../index_page/assets/rows.js";
import { Table } from "../../index_page/assets/table.js";
import { mm } from "./size.js";

/** @import { Head } from "../../index_page/assets/table.js" */
/** @import { Said } from "../../html/assets/language.js" */
/** @import { Verdict } from "../../index_page/assets/data.js" */
/** @import { Row } from "./data.js" */

const LOOK_MS = 400;
const MOST = 10_000; // files that are listed
/** @type {[width: number, height: number]} */
const BOX = [96, 72];
/** @type {Head[]} */
const HEADS = [
  ["picture", null, ""], ["file", "file", ""], ["verdict", "verdict", ""], ["findings", "findings", ""],
  ["extent", null, ""], ["cut", "cut_um", ""],
];
const VERDICTS = {
  pass: SAID.pass, "to-check": SAID["to-check"], incomplete: SAID.incomplete, fail: SAID.fail, refused: SAID.none, fault: "fault",
};

/**
 * Let programs be listed.
 * @param {(source: string | File) => Promise<boolean>} open a program by its number, or a file; whether it did
 */
export function wireListing(open) {
  /** @type {{ programs: Row[], titles: Record<string, Said> }} */
  const index = { programs: [], titles: {} };
  /** @type {string[]} */
  let texts = [];
  /** @type {(string | File)[]} */
  let sources = [];
  let [total, leftOut, title, serial, listNow] = [0, 0, "", 0, 0];
  const search = element("#search", HTMLInputElement);
  const verdict = element("#wanted", HTMLSelectElement);
  const again = element("#again", HTMLButtonElement);
  const toList = element("#to-list", HTMLElement);
  const table = new Table(index, HEADS, rowOf);

  /** @param {Row} program */
  function rowOf(program) {
    const name = make("button", { type: "button", className: "go" }, program.file);
    name.addEventListener("click", async () => {
      if (await open(sources[index.programs.indexOf(program)])) showList(false);
    });
    const told = program.message ? [make("span", { className: "hint" }, language.pick(program.message))] : [];
    const box = program.box_um;
    return make(
      "tr", { className: program.verdict },
      make("td", { className: "small" }, ...picture(program, BOX)),
      make("th", { scope: "row" }, name, ...told),
      make("td", { className: "word" }, language.say(VERDICTS[program.verdict])),
      make("td", {}, ...codes(program.findings, index.titles)),
      make("td", {}, box ? `${mm(box[2] - box[0])} × ${mm(box[3] - box[1])} mm` : "–"),
      make("td", {}, program.cut_um === null ? "–" : `${mm(program.cut_um)} mm`),
    );
  }

  /** @param {boolean} isShown */
  function showList(isShown) {
    document.body.classList.toggle("listing", isShown);
    toList.ariaPressed = String(isShown);
  }

  /** Offer the verdicts in the words of the language; what was chosen stays so. */
  function offer() {
    const chosen = verdict.value;
    const offered = Object.entries({ "": "any", ...VERDICTS });
    verdict.replaceChildren(...offered.map(([value, key]) => make("option", { value }, language.say(key))));
    verdict.value = chosen;
  }

  /** Say how far the check is, and show the rows that fit what is asked for. */
  function show() {
    const n = index.programs.length;
    const said = n < total ? language.say("checked-so-far", { n, all: total }) : language.say("checked-all", { all: total });
    const more = leftOut ? ` ${language.say("left-out", { n: leftOut })}` : "";
    element("#listed", HTMLElement).textContent = title || language.say("dropped");
    element("#far", HTMLElement).textContent = said + more;
    const wanted = /** @type {Verdict | ""} */ (verdict.value);
    table.take(fitting(index.programs, texts, { text: search.value, verdict: wanted, code: "" }));
  }

  /**
   * Another list.
   * @param {string} name of its folder; empty of files that were dropped
   */
  function begin(name) {
    [index.programs.length, texts, sources, title] = [0, [], [], name];
    toList.hidden = false;
    again.hidden = !name;
    serial += 1;
    return serial;
  }

  /**
   * @param {Row[]} rows
   * @param {(string | File)[]} from
   */
  function add(rows, from) {
    index.programs.push(...rows);
    texts.push(...rows.map(searched));
    sources.push(...from);
    Object.assign(index.titles, ...rows.map((row) => row.titles));
    show();
  }

  /**
   * Take what is known of the folder, and look again while it is being checked.
   * @param {Promise<import("./data.js").Rows>} coming
   * @param {number} mine the list that it is for
   */
  async function follow(coming, mine) {
    const { folder, list, rows, total: all, left_out: left, is_over: isOver } = await coming;
    if (mine !== serial) return;
    if (list !== listNow && index.programs.length) mine = begin(folder); // another tab had the folder looked through
    [total, leftOut, listNow] = [all, left, list];
    add(rows, rows.map((row) => row.number ?? ""));
    const known = index.programs.length;
    if (known < total && !(isOver && !rows.length)) {
      window.setTimeout(() => follow(asked.rows(known, list), mine), rows.length ? 0 : LOOK_MS);
    }
  }

  search.addEventListener("input", show);
  verdict.addEventListener("input", show);
  toList.addEventListener("click", () => showList(!document.body.classList.contains("listing")));
  again.addEventListener("click", () => follow(asked.again(), begin(title)));
  language.onChange(() => {
    offer();
    if (serial) show();
  });

  return {
    /** Show the program that is open. */
    hide() { showList(false); },
    /** List the folder that is open, if one is. */
    async look() {
      const found = await asked.rows(0, 0);
      if (!found.folder) return;
      showList(true);
      await follow(Promise.resolve(found), begin(found.folder));
    },
    /**
     * List files, and check one after the other.
     * @param {File[]} files
     */
    async take(files) {
      const mine = begin("");
      const taken = files.slice(0, MOST);
      [total, leftOut] = [taken.length, files.length - taken.length];
      showList(true);
      show();
      for (const file of taken) {
        const row = await asked.row(file.name, file);
        if (mine !== serial) return;
        add([row], [file]);
      }
    },
  };
}
