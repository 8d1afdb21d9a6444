// Columns that Python hands over packed (sim/show/html/packed.py): deflated bytes in base64.

/** Written by `make pages` from the model in Python. */

/**
 * A long column: its numbers as changes from one to the next, times `per`; or any values as JSON.
 * @typedef {object} Packed
 * @property {number} count
 * @property {number} per
 * @property {string | null} numbers
 * @property {string | null} none a byte for each number, 1 where there is none; null where there are all
 * @property {string | null} json
 */

/** Up to here. */

/**
 * Bytes of a text in base64.
 * @param {string} base64
 */
function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let at = 0; at < text.length; at++) bytes[at] = text.charCodeAt(at);
  return bytes;
}

/**
 * What a text in base64 holds, inflated.
 * @param {string} base64
 */
const answer = (base64) => new Response(new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate")));

/**
 * Bytes of a packed column, inflated.
 * @param {string} base64
 */
export async function inflated(base64) {
  return new Uint8Array(await answer(base64).arrayBuffer());
}

/**
 * Fill so many of the values with signed numbers of a packed column, seven bits a byte, the lowest first
 * (sim/show/html/packed.py), from a byte on; gives the byte behind them.
 * @param {Float64Array} values
 * @param {Uint8Array} bytes
 * @param {number} count
 * @param {number} from
 */
export function fill(values, bytes, count, from = 0) {
  let at = from;
  for (let index = 0; index < count; index++) {
    const byte = bytes[at++];
    if (byte < 128) {
      values[index] = (byte >>> 1) ^ -(byte & 1);
      continue;
    }
    let value = byte & 127;
    let weight = 128;
    for (let next = 128; next > 127; weight *= 128) {
      next = bytes[at++];
      value += (next & 127) * weight;
    }
    values[index] = value % 2 ? -(value + 1) / 2 : value / 2;
  }
  return at;
}

/**
 * All numbers of a packed column.
 * @param {string} base64
 * @param {number} count
 */
export async function numbersOf(base64, count) {
  const values = new Float64Array(count);
  fill(values, await inflated(base64), count);
  return values;
}

/**
 * Numbers of a packed column; null where there is none.
 * @param {Packed} column
 */
async function columnOf({ count, per, numbers, none }) {
  const values = await numbersOf(numbers ?? "", count);
  for (let at = 0, sum = 0; at < count; at++) {
    sum += values[at];
    values[at] = sum / per;
  }
  if (none === null) return values;
  const lacks = await inflated(none);
  return Array.from(values, (value, at) => (lacks[at] ? null : value));
}

/**
 * Values of a column that may be packed.
 * @template T
 * @param {ArrayLike<T> | Packed} column
 * @returns {Promise<ArrayLike<T>>}
 */
export async function unpacked(column) {
  if (!("per" in column)) return column;
  const found = column.json === null ? await columnOf(column) : JSON.parse(await answer(column.json).text());
  return found;
}
