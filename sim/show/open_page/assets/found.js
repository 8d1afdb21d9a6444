// What was found: a list, each with its place, what is to be done, and its mend shown before it is made.
import { pageOf } from "./explained.js";
import { make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Edit, Explained, Finding } from "./data.js" */

/**
 * What is done by a click, and the pages of the codes.
 * @typedef {{ go: (finding: Finding) => void, mend: (finding: Finding) => void, pages: Record<string, Explained> }} On
 */

const MOST = 200;

/**
 * The lines that edits change, before and after.
 * @param {string} text
 * @param {Edit[]} edits
 * @returns {[before: string, after: string]}
 */
export function changed(text, edits) {
  const first = Math.min(...edits.map((edit) => edit[0]));
  const past = Math.max(...edits.map((edit) => edit[1]));
  const from = text.lastIndexOf("\n", first - 1) + 1;
  const end = text.indexOf("\n", past);
  const to = end < 0 ? text.length : end;
  let after = "";
  let at = from;
  for (const [begin, behind, put] of [...edits].sort((a, b) => a[0] - b[0])) {
    after += text.slice(at, begin) + put;
    at = behind;
  }
  return [text.slice(from, to), after + text.slice(at, to)];
}

/**
 * Lines before and after.
 * @param {string} before
 * @param {string} after
 */
export function diffOf(before, after) {
  const shown = [...(before ? [make("del", {}, before)] : []), ...(after ? [make("ins", {}, after)] : [])];
  return make("pre", { className: "diff" }, ...shown.flatMap((part, at) => (at ? ["\n", part] : [part])));
}

/**
 * The entry of a finding.
 * @param {Finding} finding
 * @param {string} text that it was found in
 * @param {On} on
 */
function entryOf(finding, text, on) {
  const places = [finding.line ? language.say("at-line", { line: finding.line }) : language.say("whole")];
  if (finding.block_name) places.push(language.say("in-block", { block: finding.block_name }));
  const go = make("button", { type: "button", className: "go" }, `${places.join(" · ")} · ${finding.code} `);
  go.append(make("strong", {}, language.pick(finding.title)));
  go.addEventListener("click", () => on.go(finding));
  const entry = make("li", { className: finding.severity }, go, make("p", {}, language.pick(finding.message)));
  const hint = language.pick(finding.hint);
  if (hint) entry.append(make("p", { className: "hint" }, hint));
  if (finding.edits.length) {
    const [before, after] = changed(text, finding.edits);
    const mend = make("button", { type: "button" }, language.say("mend"));
    mend.addEventListener("click", () => on.mend(finding));
    entry.append(diffOf(before, after), mend);
  }
  const page = on.pages[finding.code];
  if (page) entry.append(pageOf(page));
  return entry;
}

/**
 * Edits of all certain mends that do not touch each other, in the order of their findings.
 * @param {Finding[]} findings
 */
export function editsOfAll(findings) {
  /** @type {Edit[]} */
  const all = [];
  let mended = 0;
  for (const { edits } of findings) {
    const isFree = edits.every(([first, past]) => all.every(([low, high]) => past < low || first > high));
    if (!edits.length || !isFree) continue;
    all.push(...edits);
    mended += 1;
  }
  return { edits: all, mended };
}

/**
 * Show what was found.
 * @param {HTMLElement} list
 * @param {Finding[]} findings
 * @param {string} text
 * @param {On} on
 */
export function showFound(list, findings, text, on) {
  const rows = findings.slice(0, MOST).map((finding) => entryOf(finding, text, on));
  if (findings.length > MOST) rows.push(make("li", {}, language.say("more", { n: findings.length - MOST })));
  if (!findings.length) rows.push(make("li", { className: "good" }, language.say("nothing-found")));
  list.replaceChildren(...rows);
}
