// The tape of a replay document as typed arrays: the steps with their times, and the samples of table and wire.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});

  /** Bytes of a text in base64. */
  function bytesOf(base64) {
    const text = atob(base64);
    const bytes = new Uint8Array(text.length);
    for (let at = 0; at < text.length; at++) bytes[at] = text.charCodeAt(at);
    return bytes;
  }

  /** Bytes of a packed column, inflated. */
  async function inflated(base64) {
    const stream = new Blob([bytesOf(base64)]).stream().pipeThrough(new DecompressionStream("deflate-raw"));
    return new Uint8Array(await new Response(stream).arrayBuffer());
  }

  /** So many signed numbers of a packed column, seven bits a byte, the lowest first (sim/show/replay/tape.py). */
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

  /** Where the axes stand after each step, the start first, and how many of the steps so far moved X. */
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

  /** Times of all steps, the start first: each took so much more than the last one of the same way. */
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

  /** Times of the samples, of which the second differences are kept. */
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

  /** Where the steps command the axes at each of the sample times. */
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

  /** A column that lies so many grains beside another one. */
  function beside(column, changes, grain) {
    const result = new Float64Array(column.length);
    let grains = 0;
    for (let at = 0; at < column.length; at++) {
      grains += changes[at];
      result[at] = column[at] + grains * grain;
    }
    return result;
  }

  /** Samples: where axes were commanded, the table stood and the wire cut, and the row its deviation is measured from. */
  function samplesOf(tape, columns, steps) {
    const t = sampleTimes(tape, columns.sample_ticks);
    const { commandedX, commandedY } = commandedAt(t, steps);
    const tableX = beside(commandedX, columns.table_x, tape.grain_um);
    const tableY = beside(commandedY, columns.table_y, tape.grain_um);
    const wireX = columns.wire_x ? beside(tableX, columns.wire_x, tape.grain_um) : tableX;
    const wireY = columns.wire_y ? beside(tableY, columns.wire_y, tape.grain_um) : tableY;
    const footRow = beside(new Float64Array(tape.samples), columns.foot_row, 1);
    return { t, tableX, tableY, wireX, wireY, commandedX, commandedY, footRow };
  }

  /** Replay of a document: {doc, steps, x, y, t, xSteps, samples}. */
  async function decode(doc) {
    const tape = doc.tape;
    const packed = ["sample_ticks", "table_x", "table_y", "wire_x", "wire_y", "foot_row"].filter((name) => tape[name] !== null);
    const [ways, stepTicks, ...rest] = await Promise.all(
      [tape.moves, tape.step_ticks, ...packed.map((name) => tape[name])].map(inflated),
    );
    const columns = Object.fromEntries(packed.map((name, at) => [name, numbers(rest[at], tape.samples)]));
    const steps = places(tape, ways);
    steps.t = stepTimes(tape, ways, numbers(stepTicks, tape.steps));
    return { doc, steps: tape.steps, ...steps, samples: samplesOf(tape, columns, steps) };
  }

  Drycut.decode = decode;
})(globalThis);
