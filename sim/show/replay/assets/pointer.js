// Mouse and touch on the table: drag to pan, wheel and pinch to zoom.

/** @import { View } from "./view.js" */

const PER_NOTCH = 1.0015; // zoom of a px of wheel

/**
 * Let pointers move the view; `onMove(isPan)` is told.
 * @param {HTMLCanvasElement} canvas
 * @param {View} view
 * @param {(isPan: boolean) => void} onMove
 * @param {() => boolean} isDragging whether a pointer drags something else than the view
 */
export function wirePointer(canvas, view, onMove, isDragging = () => false) {
  /** @type {Map<number, [x: number, y: number]>} */
  const down = new Map(); // pointers to their places

  /**
   * Place of an event on the canvas.
   * @param {MouseEvent} event
   * @returns {[x: number, y: number]}
   */
  function placeOf(event) {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  /** Middle of two fingers and how far they are apart. */
  function pinch() {
    const [[ax, ay], [bx, by]] = [...down.values()];
    return { x: (ax + bx) / 2, y: (ay + by) / 2, apart: Math.max(1, Math.hypot(ax - bx, ay - by)) };
  }

  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    down.set(event.pointerId, placeOf(event));
  });
  canvas.addEventListener("pointermove", (event) => {
    const old = down.get(event.pointerId);
    if (!old) return;
    const [x, y] = placeOf(event);
    if (down.size === 2) {
      const before = pinch();
      down.set(event.pointerId, [x, y]);
      const after = pinch();
      view.panBy(after.x - before.x, after.y - before.y);
      view.zoomAt(after.x, after.y, after.apart / before.apart);
    } else {
      down.set(event.pointerId, [x, y]);
      if (down.size > 2 || isDragging()) return;
      view.panBy(x - old[0], y - old[1]);
    }
    onMove(true);
  });
  canvas.addEventListener("pointerup", (event) => down.delete(event.pointerId));
  canvas.addEventListener("pointercancel", (event) => down.delete(event.pointerId));
  canvas.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      view.zoomAt(...placeOf(event), PER_NOTCH ** -(event.deltaY * (event.deltaMode ? 33 : 1)));
      onMove(false);
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", (event) => {
    view.zoomAt(...placeOf(event), 2);
    onMove(false);
  });
}
