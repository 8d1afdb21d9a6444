// Mouse and touch on the picture: a click names a block or a place, a mark is dragged, and what lies under it is told.
import { wirePointer } from "../../replay/assets/pointer.js";

/** @import { wireMeasuring } from "./measuring.js" */
/** @import { View } from "../../replay/assets/view.js" */

/** @typedef {[x: number, y: number]} Place */

/**
 * Who is told.
 * @typedef {object} On
 * @property {(row: number) => void} block told the row of a block that is clicked
 * @property {(place: Place, nearUm: number) => boolean} place told a place that is clicked, and how far off still means it;
 *   whether it is taken, so that no block is
 * @property {(place: Place, nearUm: number) => ((place: Place) => void) | null} mark what moves the mark at a place; null
 *   where there is none
 * @property {(place: Place | null, row: number, nearUm: number) => void} hover told where the pointer is, over which block,
 *   and how far off still means it; −1 over none, null where it has left
 */

/**
 * The picture as pointers need it.
 * @typedef {object} Pointed
 * @property {ReturnType<typeof wireMeasuring>} measuring
 * @property {(place: Place, nearUm: number) => number} rowAt the block at a place, −1 where there is none
 * @property {() => void} moved told that the view has moved
 */

const NEAR = 12; // px from a block that still means it
const STILL = 4; // px of a press that is a click

/**
 * Let pointers act on the picture.
 * @param {HTMLCanvasElement} canvas
 * @param {View} view
 * @param {On & Pointed} on
 */
export function wirePointing(canvas, view, on) {
  /** @type {((place: Place) => void) | null} */
  let drags = null;
  /** @type {Place} */
  let pressed = [0, 0];
  wirePointer(canvas, view, on.moved, () => drags !== null);

  /**
   * Place of an event on the canvas.
   * @param {MouseEvent} event
   * @returns {Place}
   */
  function at(event) {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /**
   * Whether a press has gone so far that it is no click.
   * @param {MouseEvent} event
   */
  function isDrag(event) {
    return Math.hypot(event.clientX - pressed[0], event.clientY - pressed[1]) > STILL;
  }

  canvas.addEventListener("pointerdown", (event) => {
    pressed = [event.clientX, event.clientY];
    const isMark = event.isPrimary && !on.measuring.isOn();
    const [place, nearUm] = [view.placeOf(...at(event)), NEAR / view.scale];
    if (isMark) on.hover(place, on.rowAt(place, nearUm), nearUm); // a finger is seen when it is down
    drags = isMark ? on.mark(place, nearUm) : null;
  });
  for (const name of ["pointerup", "pointercancel"]) canvas.addEventListener(name, () => { drags = null; });
  canvas.addEventListener("click", (event) => {
    if (isDrag(event)) return;
    const [x, y] = at(event);
    const [place, nearUm] = [view.placeOf(x, y), NEAR / view.scale];
    if (on.measuring.isOn()) {
      on.measuring.click(x, y);
    } else if (!on.place(place, nearUm)) {
      const row = on.rowAt(place, nearUm);
      if (row >= 0) on.block(row);
    }
  });
  canvas.addEventListener("pointermove", (event) => {
    const [x, y] = at(event);
    const [place, nearUm] = [view.placeOf(x, y), NEAR / view.scale];
    if (on.measuring.isOn() && !event.buttons) on.measuring.move(x, y);
    if (drags && isDrag(event)) drags(place);
    canvas.style.cursor = drags ? "grabbing" : !event.buttons && on.mark(place, nearUm) ? "grab" : "";
    on.hover(place, on.rowAt(place, nearUm), nearUm);
  });
  canvas.addEventListener("pointerleave", () => on.hover(null, -1, 0));
}
