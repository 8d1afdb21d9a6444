// Whether the view moves: from the frame that shows it elsewhere until it has rested for a moment.

/**
 * @import { Place } from "./document.js"
 * @import { View } from "./view.js"
 */

const REST_MS = 120;

/**
 * Motion of a view; `onRest` is called once it rests.
 * @param {View} view
 * @param {() => void} onRest
 */
export function motionOf(view, onRest) {
  let { scale } = view;
  /** @type {Place} */
  let center = view.center;
  let timer = 0;

  /** It rests. */
  function rest() {
    timer = 0;
    onRest();
  }

  return {
    /**
     * Whether the view moves in a frame; one that follows the wire moves where it is zoomed.
     * @param {boolean} isFollowing
     */
    at(isFollowing) {
      const isShifted = view.center.some((along, axis) => along !== center[axis]);
      if (view.scale !== scale || (isShifted && !isFollowing)) {
        window.clearTimeout(timer);
        timer = window.setTimeout(rest, REST_MS);
      }
      ({ scale, center } = view);
      return timer !== 0;
    },
  };
}
