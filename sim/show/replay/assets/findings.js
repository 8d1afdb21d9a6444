// The findings of the run as a list; one that is about a block leads there.
import { make } from "../../html/assets/elements.js";
import { say } from "../../html/assets/language.js";
import { isTimed } from "./document.js";
import * as words from "./words.js";

/** @import { Finding, ReplayDocument, TimedFinding } from "./document.js" */

/**
 * Where a finding is.
 * @param {Finding} finding
 */
function where(finding) {
  const places = [];
  if (finding.block_name) places.push(say("in_block", { block: finding.block_name }));
  if (finding.line) places.push(say("in_line", { line: finding.line }));
  return places.join(", ");
}

/**
 * One finding: a button where it leads to a block.
 * @param {Finding} finding
 * @param {(finding: TimedFinding) => void} onPick
 */
function entry(finding, onPick) {
  const texts = words.finding(finding);
  const className = `finding ${finding.severity}`;
  const parts = [
    make("strong", {}, `${finding.code} ${texts.title}`),
    make("span", { className: "where" }, where(finding)),
    make("span", { className: "message" }, texts.message),
    make("span", { className: "hint" }, texts.hint),
  ];
  if (!isTimed(finding)) return make("div", { className }, ...parts);
  const button = make("button", { className, type: "button" }, ...parts);
  button.addEventListener("click", () => onPick(finding));
  return button;
}

/**
 * List of the findings in `box`.
 * @param {HTMLElement} box
 * @param {ReplayDocument} doc
 * @param {(finding: TimedFinding) => void} onPick
 */
export function findingsIn(box, doc, onPick) {
  /** Write the list in the language of the page. */
  function write() {
    const none = make("p", { className: "none" }, say("nothing_found"));
    const items = doc.findings.map((finding) => make("li", {}, entry(finding, onPick)));
    box.replaceChildren(items.length ? make("ul", {}, ...items) : none);
  }
  write();
  return { write };
}
