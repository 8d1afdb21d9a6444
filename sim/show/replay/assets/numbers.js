// Numbers in rising columns, and between bounds.

/**
 * How many of the first entries of a rising column are no more than a value.
 * @param {ArrayLike<number>} column
 * @param {number} value
 */
export function countUpTo(column, value, entries = column.length) {
  let low = 0;
  let high = entries;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (column[middle] <= value) low = middle + 1;
    else high = middle;
  }
  return low;
}

/**
 * A value put between two bounds.
 * @param {number} value
 * @param {number} low
 * @param {number} high
 */
export function clamp(value, low, high) {
  return Math.min(Math.max(value, low), high);
}
