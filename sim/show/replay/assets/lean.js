// A wire that leans at the moment that is shown: its walls in space, and how far U and V are.
import { element } from "../../html/assets/elements.js";
import { between, drawWalls, turnedBy } from "../../html/assets/walls.js";
import { columnsOf } from "./handed.js";
import { placeOn } from "./path.js";
import { mm } from "./words.js";

/** @import { Angles, Walls } from "../../html/assets/walls.js" */
/** @import { Curves, Place } from "./document.js" */

/** Written by `make pages` from the model in Python. */

/**
 * A wire that leans: its walls, and the contours at the faces of the work, whose rows are run together. `block` is the
 * row of the program that each of their rows is of. The program plane lies at `program_share` of the height, the
 * guides `span` times as far apart as the faces.
 * @typedef {object} Lean
 * @property {Walls} walls
 * @property {Curves} lower
 * @property {Curves} upper
 * @property {number[]} block
 * @property {number} program_share
 * @property {number} span
 */

/** Up to here. */

/**
 * What tells where the replay stands.
 * @typedef {object} Watched
 * @property {Promise<unknown>} ready
 * @property {() => { step: number, block: number, x: number, y: number }} [state]
 */

/** @typedef {{ low: Place, high: Place }} Ends Both ends of the wire at the faces of the work, µm. */

const LOOKS = 16; // shares of a row that are looked at first
const NARROWER = 40; // times that the way about the nearest of them is made narrower: below 1e-7 of the row

/**
 * Both ends of the wire after a share of a row.
 * @param {Lean} lean
 * @param {number} row
 * @param {number} share
 * @returns {Ends}
 */
function endsAt({ lower, upper }, row, share) {
  return { low: placeOn(lower, row, share), high: placeOn(upper, row, share) };
}

/**
 * Where both ends are while the program plane is at a place of a block: of all its rows, at the nearest place.
 * @param {Lean} lean
 * @param {number[]} rows
 * @param {number} x
 * @param {number} y
 * @returns {Ends | null}
 */
export function endsOf(lean, rows, x, y) {
  /**
   * @param {number} row
   * @param {number} share
   */
  function off(row, share) {
    const { low, high } = endsAt(lean, row, share);
    const [atX, atY] = between(low, high, lean.program_share);
    return Math.hypot(atX - x, atY - y);
  }

  /** @type {{ row: number, share: number, off: number } | null} */
  let best = null;
  for (const row of rows) {
    const looks = Array.from({ length: LOOKS + 1 }, (_, look) => off(row, look / LOOKS));
    const nearest = looks.indexOf(Math.min(...looks)) / LOOKS;
    let [from, to] = [Math.max(0, nearest - 1 / LOOKS), Math.min(1, nearest + 1 / LOOKS)];
    for (let time = 0; time < NARROWER; time += 1) {
      const [one, other] = [from + (to - from) / 3, to - (to - from) / 3];
      if (off(row, one) <= off(row, other)) to = other;
      else from = one;
    }
    const share = (from + to) / 2;
    const found = off(row, share);
    if (!best || found < best.off) best = { row, share, off: found };
  }
  return best && endsAt(lean, best.row, best.share);
}

/**
 * Rows of the contours by the row of the program that they are of.
 * @param {Lean} lean
 */
function rowsOf({ block }) {
  /** @type {Map<number, number[]>} */
  const rows = new Map();
  block.forEach((of, row) => {
    const found = rows.get(of);
    if (found) found.push(row);
    else rows.set(of, [row]);
  });
  return rows;
}

/**
 * Show walls and wire for as long as the page lasts.
 * @param {Watched} player
 */
export async function begin(player) {
  const handed = JSON.parse(element("#lean", HTMLElement).textContent);
  const [lower, upper] = await Promise.all([columnsOf(handed.lower), columnsOf(handed.upper)]);
  /** @type {Lean} */
  const lean = { ...handed, lower, upper };
  const rows = rowsOf(lean);
  const view = element("#walls", HTMLCanvasElement);
  const told = element("#lean-uv", HTMLElement);
  /** @type {Ends} */
  let ends = endsAt(lean, 0, 0);
  let step = -1;

  /** @param {Angles} angles */
  function draw(angles) {
    const [low, high] = [ends.low, ends.high].map(([x, y]) => [x / 1000, y / 1000]);
    drawWalls(view, lean.walls, { ...angles, share: lean.program_share, low, high });
  }

  const angles = turnedBy(view, draw);
  await player.ready;

  function frame() {
    const state = player.state?.();
    if (state && state.step !== step) {
      step = state.step;
      ends = endsOf(lean, rows.get(state.block) ?? [], state.x, state.y) ?? ends;
      const [u, v] = [0, 1].map((axis) => mm((ends.high[axis] - ends.low[axis]) * lean.span));
      told.textContent = `U ${u} V ${v} mm`;
      draw(angles);
    }
    window.requestAnimationFrame(frame);
  }
  frame();
}
