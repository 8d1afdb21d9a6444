// An off-screen canvas, larger than the window, that is drawn anew only where the window leaves it or is zoomed. Much
// ink takes longer than a frame: while the view moves, such a layer is shown as it is, shifted and scaled, and drawn
// coarsely where that shows too little.
import { penOf } from "./pen.js";
import { newView } from "./view.js";

/**
 * @import { Pen } from "./pen.js"
 * @import { View } from "./view.js"
 */

/** @typedef {ReturnType<typeof newLayer>} Layer */

const SPARE = 0.3; // of the window on each side, so that a small pan draws nothing
const HEAVY = 2000; // points: a phone draws as many in a frame
const LARGEST = 4; // times that a layer is shown enlarged
const SMALLEST = 0.4;
const BARE = 0.2; // of the window's width and height that such a layer may leave without ink on each side
const COARSE = 6; // times as far off a line may be

/** Layer of a view; `cover` tells whether it must be drawn wholly, `pen` draws in px of its own window. */
export function newLayer() {
  const canvas = document.createElement("canvas");
  const pen = penOf(canvas);
  const own = newView();
  let ratio = 0;
  let spareX = 0;
  let spareY = 0;
  let isNew = true;
  let points = 0; // that were drawn on it
  let isHeavy = false; // as it was drawn finely last
  let isCoarse = false;
  let isTrue = false; // at the scale and place of the view, and fine

  /**
   * Whether it is as large as a window asks for.
   * @param {View} view
   * @param {number} newRatio
   */
  function fits(view, newRatio) {
    return !isNew && ratio === newRatio && own.width === view.width + 2 * spareX && own.height === view.height + 2 * spareY;
  }

  /**
   * Whether what the view shows is on the layer, at its scale.
   * @param {View} view
   */
  function covers(view) {
    const [x, y] = view.center;
    const [ownX, ownY] = own.center;
    const isNear = Math.abs(x - ownX) * view.scale <= spareX && Math.abs(y - ownY) * view.scale <= spareY;
    return own.scale === view.scale && isNear;
  }

  /**
   * Whether most of what the view shows is on the layer, at a scale that is not far from its own.
   * @param {View} view
   */
  function stands(view) {
    const times = view.scale / own.scale;
    const [x, y] = view.center;
    const [ownX, ownY] = own.center;
    const isNear = Math.abs(x - ownX) * view.scale <= (own.width * times - view.width) / 2 + BARE * view.width
      && Math.abs(y - ownY) * view.scale <= (own.height * times - view.height) / 2 + BARE * view.height;
    return times >= SMALLEST && times <= LARGEST && isNear;
  }

  /**
   * Centre the layer on a view, empty.
   * @param {View} view
   * @param {number} newRatio
   */
  function center(view, newRatio) {
    if (!isCoarse) isHeavy = points > HEAVY;
    ratio = newRatio;
    spareX = Math.round(view.width * SPARE);
    spareY = Math.round(view.height * SPARE);
    own.resize(view.width + 2 * spareX, view.height + 2 * spareY);
    own.lookAt(...view.center, view.scale);
    canvas.width = Math.round(own.width * ratio); // empties it too
    canvas.height = Math.round(own.height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    points = 0;
  }

  return {
    pen,
    view: own,
    /**
     * Make it cover a view, or let it stand for one that moves; true where it is empty then and must be drawn wholly.
     * @param {View} view
     * @param {number} newRatio
     * @param {boolean} isMoving
     */
    cover(view, newRatio, isMoving) {
      const mayStand = isMoving && (isCoarse || points > HEAVY) && stands(view);
      isTrue = covers(view) && !isCoarse;
      if (fits(view, newRatio) && (isTrue || mayStand)) return false;
      center(view, newRatio);
      isCoarse = isMoving && isHeavy;
      isTrue = !isCoarse;
      isNew = false;
      return true;
    },
    /** Whether it is as it should be where the view rests. */
    get isTrue() { return isTrue; },
    /** How many times as far off as else a line on it may be. */
    get coarseness() { return isCoarse ? COARSE : 1; },
    /**
     * So many more points were drawn on it.
     * @param {number} more
     */
    took(more) { points += more; },
    /** Have it drawn wholly next time. */
    spoil() { isNew = true; },
    clear() {
      pen.clearRect(0, 0, own.width, own.height);
      points = 0;
    },
    /**
     * Copy what the view shows of it to another canvas: on whole pixels, but at another scale than its own.
     * @param {Pen} target
     * @param {View} view
     */
    copyTo(target, view) {
      const [x, y] = own.placeOf(0, 0);
      const [left, top, times] = [view.toX(x) * ratio, view.toY(y) * ratio, view.scale / own.scale];
      target.save();
      target.setTransform(1, 0, 0, 1, 0, 0);
      if (times === 1) target.drawImage(canvas, Math.round(left), Math.round(top));
      else target.drawImage(canvas, left, top, canvas.width * times, canvas.height * times);
      target.restore();
    },
  };
}
