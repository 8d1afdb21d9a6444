// The scrub bar: blocks and passes, pauses, jumps, questions and findings along the time of the run, and the loop.
import { make } from "../../html/assets/elements.js";
import { pick } from "../../html/assets/language.js";
import { isTimed } from "./document.js";
import { penOf } from "./pen.js";
import * as words from "./words.js";

/**
 * @import { Finding, ReplayDocument, TimedFinding } from "./document.js"
 * @import { Colours } from "./palette.js"
 * @import { Loop, Player } from "./player.js"
 */

/** @typedef {{ bar: HTMLElement, marks: HTMLCanvasElement, cursor: HTMLElement, findings: HTMLElement }} Boxes */
/** @typedef {{ onSeek: (t: number) => void, onFinding: (finding: TimedFinding) => void }} Listeners */

const APART = 20; // px between two buttons of findings
const EDGE = 9; // px from the ends of the bar, half a button
const ROOMY = 14; // px: blocks narrower than that have no room for a number
const DENSE = 4; // px: blocks narrower than that are not told apart
const BAND = 18; // px at the foot of the bar: the passes
const WEIGHT = { error: 3, warning: 2, note: 1 };

/**
 * Findings that have a time, gathered where their buttons at `spot(t)` would cover each other.
 * @param {Finding[]} findings
 * @param {(t: number) => number} spot
 */
function gathered(findings, spot) {
  /** @type {TimedFinding[][]} */
  const groups = [];
  for (const finding of findings.filter(isTimed).sort((a, b) => a.t_s - b.t_s)) {
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
 * Timeline in boxes of the page; `onSeek(t)` hears of scrubbing, `onFinding(finding)` of clicks.
 * @param {Boxes} boxes
 * @param {ReplayDocument} doc
 * @param {Player} player
 * @param {Colours} colours
 * @param {Listeners} listeners
 */
export function timelineIn({ bar, marks, cursor, findings: lane }, doc, player, colours, { onSeek, onFinding }) {
  const pen = penOf(marks);
  const { border_s: border, kind } = doc.blocks;
  let width = 1;
  let looped = player.loop;
  /** @param {number} t */
  const toX = (t) => (player.duration ? (Math.min(t, player.duration) / player.duration) * width : 0);
  /** @param {number} t */
  const spot = (t) => Math.min(width - EDGE, Math.max(EDGE, toX(t)));
  /** @param {number} x */
  const toT = (x) => Math.min(1, Math.max(0, x / width)) * player.duration;

  /**
   * Blocks as bands in turn, jumps in their own colour.
   * @param {number} height
   */
  function drawBlocks(height) {
    const shades = colours();
    for (let row = 0; row < kind.length; row++) {
      const [left, right] = [toX(border[row]), toX(border[row + 1])];
      if (right - left < DENSE && kind[row] !== "jump") continue;
      pen.fillStyle = kind[row] === "jump" ? shades.jump : row % 2 ? shades.line : shades.raised;
      pen.fillRect(left, 0, Math.max(1, right - left), height);
    }
    pen.fillStyle = shades["control-line"];
    let last = -DENSE;
    for (let row = 1; row < kind.length; row++) {
      const x = toX(border[row]);
      if (x - last < DENSE) continue;
      pen.fillRect(Math.round(x), 0, 1, height);
      last = x;
    }
  }

  /**
   * Numbers of the blocks that are wide enough.
   * @param {number} height
   */
  function drawNumbers(height) {
    pen.fillStyle = colours().muted;
    pen.font = "12px system-ui, sans-serif";
    pen.textAlign = "center";
    for (let row = 0; row < kind.length; row++) {
      const [left, right] = [toX(border[row]), toX(border[row + 1])];
      if (right - left <= ROOMY) continue;
      const text = doc.blocks.name[row];
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
    for (const { row } of doc.quiz) {
      const x = toX(border[row]);
      pen.beginPath();
      pen.moveTo(x - 5, 0);
      pen.lineTo(x + 5, 0);
      pen.lineTo(x, 8);
      pen.fill();
    }
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
    width = Math.max(1, bar.clientWidth);
    const height = bar.clientHeight;
    marks.width = Math.round(width * ratio);
    marks.height = Math.round(height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    const band = doc.passes.length ? BAND : 0;
    drawBlocks(height - band);
    drawNumbers(height - band);
    drawPasses(height - band, band);
    drawStops(height);
    drawLoop(height);
  }

  /** Buttons of the findings. */
  function placeFindings() {
    lane.replaceChildren(
      ...gathered(doc.findings, spot).map((group) => {
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
    lane.hidden = !lane.childElementCount;
  }

  /** Draw and place everything anew. */
  function redo() {
    draw();
    placeFindings();
  }

  bar.addEventListener("pointerdown", (event) => {
    bar.setPointerCapture(event.pointerId);
    onSeek(toT(event.clientX - bar.getBoundingClientRect().left));
  });
  bar.addEventListener("pointermove", (event) => {
    if (bar.hasPointerCapture(event.pointerId)) onSeek(toT(event.clientX - bar.getBoundingClientRect().left));
  });
  new ResizeObserver(redo).observe(bar);

  return {
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
     * Show a time.
     * @param {number} t
     */
    at(t) {
      cursor.style.transform = `translateX(${toX(t).toFixed(1)}px)`;
    },
  };
}
