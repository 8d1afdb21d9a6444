// What draws on a canvas.

/** @typedef {CanvasRenderingContext2D} Pen */

/**
 * Pen of a canvas; an error where the browser has none.
 * @param {HTMLCanvasElement} canvas
 * @param {CanvasRenderingContext2DSettings} settings
 * @returns {Pen}
 */
export function penOf(canvas, settings = {}) {
  const pen = canvas.getContext("2d", settings);
  if (!pen) throw new Error("a canvas has no pen");
  return pen;
}
