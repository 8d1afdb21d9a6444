// Which parts of the canvas are free, so that no text covers another.

/** @typedef {[left: number, top: number, right: number, bottom: number]} Room A box of the canvas, px. */
/** @typedef {ReturnType<typeof freeRoom>} Free */

/**
 * Room on a canvas of this size, all free.
 * @param {number} width
 * @param {number} height
 */
export function freeRoom(width, height) {
  /** @type {Room[]} */
  const taken = [];
  return {
    /** @param {Room} box */
    take: (box) => taken.push(box),
    /** @param {Room} box */
    isFree: ([left, top, right, bottom]) =>
      left >= 2 && top >= 2 && right <= width - 2 && bottom <= height - 2
      && taken.every((box) => right <= box[0] || box[2] <= left || bottom <= box[1] || box[3] <= top),
  };
}
