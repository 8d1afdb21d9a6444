// What of the plane shows on the canvas: centre in µm, scale in px per µm, Y upwards.
import { clamp } from "./numbers.js";

/** @import { Place } from "./document.js" */

/** @typedef {{ left: number, bottom: number, right: number, top: number }} Box */
/** @typedef {ReturnType<typeof newView>} View */

const LARGEST = 320; // px per µm: four steps across a phone
const MARGIN = 0.07; // of the window, free round what is fitted

/** View of a window that is still 1 px wide and high. */
export function newView() {
  let centerX = 0;
  let centerY = 0;
  let scale = 1;
  let least = 1e-6;
  let width = 1;
  let height = 1;

  /**
   * A scale within what can be shown.
   * @param {number} wanted
   */
  const bounded = (wanted) => clamp(wanted, least, LARGEST);

  /**
   * Scale at which a box fits the window, less what is covered at its top and bottom, px.
   * @param {Box} box
   * @param {number} top
   * @param {number} bottom
   */
  function scaleFor(box, top = 0, bottom = 0) {
    const across = Math.max(box.right - box.left, 1);
    const up = Math.max(box.top - box.bottom, 1);
    return (1 - 2 * MARGIN) * Math.min(width / across, Math.max(height - top - bottom, 1) / up);
  }

  return {
    get scale() { return scale; },
    get width() { return width; },
    get height() { return height; },
    /** @returns {Place} */
    get center() { return [centerX, centerY]; },
    /**
     * Where a place in µm shows.
     * @param {number} x
     */
    toX: (x) => width / 2 + (x - centerX) * scale,
    /** @param {number} y */
    toY: (y) => height / 2 - (y - centerY) * scale,
    /**
     * Place in µm of a point of the window.
     * @param {number} px
     * @param {number} py
     * @returns {Place}
     */
    placeOf: (px, py) => [centerX + (px - width / 2) / scale, centerY - (py - height / 2) / scale],
    /**
     * What shows, with `margin` px more on each side.
     * @param {number} margin
     * @returns {Box}
     */
    bounds(margin = 0) {
      const x = (width / 2 + margin) / scale;
      const y = (height / 2 + margin) / scale;
      return { left: centerX - x, right: centerX + x, bottom: centerY - y, top: centerY + y };
    },
    /**
     * @param {number} newWidth
     * @param {number} newHeight
     */
    resize(newWidth, newHeight) {
      width = Math.max(1, newWidth);
      height = Math.max(1, newHeight);
    },
    /**
     * No zooming out beyond a box by more than half.
     * @param {Box} box
     */
    limitTo(box) { least = scaleFor(box) / 2; },
    /**
     * Show all of a box between what covers the top and the bottom of the window, px.
     * @param {Box} box
     * @param {{ top: number, bottom: number }} covered
     */
    fit(box, { top, bottom }) {
      scale = bounded(scaleFor(box, top, bottom));
      centerX = (box.left + box.right) / 2;
      centerY = (box.bottom + box.top) / 2 + (top - bottom) / 2 / scale;
    },
    /**
     * @param {number} dx
     * @param {number} dy
     */
    panBy(dx, dy) {
      centerX -= dx / scale;
      centerY += dy / scale;
    },
    /**
     * Zoom so that the place under a point stays under it.
     * @param {number} px
     * @param {number} py
     * @param {number} factor
     */
    zoomAt(px, py, factor) {
      const wanted = bounded(scale * factor);
      const shift = 1 / scale - 1 / wanted;
      centerX += (px - width / 2) * shift;
      centerY -= (py - height / 2) * shift;
      scale = wanted;
    },
    /**
     * Look at a place, at another scale if one is given.
     * @param {number} x
     * @param {number} y
     * @param {number} wanted
     */
    lookAt(x, y, wanted = scale) {
      centerX = x;
      centerY = y;
      scale = bounded(wanted);
    },
  };
}
