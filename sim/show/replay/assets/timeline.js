// The scrub bar: blocks and passes, pauses, jumps, questions and findings along the time of the run, and the loop.
import { pick } from "../../html/assets/language.js";
import { placeFindings } from "./finding_marks.js";
import { groupsIn } from "./groups.js";
import { penOf } from "./pen.js";
import { drawQuestion } from "./question_mark.js";
import { spanOf } from "./span.js";
import * as words from "./words.js";

/**
 * @import { Blocks, ReplayDocument, TimedFinding } from "./document.js"
 * @import { Titled } from "./words.js"
 * @import { Group } from "./groups.js"
 * @import { Colours } from "./palette.js"
 * @import { Loop, Player } from "./player.js"
 */

/** @typedef {Pick<ReplayDocument, "findings" | "passes" | "stops"> & { blocks: Titled & Pick<Blocks, "border_s"> }} Lined What the line shows. */
/** @typedef {{ bar: HTMLElement, marks: HTMLCanvasElement, cursor: HTMLElement, findings: HTMLElement, whole: HTMLElement }} Boxes */
/**
 * @typedef {object} Listeners
 * @property {(t: number) => void} onSeek
 * @property {(row: number) => void} onBlock
 * @property {(finding: TimedFinding) => void} onFinding
 */

const ROOMY = 14; // px: blocks narrower than that have no room for a number
const BAND = 18; // px at the foot of the bar: the passes
const STILL = 3; // px: a pointer that goes no farther clicks, and does not drag
const PER_NOTCH = 1.0015; // zoom of a px of wheel

/** @param {Group} group */
const holdsMany = ({ first, past }) => past - first > 1;

/**
 * Timeline in boxes of the page; `onSeek(t)` hears of scrubbing, `onBlock(row)` of a click on a group of
 * blocks, `onFinding(finding)` of one on a finding.
 * @param {Boxes} boxes
 * @param {Lined} doc
 * @param {Player} player
 * @param {Colours} colours
 * @param {Listeners} listeners
 */
export function timelineIn({ bar, marks, cursor, findings: lane, whole }, doc, player, colours, listeners) {
  const { onSeek, onBlock, onFinding } = listeners;
  const pen = penOf(marks);
  const { border_s: border, kind } = doc.blocks;
  const span = spanOf(player.duration);
  const { toX } = span;
  /** @type {Group[]} */
  let groups = [];
  let looped = player.loop;
  let shownAt = 0;
  /** @type {number[]} */
  let asked = []; // rows before which the quiz asks
  let pressedAt = 0;
  /** @param {Group} group */
  const titleOf = (group) => (holdsMany(group) ? words.group : words.block)(doc.blocks, group.first, group.past);

  /**
   * The block or group of blocks under a pointer, if any.
   * @param {MouseEvent} event
   */
  function groupUnder(event) {
    const x = event.clientX - bar.getBoundingClientRect().left;
    return groups.find(({ left, right }) => x >= left && x < right);
  }

  /**
   * Blocks and groups of them as bands in turn, jumps in their own colour.
   * @param {number} height
   */
  function drawBlocks(height) {
    const shades = colours();
    groups.forEach(({ first, past, left, right }, at) => {
      const isJump = past - first === 1 && kind[first] === "jump";
      pen.fillStyle = isJump ? shades.jump : at % 2 ? shades.line : shades.raised;
      pen.fillRect(left, 0, Math.max(1, right - left), height);
    });
    pen.fillStyle = shades.jump;
    for (const { first, past } of groups) {
      for (let row = first; row < past; row++) if (kind[row] === "jump") pen.fillRect(toX(border[row]), 0, 1, height);
    }
    pen.fillStyle = shades["control-line"];
    for (const { left } of groups) pen.fillRect(Math.round(left), 0, 1, height);
  }

  /**
   * Numbers of the blocks, and how many there are in a group, where they have room.
   * @param {number} height
   */
  function drawNumbers(height) {
    pen.fillStyle = colours().muted;
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "center";
    for (const { first, past, left, right } of groups) {
      if (right - left <= ROOMY) continue;
      const text = past - first > 1 ? words.groupSize(past - first) : doc.blocks.name[first];
      if (right - left > pen.measureText(text).width + 8) pen.fillText(text, (left + right) / 2, height / 2 + 4);
    }
  }

  /**
   * Passes over edges as bands at the foot of the bar, with as much of their names as they have room for.
   * @param {number} top
   * @param {number} height
   */
  function drawPasses(top, height) {
    const shades = colours();
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "center";
    for (const { first_row: first, last_row: last, number, paint, name } of doc.passes) {
      const [left, right] = [toX(border[first]), toX(border[last + 1])];
      pen.fillStyle = shades[paint];
      pen.fillRect(left, top, Math.max(1, right - left), height);
      const text = [pick(name), String(number)].find((one) => pen.measureText(one).width + 8 < right - left);
      pen.fillStyle = shades.ink;
      if (text) pen.fillText(text, (left + right) / 2, top + height / 2 + 4);
    }
  }

  /**
   * Upright marks: pauses, and a question as a small square.
   * @param {number} height
   */
  function drawStops(height) {
    const shades = colours();
    pen.fillStyle = shades.end;
    for (const stop of doc.stops) pen.fillRect(Math.round(toX(border[stop.after])) - 1, 0, 3, height);
    pen.fillStyle = shades.accent;
    for (const row of asked) drawQuestion(pen, toX(border[row]));
  }

  /**
   * The stretch that the replay goes round.
   * @param {number} height
   */
  function drawLoop(height) {
    const { from, to, isOn } = looped;
    pen.fillStyle = colours().good;
    if (from !== null && to !== null) {
      pen.globalAlpha = isOn ? 0.4 : 0.2;
      pen.fillRect(toX(from), 0, Math.max(2, toX(to) - toX(from)), height);
      pen.globalAlpha = 1;
    }
    for (const end of [from, to]) if (end !== null) pen.fillRect(toX(end) - 1.5, 0, 3, height);
  }

  /** Draw the bar. */
  function draw() {
    const ratio = window.devicePixelRatio || 1;
    span.width = Math.max(1, bar.clientWidth);
    groups = groupsIn(border, span);
    const height = bar.clientHeight;
    marks.width = Math.round(span.width * ratio);
    marks.height = Math.round(height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const band = doc.passes.length ? BAND : 0;
    drawBlocks(height - band);
    drawNumbers(height - band);
    drawPasses(height - band, band);
    drawStops(height);
    drawLoop(height);
  }

  /** Put the cursor where its time is. */
  function placeCursor() {
    cursor.style.transform = `translateX(${toX(shownAt).toFixed(1)}px)`;
  }

  /** Draw and place everything anew. */
  function redo() {
    draw();
    placeFindings(lane, doc.findings, span, onFinding);
    placeCursor();
    whole.hidden = span.isWhole;
  }

  /**
   * Time under a pointer.
   * @param {MouseEvent} event
   */
  const timeUnder = (event) => span.toT(event.clientX - bar.getBoundingClientRect().left);

  bar.addEventListener("pointerdown", (event) => {
    bar.setPointerCapture(event.pointerId);
    pressedAt = event.clientX;
    onSeek(timeUnder(event));
  });
  bar.addEventListener("pointermove", (event) => {
    if (bar.hasPointerCapture(event.pointerId)) onSeek(timeUnder(event));
    const group = groupUnder(event);
    bar.title = group ? titleOf(group) : "";
  });
  bar.addEventListener("click", (event) => {
    const group = groupUnder(event);
    if (group && holdsMany(group) && Math.abs(event.clientX - pressedAt) <= STILL) onBlock(group.first);
  });
  bar.addEventListener("dblclick", (event) => {
    const group = groupUnder(event);
    if (!group || !holdsMany(group)) return;
    span.show(border[group.first], border[group.past]);
    redo();
  });
  bar.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const x = event.clientX - bar.getBoundingClientRect().left;
      span.zoomAt(x, PER_NOTCH ** -(event.deltaY * (event.deltaMode ? 33 : 1)));
      redo();
    },
    { passive: false },
  );
  whole.addEventListener("click", () => {
    span.whole();
    redo();
  });
  new ResizeObserver(redo).observe(bar);

  return {
    /**
     * Mark where the quiz asks.
     * @param {number[]} rows
     */
    ask(rows) {
      if (rows.join() === asked.join()) return;
      asked = rows;
      draw();
    },
    redo,
    /**
     * Show a loop, where it is another one.
     * @param {Loop} newLoop
     */
    loop(newLoop) {
      if (newLoop === looped) return;
      looped = newLoop;
      draw();
    },
    /**
     * Show a time, and the part of the run about it.
     * @param {number} t
     */
    at(t) {
      shownAt = t;
      if (span.bring(t)) redo();
      else placeCursor();
    },
  };
}
