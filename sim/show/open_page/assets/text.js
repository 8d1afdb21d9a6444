// The text of the program: lines with their numbers, the worst finding of each, and changes that can be undone.
import { countUpTo } from "../../replay/assets/numbers.js";
import { SEVERITIES } from "./data.js";
import { element, make } from "../../html/assets/elements.js";

/** @import { Edit, Finding } from "./data.js" */

const LINE = 20; // px, as in the style sheet
const MORE = 4; // lines beyond what shows

/**
 * Where each line begins.
 * @param {string} text
 */
function startsOf(text) {
  const starts = [0];
  for (let at = text.indexOf("\n"); at >= 0; at = text.indexOf("\n", at + 1)) starts.push(at + 1);
  return starts;
}

/**
 * The worst severity of each line that has findings.
 * @param {Finding[]} findings
 */
function worstOf(findings) {
  /** @type {Map<number, number>} */
  const worst = new Map();
  for (const { line, severity } of findings) {
    const rank = SEVERITIES.indexOf(severity);
    worst.set(line, Math.min(rank, worst.get(line) ?? rank));
  }
  return worst;
}

/**
 * The text of the page.
 * @param {HTMLTextAreaElement} area
 * @param {HTMLElement} gutter
 * @param {(line: number) => void} onLine told the line, from 1, that the caret comes to
 */
export function textOf(area, gutter, onLine) {
  const bar = element("#running-line", HTMLElement);
  let running = 0;

  let starts = startsOf("");
  /** @type {Map<number, number>} */
  let worst = new Map();
  let lineNow = 0;

  /** Numbers of the lines that show; others are not there. */
  function number() {
    const first = Math.max(0, Math.floor(area.scrollTop / LINE) - MORE);
    const past = Math.min(starts.length, Math.ceil((area.scrollTop + area.clientHeight) / LINE) + MORE);
    const rows = [];
    for (let line = first + 1; line <= past; line++) {
      const rank = worst.get(line);
      const kind = rank === undefined ? "" : SEVERITIES[rank];
      rows.push(make("div", { className: `${kind}${line === lineNow ? " now" : ""}` }, String(line)));
    }
    gutter.replaceChildren(...rows);
    gutter.style.transform = `translateY(${first * LINE - area.scrollTop}px)`;
    bar.hidden = running === 0;
    bar.style.transform = `translateY(${(running - 1) * LINE - area.scrollTop}px)`;
  }

  /** Tell the line of the caret where it is another one. */
  function tellLine() {
    const line = countUpTo(starts, area.selectionStart);
    if (line === lineNow) return;
    lineNow = line;
    number();
    onLine(line);
  }

  /** The text is another one. */
  function changed() {
    starts = startsOf(area.value);
    number();
  }

  /**
   * Select a stretch and bring it to where it is seen.
   * @param {number} first
   * @param {number} past
   */
  function select(first, past) {
    area.focus({ preventScroll: true });
    area.setSelectionRange(first, past);
    const top = (countUpTo(starts, first) - 1) * LINE;
    if (top < area.scrollTop + LINE || top > area.scrollTop + area.clientHeight - 3 * LINE) {
      area.scrollTop = Math.max(0, top - area.clientHeight / 2);
    }
    tellLine();
    number();
  }

  area.addEventListener("scroll", number, { passive: true });
  area.addEventListener("input", changed);
  for (const event of ["keyup", "click", "input", "focus"]) area.addEventListener(event, tellLine);
  new ResizeObserver(number).observe(area);

  return {
    select,
    get value() { return area.value; },
    /**
     * Another text; the one before it cannot be brought back.
     * @param {string} text
     */
    begin(text) {
      area.value = text;
      area.setSelectionRange(0, 0);
      area.scrollTop = 0;
      lineNow = 0;
      changed();
    },
    /**
     * Mark lines with what was found.
     * @param {Finding[]} findings
     */
    mark(findings) {
      worst = worstOf(findings);
      number();
    },
    /**
     * Mark the line, from 1, whose block is played, and bring it to where it is seen while it plays; 0 for none.
     * @param {number} line
     * @param {boolean} isFollowed
     */
    run(line, isFollowed) {
      if (line === running) return;
      running = line;
      const top = (line - 1) * LINE;
      const isSeen = top >= area.scrollTop && top <= area.scrollTop + area.clientHeight - LINE;
      if (line && isFollowed && !isSeen) area.scrollTop = Math.max(0, top - area.clientHeight / 3);
      number();
    },
    /**
     * Select a line, from 1.
     * @param {number} line
     */
    showLine(line) {
      const first = starts[Math.min(line, starts.length) - 1];
      const end = area.value.indexOf("\n", first);
      select(first, end < 0 ? area.value.length : end);
    },
    /**
     * Make edits as if they were typed, so that the browser can undo them.
     * @param {Edit[]} edits
     */
    edit(edits) {
      const last = [...edits].sort((a, b) => b[0] - a[0]);
      for (const [first, past, text] of last) {
        area.focus({ preventScroll: true });
        area.setSelectionRange(first, past);
        // The only way of typing by a script that undo knows of.
        const isTyped = text ? document.execCommand("insertText", false, text) : document.execCommand("delete");
        if (!isTyped) area.setRangeText(text, first, past, "end");
      }
      changed();
    },
  };
}
