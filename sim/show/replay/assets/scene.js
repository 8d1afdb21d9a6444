// What lies still: travel of the table, work, clamps, the ideal path, the start; and the pieces that come free.
import { newLayer } from "./layer.js";
import * as words from "./words.js";

/**
 * @import { Piece, Place, ReplayDocument } from "./document.js"
 * @import { Layer } from "./layer.js"
 * @import { Colours } from "./palette.js"
 * @import { Path } from "./path.js"
 * @import { Pen } from "./pen.js"
 * @import { Box, View } from "./view.js"
 */

const DROP_MS = 700;
const DROP = 46; // px that a piece sinks
const SHRUNK = 0.86;
const LINES = 12; // on which room for a name is looked for
const CLOSE = 5; // px per µm: there the ideal path is drawn for itself, not as a hint

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
 * Add closed outlines to the pen's path.
 * @param {Pen} pen
 * @param {View} view
 * @param {Place[][]} rings
 */
function outline(pen, view, rings) {
  pen.beginPath();
  for (const ring of rings) {
    ring.forEach(([x, y], at) => (at ? pen.lineTo(view.toX(x), view.toY(y)) : pen.moveTo(view.toX(x), view.toY(y))));
    pen.closePath();
  }
}

/**
 * Scene of a replay's document.
 * @param {ReplayDocument} doc
 * @param {Path} path
 * @param {Colours} colours
 */
export function sceneOf(doc, path, colours) {
  const { left, bottom, right, top } = travelOf(doc);
  /** @type {Place[]} */
  const travel = [[left, bottom], [right, bottom], [right, top], [left, top]];
  const ideal = newLayer();
  /** @type {Map<Piece, number>} */
  const falls = new Map(); // pieces that are falling, and since when
  const rooms = new Map(doc.pieces.map((piece) => [piece, roomIn(piece)])); // for their names
  let gone = 0;

  /**
   * Fill and edge an outline.
   * @param {Pen} pen
   * @param {View} view
   * @param {Place[]} corners
   * @param {string} fill
   * @param {string} edge
   */
  function body(pen, view, corners, fill, edge) {
    outline(pen, view, [corners]);
    pen.fillStyle = fill;
    pen.fill();
    pen.strokeStyle = edge;
    pen.lineWidth = 1.5;
    pen.stroke();
  }

  /**
   * The path as the drawing means it, thin, jumps dashed; how many points that took.
   * @param {Layer} layer
   */
  function drawIdeal({ pen, view, coarseness }) {
    const shades = colours();
    const isClose = view.scale > CLOSE;
    pen.strokeStyle = shades.ideal;
    pen.globalAlpha = isClose ? 1 : 0.6;
    pen.lineWidth = isClose ? 1.75 : 1;
    const solid = path.stroke(pen, view, (kind) => kind !== "jump", coarseness);
    pen.globalAlpha = 1;
    pen.strokeStyle = shades.jump;
    pen.lineWidth = 1.5;
    pen.setLineDash([7, 5]);
    const dashed = path.stroke(pen, view, (kind) => kind === "jump", coarseness);
    pen.setLineDash([]);
    return solid + dashed;
  }

  /**
   * A ring where the wire is threaded.
   * @param {Pen} pen
   * @param {View} view
   */
  function drawStart(pen, view) {
    pen.beginPath();
    pen.arc(view.toX(doc.blocks.place_x_um[0]), view.toY(doc.blocks.place_y_um[0]), 6, 0, 2 * Math.PI);
    pen.strokeStyle = colours().start;
    pen.lineWidth = 2.5;
    pen.stroke();
  }

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
   * Where a piece was: nothing, and its name if there is room.
   * @param {Pen} pen
   * @param {View} view
   * @param {Piece} piece
   */
  function drawGone(pen, view, piece) {
    const shades = colours();
    outline(pen, view, [piece.outline_um, ...piece.holes_um]);
    pen.fillStyle = shades.gone;
    pen.fill("evenodd");
    const text = words.piece(piece, doc.blocks);
    const room = rooms.get(piece);
    pen.font = "12px system-ui, sans-serif";
    if (!room || pen.measureText(text).width + 12 > room.width * view.scale) return;
    pen.fillStyle = shades.muted;
    pen.textAlign = "center";
    pen.fillText(text, view.toX(room.x), view.toY(room.y) + 4);
  }

  return {
    travel: { left, bottom, right, top },
    /**
     * Travel, work and clamps.
     * @param {Pen} pen
     * @param {View} view
     */
    drawGround(pen, view) {
      const shades = colours();
      body(pen, view, travel, shades.table, shades.line);
      if (doc.work_um) body(pen, view, doc.work_um, shades.work, shades["work-edge"]);
      for (const clamp of doc.clamps) body(pen, view, clamp.outline_um, shades.clamp, shades["clamp-edge"]);
    },
    /**
     * The ideal path over the kerf.
     * @param {Pen} pen
     * @param {View} view
     * @param {number} ratio
     * @param {boolean} isMoving
     */
    drawIdeal(pen, view, ratio, isMoving) {
      if (ideal.cover(view, ratio, isMoving)) ideal.took(drawIdeal(ideal));
      ideal.copyTo(pen, view);
      drawStart(pen, view);
    },
    /**
     * Pieces that are free at a time; those that came free since the last frame fall, if the replay plays.
     * @param {Pen} pen
     * @param {View} view
     * @param {number} t
     * @param {number} now
     * @param {boolean} mayFall
     */
    drawPieces(pen, view, t, now, mayFall) {
      const free = doc.pieces.filter((piece) => piece.t_s <= t);
      if (free.length < gone || !mayFall) falls.clear();
      for (const piece of mayFall ? free.slice(gone) : []) falls.set(piece, now);
      gone = free.length;
      for (const piece of free) drawGone(pen, view, piece);
      for (const [piece, since] of falls) {
        const share = (now - since) / DROP_MS;
        if (share >= 1) falls.delete(piece);
        else drawFalling(pen, view, piece, share);
      }
    },
    /** Whether something falls still, so that frames are needed. */
    get isFalling() { return falls.size > 0; },
    get isTrue() { return ideal.isTrue; },
    spoil: ideal.spoil,
  };
}

/**
 * Box of the table's travel.
 * @param {ReplayDocument} doc
 * @returns {Box}
 */
function travelOf(doc) {
  const [[left, bottom], [right, top]] = doc.travel_um;
  return { left, bottom, right, top };
}
