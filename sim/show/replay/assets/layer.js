// An off-screen canvas, larger than the window, that is drawn anew only where the window leaves it or is zoomed.
import { penOf } from "./pen.js";
import { newView } from "./view.js";

/**
 * @import { Pen } from "./pen.js"
 * @import { View } from "./view.js"
 */

const SPARE = 0.3; // of the window on each side, so that a small pan draws nothing

/** Layer of a view; `isNew` tells whether it must be drawn wholly, `pen` draws in px of its own window. */
export function newLayer() {
  const canvas = document.createElement("canvas");
  const pen = penOf(canvas);
  const own = newView();
  let ratio = 0;
  let spareX = 0;
  let spareY = 0;
  let isNew = true;

  /**
   * Whether what the view shows is on the layer, at its scale.
   * @param {View} view
   * @param {number} newRatio
   */
  function covers(view, newRatio) {
    if (isNew || ratio !== newRatio || own.scale !== view.scale) return false;
    if (own.width !== view.width + 2 * spareX || own.height !== view.height + 2 * spareY) return false;
    const [x, y] = view.center;
    const [ownX, ownY] = own.center;
    return Math.abs(x - ownX) * view.scale <= spareX && Math.abs(y - ownY) * view.scale <= spareY;
  }

  /**
   * Centre the layer on a view, empty.
   * @param {View} view
   * @param {number} newRatio
   */
  function center(view, newRatio) {
    ratio = newRatio;
    spareX = Math.round(view.width * SPARE);
    spareY = Math.round(view.height * SPARE);
    own.resize(view.width + 2 * spareX, view.height + 2 * spareY);
    own.lookAt(...view.center, view.scale);
    canvas.width = Math.round(own.width * ratio); // empties it too
    canvas.height = Math.round(own.height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
  }

  return {
    pen,
    view: own,
    /**
     * Make it cover a view; true where it is empty then and must be drawn wholly.
     * @param {View} view
     * @param {number} newRatio
     */
    cover(view, newRatio) {
      if (covers(view, newRatio)) return false;
      center(view, newRatio);
      isNew = false;
      return true;
    },
    /** Have it drawn wholly next time. */
    spoil() { isNew = true; },
    clear() { pen.clearRect(0, 0, own.width, own.height); },
    /**
     * Copy what the view shows of it to another canvas, on whole pixels.
     * @param {Pen} target
     * @param {View} view
     */
    copyTo(target, view) {
      const [x, y] = own.placeOf(0, 0);
      const left = Math.round(view.toX(x) * ratio);
      const top = Math.round(view.toY(y) * ratio);
      target.save();
      target.setTransform(1, 0, 0, 1, 0, 0);
      target.drawImage(canvas, left, top);
      target.restore();
    },
  };
}
