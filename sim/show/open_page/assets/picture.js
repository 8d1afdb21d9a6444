// The path: drawn whole, moved and zoomed, the block of the caret's line on top, marks where something was found.
import { coloursOf } from "../../replay/assets/palette.js";
import { newView } from "../../replay/assets/view.js";
import { pathOf } from "../../replay/assets/path.js";
import { penOf } from "../../replay/assets/pen.js";
import { differing } from "./differing.js";
import { wireMeasuring } from "./measuring.js";
import { rowAt } from "./snap.js";
import { drawScaleBar } from "../../replay/assets/scale_bar.js";
import { wirePointer } from "../../replay/assets/pointer.js";

/** @import { Figure, Finding, Path } from "./data.js" */
/** @import { Curves } from "../../replay/assets/document.js" */
/** @import { Different } from "./differing.js" */
/** @import { Path as Drawn } from "../../replay/assets/path.js" */

const NEAR = 12; // px from a block that still means it
const STILL = 4; // px of a press that is a click

/**
 * The picture of the page.
 * @param {HTMLCanvasElement} canvas
 * @param {(row: number) => void} onBlock told the row of a block that is clicked
 */
export function pictureOf(canvas, onBlock) {
  const pen = penOf(canvas);
  const view = newView();
  /** @type {Path | null} */
  let path = null;
  let drawn = /** @type {ReturnType<typeof pathOf> | null} */ (null);
  /** @type {Path | null} */
  let below = null;
  let others = differing(null, null);
  /** @type {ReturnType<typeof pathOf> | null} */
  let drawing = null;
  /** @type {Figure[]} */
  let figures = [];
  /** @type {Finding[]} */
  let findings = [];
  let line = 0;
  let isAsked = false;
  let isFitted = false;
  const colours = coloursOf(later);
  const measuring = wireMeasuring(view, later);

  /** Draw before the next frame. */
  function later() {
    if (isAsked) return;
    isAsked = true;
    requestAnimationFrame(() => {
      isAsked = false;
      draw();
    });
  }

  /** Rows of the blocks that stand in the line of the caret. */
  function rowsNow() {
    return path ? path.line.flatMap((of, row) => (of === line ? [row] : [])) : [];
  }

  /**
   * A ring, or a cross, about a place.
   * @param {number} x
   * @param {number} y
   * @param {number} radius
   */
  function ring(x, y, radius) {
    pen.beginPath();
    pen.arc(view.toX(x), view.toY(y), radius, 0, 2 * Math.PI);
    pen.stroke();
  }

  /**
   * Blocks that the other version has not.
   * @param {Different} different
   * @param {string} shade
   * @param {number} width
   */
  function drawRows(different, shade, width) {
    pen.lineWidth = width;
    pen.strokeStyle = getComputedStyle(canvas).getPropertyValue(shade);
    pen.beginPath();
    for (const row of different.rows) different.drawn.wayOf(pen, view, row);
    pen.stroke();
  }

  /** Where the wire is threaded, and where something is found. */
  function drawMarks() {
    const shades = colours();
    pen.lineWidth = 2;
    pen.strokeStyle = shades.start;
    for (const { thread_um: [x, y] } of figures) ring(x, y, 5);
    if (!path) return;
    const style = getComputedStyle(canvas);
    for (const { block, severity } of findings) {
      if (!block || severity === "note") continue;
      pen.strokeStyle = style.getPropertyValue(`--${severity}`);
      ring(path.place_x_um[block], path.place_y_um[block], 8);
    }
  }

  function draw() {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    view.resize(width, height);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, width, height);
    if (!drawn && !drawing) return;
    if (!isFitted) fit();
    const shades = colours();
    pen.lineCap = "round";
    pen.lineJoin = "round";
    if (drawing) drawDrawing();
    if (drawn) drawProgram(drawn, shades);
    measuring.draw(pen, shades.accent);
    drawScaleBar(pen, view, colours);
  }

  /** The drawing, broad and pale, under all else. */
  function drawDrawing() {
    pen.lineWidth = 5;
    pen.strokeStyle = getComputedStyle(canvas).getPropertyValue("--drawn");
    drawing?.stroke(pen, view, (kind) => kind !== "jump");
  }

  /**
   * The path with what differs from another version, the caret's block and the marks.
   * @param {Drawn} program
   * @param {Record<string, string>} shades
   */
  function drawProgram(program, shades) {
    if (others.below) drawRows(others.below, "--error", 3);
    pen.lineWidth = 1.5;
    pen.strokeStyle = shades.ideal;
    program.stroke(pen, view, (kind) => kind !== "jump");
    pen.strokeStyle = shades.jump;
    pen.setLineDash([6, 4]);
    program.stroke(pen, view, (kind) => kind === "jump");
    pen.setLineDash([]);
    if (others.above) drawRows(others.above, "--good", 2.5);
    pen.lineWidth = 4;
    pen.strokeStyle = shades.accent;
    pen.beginPath();
    for (const row of rowsNow()) program.wayOf(pen, view, row);
    pen.stroke();
    drawMarks();
  }

  /** Show all of path and drawing. */
  function fit() {
    const boxes = [drawn, drawing].flatMap((one) => (one ? [one.box()] : []));
    if (!boxes.length) return;
    isFitted = true;
    const box = {
      left: Math.min(...boxes.map((one) => one.left)), bottom: Math.min(...boxes.map((one) => one.bottom)),
      right: Math.max(...boxes.map((one) => one.right)), top: Math.max(...boxes.map((one) => one.top)),
    };
    view.limitTo(box);
    view.fit(box, { top: 0, bottom: 30 });
  }

  wirePointer(canvas, view, later);
  /** @type {[x: number, y: number]} */
  let pressed = [0, 0];
  canvas.addEventListener("pointerdown", (event) => { pressed = [event.clientX, event.clientY]; });
  canvas.addEventListener("click", (event) => {
    if (Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > STILL) return;
    const box = canvas.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    if (measuring.isOn()) {
      measuring.click(x, y);
      return;
    }
    const row = path && drawn ? rowAt(path, drawn, view.placeOf(x, y), NEAR / view.scale) : -1;
    if (row >= 0) onBlock(row);
  });
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect();
    if (measuring.isOn() && !event.buttons) measuring.move(event.clientX - box.left, event.clientY - box.top);
  });
  new ResizeObserver(later).observe(canvas);

  return {
    /**
     * Another path; the window stays where it is unless it is a new program.
     * @param {Path | null} newPath
     * @param {Figure[]} newFigures
     * @param {Finding[]} newFindings
     * @param {boolean} isNew
     */
    show(newPath, newFigures, newFindings, isNew) {
      isFitted = isFitted && !isNew && path !== null;
      path = newPath;
      drawn = path && pathOf(path);
      measuring.show(path, drawn);
      others = differing(below, path);
      figures = newFigures;
      findings = newFindings;
      later();
    },
    /**
     * The line, from 1, whose blocks stand out.
     * @param {number} newLine
     */
    markLine(newLine) {
      line = newLine;
      later();
    },
    /**
     * The path of another version, of which what differs is shown under this one; null for none.
     * @param {Path | null} newBelow
     */
    under(newBelow) {
      below = newBelow;
      others = differing(below, path);
      later();
    },
    /**
     * The curves of a drawing under all else; null for none.
     * @param {Curves | null} curves
     */
    beneath(curves) {
      drawing = curves && pathOf(curves);
      isFitted = false;
      later();
    },
    fit() {
      fit();
      later();
    },
  };
}
