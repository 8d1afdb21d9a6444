// The mark of a question on the time line.

/**
 * Draw a wedge that points down from the upper edge.
 * @param {CanvasRenderingContext2D} pen
 * @param {number} x
 */
export function drawQuestion(pen, x) {
  pen.beginPath();
  pen.moveTo(x - 5, 0);
  pen.lineTo(x + 5, 0);
  pen.lineTo(x, 8);
  pen.fill();
}
