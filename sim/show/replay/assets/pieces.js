// The pieces that come free: they fall, and leave a hole with their name in it.
import { newLayer } from "./layer.js";
import { outline } from "./outline.js";
import * as words from "./words.js";

/**
 * @import { Piece, Place, ReplayDocument } from "./document.js"
 * @import { Colours } from "./palette.js"
 * @import { Pen } from "./pen.js"
 * @import { View } from "./view.js"
 */

/** @typedef {ReturnType<typeof piecesOf>} Pieces */

const DROP_MS = 700;
const DROP = 46; // px that a piece sinks
const SHRUNK = 0.86;
const LINES = 12; // on which room for a name is looked for

/**
 * Where a level line crosses closed outlines, from left to right.
 * @param {Place[][]} rings
 * @param {number} y
 */
function crossings(rings, y) {
  /** @type {number[]} */
  const found = [];
  for (const ring of rings) {
    ring.forEach(([bx, by], at) => {
      const [ax, ay] = ring[(at || ring.length) - 1];
      if (ay > y !== by > y) found.push(ax + ((y - ay) / (by - ay)) * (bx - ax));
    });
  }
  return found.sort((a, b) => a - b);
}

/**
 * The widest stretch that two rows of crossings have in common: {x, width}.
 * @param {number[]} lower
 * @param {number[]} upper
 */
function widestCommon(lower, upper) {
  let best = { x: 0, width: 0 };
  for (let at = 0; at + 1 < lower.length; at += 2) {
    for (let other = 0; other + 1 < upper.length; other += 2) {
      const left = Math.max(lower[at], upper[other]);
      const width = Math.min(lower[at + 1], upper[other + 1]) - left;
      if (width > best.width) best = { x: left + width / 2, width };
    }
  }
  return best;
}

/**
 * The widest band in a piece between a few level lines: {x, y, width}.
 * @param {Piece} piece
 */
function roomIn({ outline_um: outer, holes_um: holes }) {
  const ys = outer.map((corner) => corner[1]).sort((a, b) => a - b);
  const [bottom, height] = [ys[0], ys[ys.length - 1] - ys[0]];
  const rows = Array.from({ length: LINES - 1 }, (_, line) => crossings([outer, ...holes], bottom + (height * (line + 1)) / LINES));
  const bands = rows.slice(1).map((row, line) => ({ ...widestCommon(rows[line], row), y: bottom + (height * (line + 1.5)) / LINES }));
  return bands.reduce((best, band) => (band.width > best.width ? band : best));
}

/**
 * Pieces of a replay's document.
 * @param {ReplayDocument} doc
 * @param {Colours} colours
 */
export function piecesOf(doc, colours) {
  const holes = newLayer();
  /** @type {Map<Piece, number>} */
  const falls = new Map(); // pieces that are falling, and since when
  const rooms = new Map(doc.pieces.map((piece) => [piece, roomIn(piece)])); // for their names
  let gone = 0;
  let drawn = 0; // pieces on the layer

  /**
   * A piece that is `share` of its way down: grey, sinking, fading.
   * @param {Pen} pen
   * @param {View} view
   * @param {Piece} piece
   * @param {number} share
   */
  function drawFalling(pen, view, piece, share) {
    const [x, y] = [view.toX(piece.center_um[0]), view.toY(piece.center_um[1])];
    const size = 1 - (1 - SHRUNK) * share * share;
    pen.save();
    outline(pen, view, [piece.outline_um]); // it is seen through its hole
    pen.clip();
    pen.globalAlpha = 1 - share * share;
    pen.translate(x, y + DROP * share * share);
    pen.scale(size, size);
    pen.translate(-x, -y);
    outline(pen, view, [piece.outline_um, ...piece.holes_um]);
    pen.fillStyle = colours().slug;
    pen.fill("evenodd");
    pen.restore();
  }

  /**
   * The name of a piece where it was, if there is room.
   * @param {Pen} pen
   * @param {View} view
   * @param {Piece} piece
   */
  function drawName(pen, view, piece) {
    const text = words.piece(piece, doc.blocks);
    const room = rooms.get(piece);
    pen.font = "12px system-ui, sans-serif";
    if (!room || pen.measureText(text).width + 12 > room.width * view.scale) return;
    pen.fillStyle = colours().muted;
    pen.textAlign = "center";
    pen.fillText(text, view.toX(room.x), view.toY(room.y) + 4);
  }

  /**
   * Those that fall, as far as they are down by now.
   * @param {Pen} pen
   * @param {View} view
   * @param {number} now
   */
  function drawFalls(pen, view, now) {
    for (const [piece, since] of falls) {
      const share = (now - since) / DROP_MS;
      if (share >= 1) falls.delete(piece);
      else drawFalling(pen, view, piece, share);
    }
  }

  /**
   * Where pieces were, on the layer.
   * @param {Piece[]} free
   */
  function drawHoles(free) {
    const { pen, view } = holes;
    holes.clear();
    pen.fillStyle = colours().gone;
    for (const { outline_um: outer, holes_um: inner } of free) {
      outline(pen, view, [outer, ...inner]);
      pen.fill("evenodd");
      for (const ring of [outer, ...inner]) holes.took(ring.length);
    }
    drawn = free.length;
  }

  return {
    /**
     * Draw those that are free at a time; those that came free since the last frame fall, if the replay plays.
     * @param {Pen} pen
     * @param {View} view
     * @param {{ ratio: number, isMoving: boolean, t: number, now: number, mayFall: boolean }} frame
     */
    draw(pen, view, { ratio, isMoving, t, now, mayFall }) {
      const free = doc.pieces.filter((piece) => piece.t_s <= t);
      if (free.length < gone || !mayFall) falls.clear();
      for (const piece of mayFall ? free.slice(gone) : []) falls.set(piece, now);
      gone = free.length;
      if (!free.length) return;
      const isNew = holes.cover(view, ratio, isMoving);
      if (isNew || drawn !== gone) drawHoles(free);
      holes.copyTo(pen, view);
      for (const piece of free) drawName(pen, view, piece);
      drawFalls(pen, view, now);
    },
    /** Whether something falls still, so that frames are needed. */
    get isFalling() { return falls.size > 0; },
    get isTrue() { return !gone || holes.isTrue; },
    spoil: holes.spoil,
  };
}
