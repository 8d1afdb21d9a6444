// The program's text with the running block marked, and a head over each pass: only what shows is in the page.
import { both, elements, make } from "../../html/assets/elements.js";
import { coverOf, covered } from "./cover.js";
import { countUpTo } from "./numbers.js";

/**
 * @import { Cover } from "./cover.js"
 * @import { Blocks, Pass, ReplayDocument } from "./document.js"
 */

/**
 * @typedef {object} Listeners
 * @property {(row: number) => void} onPick
 * @property {(row: number | null, event: PointerEvent) => void} onHover
 */

const ROW = 22; // px, as in replay.css
const SPARE = 6; // lines above and below those that show
const LEFT_ALONE_MS = 4000; // after a reader scrolled, the list follows no block

/**
 * Rows of blocks by line, from 1.
 * @param {Blocks} blocks
 */
function rowsByLine(blocks) {
  /** @type {Map<number, number[]>} */
  const rows = new Map();
  blocks.line.forEach((line, row) => {
    const known = rows.get(line);
    if (known) known.push(row);
    else rows.set(line, [row]);
  });
  return rows;
}

/**
 * Passes that have a head over their first lines: none where two of them share a line, as passes do that the controller
 * makes of one contour.
 * @param {ReplayDocument} doc
 */
function headedPasses({ blocks: { line }, passes }) {
  const areApart = passes.every((pass, at) => !at || line[pass.first_row] > line[passes[at - 1].last_row]);
  return areApart ? passes : [];
}

/**
 * The head of a pass, which stands over its first line.
 * @param {Pass} pass
 */
function headOf({ name, paint }) {
  const made = make("span", { className: "pass-head" }, ...both(name));
  made.style.setProperty("--tone", `var(--${paint})`);
  return made;
}

/**
 * List of the program in `box`; the listeners hear of rows of blocks.
 * @param {HTMLElement} box
 * @param {ReplayDocument} doc
 * @param {Listeners} listeners
 */
export function programIn(box, doc, { onPick, onHover }) {
  const { blocks, program: { lines } } = doc;
  const rows = rowsByLine(blocks);
  const headed = headedPasses(doc);
  const underHeads = headed.map((pass) => blocks.line[pass.first_row]);
  const inner = make("div", { className: "lines" });
  /** @type {Map<number, HTMLElement>} */
  const shown = new Map(); // line number to its element
  let running = 0;
  let scrolledAt = -Infinity;
  let isOwnScroll = false;
  /** @type {Cover | null} */
  let cover = null;
  inner.style.height = `${(lines.length + headed.length) * ROW}px`;
  box.append(inner);

  /**
   * How far down a line stands, px.
   * @param {number} line
   */
  const topOf = (line) => (line - 1 + countUpTo(underHeads, line)) * ROW;

  /**
   * The last line that stands no farther down, or 0.
   * @param {number} top
   */
  function lineAt(top) {
    let [low, high] = [0, lines.length];
    while (low < high) {
      const middle = (low + high + 1) >> 1;
      if (topOf(middle) <= top) low = middle;
      else high = middle - 1;
    }
    return low;
  }

  /**
   * Show a line anew, where it is shown.
   * @param {number} line
   */
  function rebuild(line) {
    const made = shown.get(line);
    if (!made) return;
    made.remove();
    shown.delete(line);
    build(line);
  }

  /**
   * Texts of a line: blocks, and what stands between them.
   * @param {number} line
   */
  function pieces(line) {
    const text = covered(lines[line - 1], line === cover?.line ? cover.spans : []);
    /** @type {Node[]} */
    const parts = [];
    let past = 0;
    let last = -1;
    for (const row of rows.get(line) || []) {
      if (blocks.character[row] === last) continue; // a row that the controller added to that block
      last = blocks.character[row];
      if (last > past) parts.push(document.createTextNode(text.slice(past, last)));
      past = Math.max(past, last + blocks.characters[row]);
      const block = make("span", { className: "block" }, text.slice(last, past));
      block.dataset.row = String(row);
      parts.push(block);
    }
    return [...parts, document.createTextNode(text.slice(past))];
  }

  /**
   * Mark the running block in its line.
   * @param {number} line
   */
  function mark(line) {
    const made = shown.get(line);
    if (!made) return;
    const isRunning = line === blocks.line[running];
    made.classList.toggle("running", isRunning);
    made.setAttribute("aria-selected", String(isRunning));
    if (isRunning) box.setAttribute("aria-activedescendant", made.id);
    for (const block of elements(".block", made)) {
      const isIt = isRunning && blocks.character[Number(block.dataset.row)] === blocks.character[running];
      block.classList.toggle("now", isIt);
    }
  }

  /**
   * The element of a line.
   * @param {number} line
   */
  function build(line) {
    const number = make("span", { className: "number" }, String(line));
    const over = headed.slice(countUpTo(underHeads, line - 1), countUpTo(underHeads, line));
    const heads = over.map(headOf);
    const made = make("div", { className: "line", id: `line-${line}` }, ...heads, number, ...pieces(line));
    made.setAttribute("role", "option");
    made.setAttribute("aria-setsize", String(lines.length));
    made.setAttribute("aria-posinset", String(line));
    made.style.transform = `translateY(${topOf(line)}px)`;
    const [first] = rows.get(line) ?? [];
    if (first !== undefined) made.dataset.row = String(first);
    inner.append(made);
    shown.set(line, made);
    mark(line);
  }

  /** Have the lines in the page that show, and no others. */
  function show() {
    const first = Math.max(1, lineAt(box.scrollTop) - SPARE);
    const last = Math.min(lines.length, lineAt(box.scrollTop + box.clientHeight) + SPARE);
    for (const [line, made] of shown) {
      if (line >= first && line <= last) continue;
      made.remove();
      shown.delete(line);
    }
    for (let line = first; line <= last; line++) if (!shown.has(line)) build(line);
  }

  /** Scroll so that the running line is well within the list. */
  function follow() {
    if (performance.now() - scrolledAt < LEFT_ALONE_MS) return;
    const top = topOf(blocks.line[running]);
    if (top >= box.scrollTop + ROW && top <= box.scrollTop + box.clientHeight - 2 * ROW) return;
    isOwnScroll = true;
    box.scrollTop = top - box.clientHeight / 2;
  }

  /**
   * Row of the block under a pointer, or null.
   * @param {MouseEvent} event
   */
  function rowAt(event) {
    const on = event.target instanceof Element ? event.target.closest("[data-row]") : null;
    return on ? Number(on.getAttribute("data-row")) : null;
  }

  box.addEventListener("scroll", () => {
    if (!isOwnScroll) scrolledAt = performance.now();
    isOwnScroll = false;
    show();
  });
  box.addEventListener("click", (event) => {
    const row = rowAt(event);
    if (row !== null) onPick(row);
  });
  box.addEventListener("pointermove", (event) => {
    if (event.pointerType === "mouse") onHover(rowAt(event), event);
  });
  box.addEventListener("pointerleave", (event) => onHover(null, event));
  new ResizeObserver(() => {
    follow();
    show();
  }).observe(box);

  return {
    /**
     * Mark the block that runs, and bring it into view.
     * @param {number} row
     */
    run(row) {
      if (row === running && shown.size) return;
      const before = running;
      running = row;
      follow();
      show();
      mark(blocks.line[before]);
      mark(blocks.line[row]);
    },
    /**
     * Cover parts of the text of a block, counted from its first character; of none where there is no row.
     * @param {number | null} row
     * @param {[number, number][]} spans
     */
    hide(row, spans) {
      const before = cover?.line;
      cover = row === null ? null : coverOf(blocks, row, spans);
      for (const line of [before, cover?.line]) if (line !== undefined) rebuild(line);
    },
  };
}
