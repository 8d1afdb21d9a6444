// Puts the page together: its language, what can be asked for, and the table.
import { both, element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { fitting, searched } from "./asked.js";
import { readIndex } from "./data.js";
import { rowOf } from "./rows.js";
import { Table } from "./table.js";

/** @import { Verdict } from "./data.js" */
/** @import { Head } from "./table.js" */

/** @type {Head[]} */
const HEADS = [
  ["picture", null, ""],
  ["file", "file", ""],
  ["verdict", "verdict", ""],
  ["findings", "findings", ""],
  ["time", "time_s", "time-unit"],
  ["worst", "worst_um", ""],
];

const VERDICTS = ["pass", "to-check", "fail", "refused", "fault"];

const index = readIndex();
const texts = index.programs.map(searched);
const search = element("#search", HTMLInputElement);
const verdict = element("#verdict", HTMLSelectElement);
const code = element("#code", HTMLSelectElement);
const shown = element("#shown", HTMLElement);
const table = new Table(index, HEADS, (program) => rowOf(program, index));

/** Fill what can be chosen with the words of the language. */
function offer() {
  const known = VERDICTS.filter((name) => index.programs.some((program) => program.verdict === name));
  fill(verdict, known.map((name) => [name, language.say(name)]));
  fill(code, Object.entries(index.titles).map(([name, title]) => [name, `${name} ${language.pick(title)}`]));
}

/**
 * Options of a choice, the first of them all; what was chosen stays so.
 * @param {HTMLSelectElement} select
 * @param {[value: string, text: string][]} offered
 */
function fill(select, offered) {
  const chosen = select.value;
  const all = make("option", { value: "" }, language.say("any"));
  select.replaceChildren(all, ...offered.map(([value, text]) => make("option", { value }, text)));
  select.value = chosen;
}

/** Show the programs that fit what is asked for. */
function ask() {
  const asked = { text: search.value, verdict: /** @type {Verdict | ""} */ (verdict.value), code: code.value };
  const rows = fitting(index.programs, texts, asked);
  table.take(rows);
  const [n, all] = [rows.length, index.programs.length].map((number) => number.toLocaleString("en-US"));
  shown.replaceChildren(...both(language.said("shown", { n, all })));
}

for (const control of [search, verdict, code]) control.addEventListener("input", ask);
element("form", HTMLElement).addEventListener("submit", (event) => event.preventDefault());
language.onChange(offer);
language.begin();
table.sort("verdict"); // what failed stands first
ask();
