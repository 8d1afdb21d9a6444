// The tape of a replay document unpacked: the way of the axes, and the samples of table and wire.
import { inflated, numbersOf } from "../../html/assets/packed.js";
import { wayOf } from "./way.js";

/**
 * @import { Tape } from "./document.js"
 * @import { Handed } from "./handed.js"
 * @import { Way } from "./way.js"
 */

/**
 * When and where the table stood, and the wire cut.
 * @typedef {object} Samples
 * @property {Float64Array} t
 * @property {Float64Array} tableX
 * @property {Float64Array} tableY
 * @property {Float64Array} wireX
 * @property {Float64Array} wireY
 * @property {Int32Array} footRow the row that the deviation is measured from
 */

/** @typedef {{ doc: Handed, steps: number, way: Way, samples: Samples }} Replay */

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
 * @param {Way} way
 */
function commandedAt(sampleT, way) {
  const [x, y] = [new Float64Array(sampleT.length), new Float64Array(sampleT.length)];
  sampleT.forEach((t, sample) => {
    const step = way.doneBy(t);
    x[sample] = way.x(step);
    y[sample] = way.y(step);
  });
  return { x, y };
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
  const unpacked = (column) => numbersOf(column, tape.samples);
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
 * @param {Way} way
 * @returns {Samples}
 */
function samplesOf(tape, columns, way) {
  const t = sampleTimes(tape, columns.ticks);
  const { x, y } = commandedAt(t, way);
  const tableX = beside(x, columns.tableX, tape.grain_um);
  const tableY = beside(y, columns.tableY, tape.grain_um);
  const wireX = columns.wireX ? beside(tableX, columns.wireX, tape.grain_um) : tableX;
  const wireY = columns.wireY ? beside(tableY, columns.wireY, tape.grain_um) : tableY;
  const footRow = Int32Array.from(beside(new Float64Array(tape.samples), columns.footRow, 1));
  return { t, tableX, tableY, wireX, wireY, footRow };
}

/**
 * Replay of a document.
 * @param {Handed} doc
 * @returns {Promise<Replay>}
 */
export async function decode(doc) {
  const { tape } = doc;
  const [ways, more, columns] = await Promise.all([inflated(tape.moves), inflated(tape.step_ticks), sampleColumns(tape)]);
  const way = wayOf(tape, ways, more);
  return { doc, steps: tape.steps, way, samples: samplesOf(tape, columns, way) };
}
