// The tape of a replay document as typed arrays: the steps with their times, and the samples of table and wire.

/** @import { ReplayDocument, Tape } from "./document.js" */

/**
 * Where the axes stand after each step, the start first; when; and how many of the steps so far moved X.
 * @typedef {object} Steps
 * @property {Int32Array} x
 * @property {Int32Array} y
 * @property {Int32Array} xSteps
 * @property {Float64Array} t
 */

/**
 * When and where the axes were commanded, the table stood, and the wire cut.
 * @typedef {object} Samples
 * @property {Float64Array} t
 * @property {Float64Array} tableX
 * @property {Float64Array} tableY
 * @property {Float64Array} wireX
 * @property {Float64Array} wireY
 * @property {Float64Array} commandedX
 * @property {Float64Array} commandedY
 * @property {Float64Array} footRow the row that the deviation is measured from
 */

/** @typedef {Steps & { doc: ReplayDocument, steps: number, samples: Samples }} Replay */

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
 * Bytes of a packed column, inflated.
 * @param {string} base64
 */
async function inflated(base64) {
  const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/**
 * So many signed numbers of a packed column, seven bits a byte, the lowest first (sim/show/replay/tape.py).
 * @param {Uint8Array} bytes
 * @param {number} count
 */
function numbers(bytes, count) {
  const values = new Float64Array(count);
  let at = 0;
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
  return values;
}

/** By how much a step of each way moves X and Y. */
const BY_X = Int32Array.of(-1, -1, -1, 0, 0, 0, 1, 1, 1);
const BY_Y = Int32Array.of(-1, 0, 1, -1, 0, 1, -1, 0, 1);

/**
 * Where the axes stand after each step, the start first, and how many of the steps so far moved X.
 * @param {Tape} tape
 * @param {Uint8Array} ways
 */
function places(tape, ways) {
  const x = new Int32Array(tape.steps + 1);
  const y = new Int32Array(tape.steps + 1);
  const xSteps = new Int32Array(tape.steps + 1);
  let [atX, atY] = tape.origin_um;
  let inX = 0;
  x[0] = atX;
  y[0] = atY;
  for (let step = 0; step < tape.steps; step++) {
    const by = BY_X[ways[step]];
    x[step + 1] = atX += by;
    y[step + 1] = atY += BY_Y[ways[step]];
    xSteps[step + 1] = inX += by & 1;
  }
  return { x, y, xSteps };
}

/**
 * Times of all steps, the start first: each took so much more than the last one of the same way.
 * @param {Tape} tape
 * @param {Uint8Array} ways
 * @param {Float64Array} more
 */
function stepTimes(tape, ways, more) {
  const t = new Float64Array(tape.steps + 1);
  const took = new Float64Array(BY_X.length);
  const tick = tape.tick_s;
  let ticks = 0;
  for (let step = 0; step < tape.steps; step++) {
    const way = ways[step];
    ticks += took[way] += more[step];
    t[step + 1] = ticks * tick;
  }
  return t;
}

/**
 * Times of the samples, of which the second differences are kept.
 * @param {Tape} tape
 * @param {Float64Array} changes
 */
function sampleTimes(tape, changes) {
  const t = new Float64Array(tape.samples);
  let ticks = 0;
  let took = 0;
  for (let sample = 0; sample < tape.samples; sample++) {
    ticks += took += changes[sample];
    t[sample] = ticks * tape.tick_s;
  }
  return t;
}

/**
 * Where the steps command the axes at each of the sample times.
 * @param {Float64Array} sampleT
 * @param {Steps} steps
 */
function commandedAt(sampleT, steps) {
  const commandedX = new Float64Array(sampleT.length);
  const commandedY = new Float64Array(sampleT.length);
  let step = 0;
  for (let sample = 0; sample < sampleT.length; sample++) {
    while (step + 1 < steps.t.length && steps.t[step + 1] <= sampleT[sample]) step++;
    commandedX[sample] = steps.x[step];
    commandedY[sample] = steps.y[step];
  }
  return { commandedX, commandedY };
}

/**
 * A column that lies so many grains beside another one.
 * @param {Float64Array} column
 * @param {Float64Array} changes
 * @param {number} grain
 */
function beside(column, changes, grain) {
  const result = new Float64Array(column.length);
  let grains = 0;
  for (let at = 0; at < column.length; at++) {
    grains += changes[at];
    result[at] = column[at] + grains * grain;
  }
  return result;
}

/**
 * Numbers of the columns of samples.
 * @param {Tape} tape
 */
async function sampleColumns(tape) {
  /** @param {string} column */
  const unpacked = async (column) => numbers(await inflated(column), tape.samples);
  const [ticks, footRow, tableX, tableY, wireX, wireY] = await Promise.all([
    unpacked(tape.sample_ticks),
    unpacked(tape.foot_row),
    unpacked(tape.table_x),
    unpacked(tape.table_y),
    tape.wire_x === null ? null : unpacked(tape.wire_x),
    tape.wire_y === null ? null : unpacked(tape.wire_y),
  ]);
  return { ticks, footRow, tableX, tableY, wireX, wireY };
}

/**
 * Samples of a tape.
 * @param {Tape} tape
 * @param {Awaited<ReturnType<typeof sampleColumns>>} columns
 * @param {Steps} steps
 * @returns {Samples}
 */
function samplesOf(tape, columns, steps) {
  const t = sampleTimes(tape, columns.ticks);
  const { commandedX, commandedY } = commandedAt(t, steps);
  const tableX = beside(commandedX, columns.tableX, tape.grain_um);
  const tableY = beside(commandedY, columns.tableY, tape.grain_um);
  const wireX = columns.wireX ? beside(tableX, columns.wireX, tape.grain_um) : tableX;
  const wireY = columns.wireY ? beside(tableY, columns.wireY, tape.grain_um) : tableY;
  const footRow = beside(new Float64Array(tape.samples), columns.footRow, 1);
  return { t, tableX, tableY, wireX, wireY, commandedX, commandedY, footRow };
}

/**
 * Replay of a document.
 * @param {ReplayDocument} doc
 * @returns {Promise<Replay>}
 */
export async function decode(doc) {
  const { tape } = doc;
  const [ways, ticks, columns] = await Promise.all([inflated(tape.moves), inflated(tape.step_ticks), sampleColumns(tape)]);
  const steps = { ...places(tape, ways), t: stepTimes(tape, ways, numbers(ticks, tape.steps)) };
  return { doc, steps: tape.steps, ...steps, samples: samplesOf(tape, columns, steps) };
}
