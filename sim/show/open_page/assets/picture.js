// The picture: the path with its kerf and numbers, what is played of it, the block of the caret's line on top, marks where
// something was found.
import { motionOf } from "../../replay/assets/motion.js";
import { drawBlockMarks } from "./block_marks.js";
import { coloursOf } from "../../replay/assets/palette.js";
import { newView } from "../../replay/assets/view.js";
import { pathOf } from "../../replay/assets/path.js";
import { penOf } from "../../replay/assets/pen.js";
import { differing } from "./differing.js";
import { wireMeasuring } from "./measuring.js";
import { drawEntries, drawPicks, drawStarts } from "./picks.js";
import { planLayer } from "./plan_layer.js";
import { rowAt } from "./snap.js";
import { drawAxes, drawBand, drawPlayed } from "./under_path.js";
import { drawWire } from "../../replay/assets/wire.js";
import { drawScaleBar } from "../../replay/assets/scale_bar.js";
import { wirePointing } from "./pointing.js";

/** @import { Figure, Finding, Path, Planned } from "./data.js" */
/** @import { Curves } from "../../replay/assets/document.js" */
/** @import { Different } from "./differing.js" */
/** @import { Path as Drawn } from "../../replay/assets/path.js" */
/** @import { On } from "./pointing.js" */
/** @import { Shown } from "./playing.js" */

/** @typedef {ReturnType<typeof pictureOf>} Picture */

/**
 * The picture of the page.
 * @param {HTMLCanvasElement} canvas
 * @param {On} on
 */
export function pictureOf(canvas, on) {
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
  const planned = planLayer();
  /** @type {Figure[]} */
  let figures = [];
  /** @type {Finding[]} */
  let findings = [];
  /** @type {[x: number, y: number][]} */
  let picks = [];
  /** @type {[x: number, y: number][]} */
  let starts = [];
  /** @type {[x: number, y: number][]} */
  let entries = [];
  let line = 0;
  let isAsked = false;
  let isFitted = false;
  let isMoved = false; // by the user, since it was fitted
  let reachUm = 0;
  /** @type {Shown | null} */
  let shown = null;
  const colours = coloursOf(later);
  const motion = motionOf(view, later);
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

  /** Be as large as the page makes it; how many px of the canvas a px of the page has. */
  function resize() {
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    if (canvas.width !== Math.round(width * ratio) || canvas.height !== Math.round(height * ratio)) {
      canvas.width = Math.round(width * ratio);
      canvas.height = Math.round(height * ratio);
    }
    view.resize(width, height);
    return ratio;
  }

  /** Draw all of it. */
  function draw() {
    const ratio = resize();
    const isMoving = motion.at(false);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.clearRect(0, 0, view.width, view.height);
    if (drawn || drawing) drawAll(ratio, isMoving);
  }

  /**
   * Draw what there is.
   * @param {number} ratio
   * @param {boolean} isMoving
   */
  function drawAll(ratio, isMoving) {
    if (!isFitted) fit();
    const shades = colours();
    pen.lineCap = "round";
    pen.lineJoin = "round";
    if (drawing) drawDrawing();
    drawAxes(pen, view, shades);
    if (shown?.moment.t) drawPlayed(pen, view, shown, ratio, isMoving);
    else if (drawn) drawBand(pen, view, drawn, 2 * reachUm, shades);
    if (drawn) drawProgram(drawn, shades);
    if (shown?.moment.t) drawWire(pen, view, shown.moment, 0, shown.show.wireUm, colours);
    drawPicks(pen, view, picks, shades.accent);
    drawStarts(pen, view, starts, shades.accent);
    drawEntries(pen, view, entries, shades.accent);
    planned.draw(pen, view, shades);
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
    program.stroke(pen, view, (kind, row) => kind !== "jump" && !path?.is_lead[row]);
    pen.lineWidth = 2;
    pen.strokeStyle = shades.start;
    program.stroke(pen, view, (_, row) => path?.is_lead[row] ?? false);
    pen.lineWidth = 1.5;
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
    if (path) drawBlockMarks(pen, view, path, program, shades);
    drawMarks();
  }

  /** Show all of path and drawing. */
  function fit() {
    const boxes = [drawn, drawing].flatMap((one) => (one ? [one.box()] : []));
    if (!boxes.length) return;
    isFitted = true;
    isMoved = false;
    const box = {
      left: Math.min(...boxes.map((one) => one.left)), bottom: Math.min(...boxes.map((one) => one.bottom)),
      right: Math.max(...boxes.map((one) => one.right)), top: Math.max(...boxes.map((one) => one.top)),
    };
    view.limitTo(box);
    view.fit(box, { top: 40, bottom: 34 });
  }

  /**
   * Tell where the pointer is, once there is something to see.
   * @param {[x: number, y: number] | null} place
   * @param {number} row
   * @param {number} nearUm
   */
  function tellPlace(place, row, nearUm) {
    if (!place || drawn || drawing) on.hover(place, row, nearUm);
  }

  /**
   * The block at a place, −1 where there is none.
   * @param {[x: number, y: number]} place
   * @param {number} nearUm
   */
  function rowUnder(place, nearUm) {
    return path && drawn ? rowAt(path, drawn, place, nearUm) : -1;
  }

  /** Whether something of path or drawing lies beyond the window. */
  function isCut() {
    const bounds = view.bounds();
    return [drawn, drawing].some((one) => {
      const box = one?.box();
      return box && (box.left < bounds.left || box.right > bounds.right || box.bottom < bounds.bottom || box.top > bounds.top);
    });
  }

  wirePointing(canvas, view, { ...on, measuring, rowAt: rowUnder, hover: tellPlace, moved: () => {
    isMoved = true;
    later();
  } });
  new ResizeObserver(() => {
    isFitted = isFitted && isMoved;
    later();
  }).observe(canvas);

  return {
    colours,
    /**
     * Half the width that the wire cuts, µm.
     * @param {number} um
     */
    cutBy(um) {
      reachUm = um;
      later();
    },
    /**
     * Show a moment of what is played; whether a piece falls in it.
     * @param {Shown | null} newShown
     */
    at(newShown) {
      shown = newShown;
      draw();
      return shown?.show.pieces?.isFalling ?? false;
    },
    /**
     * Another path; the window stays where it is unless it is a new program, or what is drawn has left it.
     * @param {Path | null} newPath
     * @param {Figure[]} newFigures
     * @param {boolean} isNew
     */
    show(newPath, newFigures, isNew) {
      isFitted = isFitted && !isNew && path !== null;
      path = newPath;
      drawn = path && pathOf(path);
      measuring.show(path, drawn);
      others = differing(below, path);
      figures = newFigures;
      if (isFitted && !isMoved && isCut()) isFitted = false;
      later();
    },
    /**
     * What is found: each has its mark.
     * @param {Finding[]} newFindings
     */
    mark(newFindings) {
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
    /**
     * Mark what is picked of the drawing, where the wire is to be threaded, and where cuts are to start.
     * @param {[x: number, y: number][]} newPicks
     * @param {[x: number, y: number][]} newStarts
     * @param {[x: number, y: number][]} newEntries
     */
    pick(newPicks, newStarts, newEntries) {
      [picks, starts, entries] = [newPicks, newStarts, newEntries];
      later();
    },
    /**
     * A plan over the drawing; null for none.
     * @param {Planned | null} plan
     */
    plan(plan) {
      planned.set(plan);
      later();
    },
    figureAt: planned.figureAt,
    planned: planned.now,
    /**
     * Give the figure of the plan at a place, µm, the grips.
     * @param {[x: number, y: number]} place
     * @param {number} nearUm
     */
    grip(place, nearUm) {
      if (planned.grip(place, nearUm)) later();
    },
    fit() {
      fit();
      later();
    },
  };
}
