// Buttons of findings over the time line, gathered where they would cover each other.
import { make } from "../../html/assets/elements.js";
import { isTimed } from "./document.js";
import { clamp } from "./numbers.js";
import * as words from "./words.js";

/**
 * @import { Finding, TimedFinding } from "./document.js"
 * @import { Span } from "./span.js"
 */

const APART = 20; // px between two buttons
const EDGE = 9; // px from the ends of the bar, half a button
const WEIGHT = { error: 3, warning: 2, note: 1 };

/**
 * Findings that have a time in a span, gathered where their buttons at `spot(t)` would cover each other.
 * @param {Finding[]} findings
 * @param {Span} span
 * @param {(t: number) => number} spot
 */
function gathered(findings, span, spot) {
  /** @type {TimedFinding[][]} */
  const groups = [];
  const shown = findings.filter(isTimed).filter(({ t_s: t }) => span.isWhole || (t >= span.since && t <= span.until));
  for (const finding of shown.sort((a, b) => a.t_s - b.t_s)) {
    const last = groups[groups.length - 1];
    if (last && spot(finding.t_s) - spot(last[0].t_s) < APART) last.push(finding);
    else groups.push([finding]);
  }
  return groups;
}

/**
 * Codes and titles of some findings, each once, with how often it is there.
 * @param {Finding[]} findings
 */
function namesOf(findings) {
  const counts = new Map();
  for (const finding of findings) {
    const name = `${finding.code} ${words.finding(finding).title}`;
    counts.set(name, (counts.get(name) || 0) + 1);
  }
  return [...counts].map(([name, count]) => (count > 1 ? `${name} ×${count}` : name)).join("; ");
}

/**
 * Put the buttons into their lane; `onFinding(finding)` hears of clicks.
 * @param {HTMLElement} lane
 * @param {Finding[]} findings
 * @param {Span} span
 * @param {(finding: TimedFinding) => void} onFinding
 */
export function placeFindings(lane, findings, span, onFinding) {
  /** @param {number} t */
  const spot = (t) => clamp(span.toX(t), EDGE, span.width - EDGE);
  lane.replaceChildren(
    ...gathered(findings, span, spot).map((group) => {
      const worst = group.reduce((a, b) => (WEIGHT[b.severity] > WEIGHT[a.severity] ? b : a));
      const title = namesOf(group);
      const count = group.length > 1 ? String(group.length) : "!";
      const button = make("button", { className: `mark ${worst.severity}`, type: "button", title }, count);
      button.setAttribute("aria-label", title);
      button.style.left = `${spot(group[0].t_s)}px`;
      button.addEventListener("click", () => onFinding(worst));
      return button;
    }),
  );
  lane.hidden = !findings.some(isTimed);
}
