// The table on its canvas: everything that is drawn, in order, for one moment of the replay.
import { elements } from "../../html/assets/elements.js";
import { kerfOf } from "./kerf.js";
import { microOf } from "./micro.js";
import { motionOf } from "./motion.js";
import { countUpTo } from "./numbers.js";
import { coloursOf } from "./palette.js";
import { passOfRows } from "./passes.js";
import { pathOf } from "./path.js";
import { penOf } from "./pen.js";
import { piecesOf } from "./pieces.js";
import { drawScaleBar } from "./scale_bar.js";
import { sceneOf } from "./scene.js";
import { newView } from "./view.js";
import { deviationPlate, drawWire } from "./wire.js";

/**
 * @import { Replay } from "./decode.js"
 * @import { Place } from "./document.js"
 * @import { Room } from "./free_room.js"
 * @import { Cut, WidthOf } from "./kerf.js"
 * @import { Model } from "./model.js"
 * @import { PageState } from "./page_state.js"
 * @import { Moment } from "./player.js"
 * @import { Box } from "./view.js"
 */

/** @typedef {ReturnType<typeof stageOn>} Stage */

const LEAST_MARGIN = 12; // px
const PAPER_RATIO = 4; // px of the canvas in a px of the page: 384 in an inch
const STEPS_SCALE = 48; // px per µm when looking at single steps

/**
 * The colour in which the wire cut on its way to each sample, that of its pass; null in a jump.
 * @param {Replay} replay
 * @returns {Cut[]}
 */
export function cutSamples({ doc, samples }) {
  const { border_s: border, kind } = doc.blocks;
  const passes = passOfRows(doc);
  let row = 0;
  return Array.from(samples.t, (t) => {
    while (row + 1 < kind.length && t > border[row + 1]) row++;
    return kind[row] === "jump" ? null : (passes[row]?.paint ?? "kerf");
  });
}

/**
 * How wide the wire cut on its way to each sample: as the technology has the pass, else the same everywhere.
 * @param {Replay} replay
 * @returns {WidthOf}
 */
export function widthSamples({ doc, samples }) {
  const { border_s: border, reach_um: reach } = doc.blocks;
  const usual = 2 * doc.offset_um;
  if (!reach) return () => usual;
  let row = 0;
  const widths = Array.from(samples.t, (t) => {
    while (row + 1 < reach.length && t > border[row + 1]) row++;
    return 2 * reach[row];
  });
  return (at) => widths[at] ?? usual;
}

/**
 * Stage of a replay on a canvas; `onNeed` asks for a frame.
 * @param {HTMLCanvasElement} canvas
 * @param {Replay} replay
 * @param {Model} model
 * @param {() => void} onNeed
 */
export function stageOn(canvas, replay, model, onNeed) {
  const { doc } = replay;
  const pen = penOf(canvas, { alpha: false });
  const view = newView();
  const colours = coloursOf(spoil);
  const path = pathOf(doc.blocks);
  const shown = [path, ...doc.faces.map(pathOf)];
  const scene = sceneOf(doc, path, colours);
  const pieces = piecesOf(doc, colours);
  const kerf = kerfOf(replay.samples, cutSamples(replay), widthSamples(replay), colours);
  const micro = microOf(replay, model, colours);
  const motion = motionOf(view, () => !(kerf.isTrue && pieces.isTrue && scene.isTrue) && onNeed());
  const isCalm = window.matchMedia("(prefers-reduced-motion: reduce)");
  let ratio = 1;
  let isPaper = false;
  /** @type {number | null} */
  let outlined = null;
  /** @type {{ box: Box, scale: number, center: Place } | null} */
  let fitted = null; // as the view was fitted last

  /** Draw everything anew in the next frame. */
  function spoil() {
    scene.spoil();
    pieces.spoil();
    kerf.spoil();
    onNeed();
  }

  /** Box of all paths with their kerf. */
  function whole() {
    const boxes = shown.map((each) => each.box());
    const width = Math.max(doc.offset_um, 1);
    return {
      left: Math.min(...boxes.map(({ left }) => left)) - width,
      right: Math.max(...boxes.map(({ right }) => right)) + width,
      bottom: Math.min(...boxes.map(({ bottom }) => bottom)) - width,
      top: Math.max(...boxes.map(({ top }) => top)) + width,
    };
  }

  /**
   * What of the page lies over the canvas: boxes of left, top, right, bottom in px of it.
   * @returns {Room[]}
   */
  function covered() {
    const own = canvas.getBoundingClientRect();
    return elements("[data-over]").map((over) => {
      const box = over.getBoundingClientRect();
      return [box.left - own.left, box.top - own.top, box.right - own.left, box.bottom - own.top];
    });
  }

  /**
   * Show all of a box clear of what lies over the canvas at its top and bottom.
   * @param {Box} box
   */
  function fit(box) {
    const [tools, legend] = covered();
    view.fit(box, { top: Math.max(tools[3], LEAST_MARGIN), bottom: view.height - legend[1] });
    fitted = { box, scale: view.scale, center: view.center };
  }

  /** Box that the view was fitted to and still shows, if nobody has moved it since. */
  function stillFitted() {
    if (!fitted) return whole();
    const { box, scale, center } = fitted;
    return view.scale === scale && view.center.every((along, axis) => along === center[axis]) ? box : null;
  }

  /** Be as large as the page makes it. */
  function resize() {
    const still = stillFitted();
    ratio = isPaper ? PAPER_RATIO : window.devicePixelRatio || 1;
    view.resize(canvas.clientWidth, canvas.clientHeight);
    canvas.width = Math.round(view.width * ratio);
    canvas.height = Math.round(view.height * ratio);
    view.limitTo(scene.travel);
    if (still) fit(still);
    onNeed();
  }

  /** The block under the pointer, or in the text: a broad band along it. */
  function drawOutlined() {
    if (outlined === null) return;
    pen.beginPath();
    path.wayOf(pen, view, outlined);
    pen.strokeStyle = colours().accent;
    pen.globalAlpha = 0.75;
    pen.lineWidth = 5;
    pen.lineCap = "round";
    pen.stroke();
    pen.globalAlpha = 1;
  }

  new ResizeObserver(resize).observe(canvas);
  resize();

  return {
    view,
    colours,
    get isFalling() { return pieces.isFalling; },
    /**
     * Be as fine as paper is, and in its colours; or as a screen again.
     * @param {boolean} toPaper
     */
    print(toPaper) {
      isPaper = toPaper;
      spoil();
      resize();
    },
    fit: () => fit(whole()),
    fitTable: () => fit(scene.travel),
    /**
     * Look at single steps about a place.
     * @param {number} x
     * @param {number} y
     */
    toSteps: (x, y) => view.lookAt(x, y, STEPS_SCALE),
    /** @param {number | null} row */
    outline(row) {
      outlined = row;
      onNeed();
    },
    /**
     * Draw a moment, deviations `times` as large; `isPlaying` lets pieces fall.
     * @param {Moment} moment
     * @param {PageState} page
     * @param {boolean} isPlaying
     * @param {number} now
     */
    draw(moment, { times, isFollowing }, isPlaying, now) {
      const isMoving = motion.at(isFollowing);
      pen.setTransform(ratio, 0, 0, ratio, 0, 0);
      pen.fillStyle = colours().page;
      pen.fillRect(0, 0, view.width, view.height);
      scene.drawGround(pen, view);
      kerf.draw(pen, view, ratio, isMoving, Math.max(0, countUpTo(replay.samples.t, moment.t) - 1), moment.wire);
      pieces.draw(pen, view, { ratio, isMoving, t: moment.t, now, mayFall: isPlaying && !isCalm.matches });
      scene.drawIdeal(pen, view, ratio, isMoving);
      drawOutlined();
      const plate = deviationPlate(pen, view, moment, times);
      if (micro.shows(view.scale)) micro.draw(pen, view, moment, [...covered(), ...(plate ? [plate.box] : [])]);
      drawWire(pen, view, moment, times, doc.wire_diameter_um, colours);
      drawScaleBar(pen, view, colours);
    },
  };
}
