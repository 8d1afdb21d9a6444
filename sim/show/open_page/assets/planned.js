// The replay of a path that was not run: where the wire is at the machine's feeds, and no table that lags behind it.
import { clamp, countUpTo } from "../../replay/assets/numbers.js";
import { placeOn } from "../../replay/assets/path.js";

/** @import { Path, Finding } from "./data.js" */
/** @import { Finding as Marked } from "../../replay/assets/document.js" */
/** @import { Cut } from "../../replay/assets/kerf.js" */

const SAG_UM = 1; // that a chord of an arc may lie inside it, where the kerf is drawn

/**
 * Places along a path, arcs in chords, when the wire is there, and whether it cut on its way to each.
 * @param {Path} path
 */
function samplesOf(path) {
  const [t, x, y] = [[0], [path.place_x_um[0]], [path.place_y_um[0]]];
  /** @type {Cut[]} */
  const cuts = [null];
  path.kind.forEach((kind, row) => {
    const half = Math.acos(Math.max(1 - SAG_UM / Math.max(path.radius_um[row], SAG_UM), -1));
    const chords = kind === "arc" ? Math.max(1, Math.ceil(Math.abs(path.sweep_rad[row]) / (2 * half))) : 1;
    const [since, until] = [path.border_s[row], path.border_s[row + 1]];
    for (let chord = 1; chord <= chords; chord++) {
      const [toX, toY] = placeOn(path, row, chord / chords);
      t.push(since + (chord / chords) * (until - since));
      x.push(toX);
      y.push(toY);
      cuts.push(kind === "jump" ? null : "kerf");
    }
  });
  return { samples: { t: Float64Array.from(t), wireX: Float64Array.from(x), wireY: Float64Array.from(y) }, cuts };
}

/**
 * Findings as a time line marks them: where their block begins.
 * @param {Path} path
 * @param {Finding[]} findings
 * @returns {Marked[]}
 */
export function markedOn(path, findings) {
  const rest = { found: "", expected: "", machine: "" };
  return findings.map(({ code, severity, line, block, block_name, title, hint, message }) => {
    const row = block ? block - 1 : null;
    return {
      code, severity, line, block, block_name, row,
      t_s: row === null ? null : path.border_s[row],
      place_um: row === null ? null : [path.place_x_um[row], path.place_y_um[row]],
      texts: {
        en: { ...rest, title: title.en, hint: hint.en, message: message.en },
        zh: { ...rest, title: title.zh, hint: hint.zh, message: message.zh },
      },
    };
  });
}

/**
 * The replay of a path at the feeds; a step of it is a block.
 * @param {Path} path
 * @param {Finding[]} findings
 */
export function plannedOf(path, findings) {
  const { border_s: border } = path;
  const rows = path.kind.length;
  const duration = border[rows];
  const { samples, cuts } = samplesOf(path);

  /**
   * Row of the block that runs at a time.
   * @param {number} t
   */
  const blockAt = (t) => clamp(countUpTo(border, t) - 1, 0, rows - 1);

  /** @param {number} time */
  function stateAt(time) {
    const t = clamp(time, 0, duration);
    const block = blockAt(t);
    const took = border[block + 1] - border[block];
    const wire = placeOn(path, block, took > 0 ? (t - border[block]) / took : 1);
    return {
      t, step: block, block, x: wire[0], y: wire[1], wire, table: wire,
      feed_um_s: took > 0 ? path.length_um[block] / took : 0, count_left: null, remaining_s: duration - t,
    };
  }

  return {
    replay: {
      doc: {
        blocks: { ...path, label: path.name, first_step: Array.from({ length: rows + 1 }, (_, row) => row) },
        findings: markedOn(path, findings), passes: [], stops: [],
      },
      steps: rows,
      way: { x: (/** @type {number} */ step) => path.place_x_um[step], y: (/** @type {number} */ step) => path.place_y_um[step] },
    },
    model: {
      duration, blockAt, stepAt: blockAt, countLeft: () => null, stateAt,
      timeOf: (/** @type {number} */ step) => border[clamp(step, 0, rows)],
      deviation: (/** @type {number} */ t) => ({ um: 0, foot: stateAt(t).wire }),
    },
    samples,
    cuts,
  };
}
