// The kerf: a band as wide as wire and spark gaps, wherever the wire really was while it cut. Each pass over an edge
// draws it anew in its own colour, so that the band shows how far the running pass is.
import { detailOf } from "./detail.js";
import { inkOf } from "./ink.js";
import { newLayer } from "./layer.js";

/**
 * @import { Samples } from "./decode.js"
 * @import { PassPaint, Place } from "./document.js"
 * @import { Colours } from "./palette.js"
 * @import { Pen } from "./pen.js"
 * @import { View } from "./view.js"
 */

const LEAST_WIDTH = 4; // px: thinner, it would hide under the ideal path

/** @typedef {ReturnType<typeof kerfOf>} Kerf */
/** @typedef {PassPaint | null} Cut The colour in which the wire cut on its way to a sample; null where it did not. */

/** @typedef {(at: number) => number} WidthOf How wide the wire cut on its way to a sample, µm. */

/**
 * Marks the samples where cutting begins or ends, or goes on in another colour or width.
 * @param {Cut[]} cuts
 * @param {WidthOf} widthUm
 */
function borders(cuts, widthUm) {
  const marks = new Uint8Array(cuts.length);
  for (let at = 0; at + 1 < cuts.length; at++) {
    marks[at] = cuts[at] !== cuts[at + 1] || widthUm(at) !== widthUm(at + 1) ? 1 : 0;
  }
  return marks;
}

/**
 * Kerf of a replay; `cuts` has one entry a sample.
 * @param {Pick<Samples, "wireX" | "wireY">} samples
 * @param {Cut[]} cuts
 * @param {WidthOf} widthUm
 * @param {Colours} colours
 */
export function kerfOf(samples, cuts, widthUm, colours) {
  const { wireX, wireY } = samples;
  const line = detailOf(wireX, wireY, borders(cuts, widthUm));
  const layer = newLayer();
  const widestUm = cuts.reduce((most, _, at) => Math.max(most, widthUm(at)), 0);
  let drawn = 0; // samples on the layer

  /**
   * The widest band at a scale, px.
   * @param {number} scale
   */
  function widestPx(scale) {
    return Math.max(LEAST_WIDTH, widestUm * scale);
  }

  /**
   * Set a pen to draw the band.
   * @param {Pen} pen
   * @param {number} scale
   * @param {PassPaint} paint
   * @param {number} width µm
   */
  function dip(pen, scale, paint, width) {
    pen.strokeStyle = colours()[paint];
    pen.lineWidth = Math.max(LEAST_WIDTH, width * scale);
    pen.lineCap = "round";
    pen.lineJoin = "round";
  }

  /**
   * Draw the way from sample `first` to `last` on the layer.
   * @param {number} first
   * @param {number} last
   */
  function draw(first, last) {
    const { pen, view } = layer;
    const ink = inkOf(pen);
    /** @type {Cut} */
    let paint = "kerf";
    let width = widthUm(first);
    dip(pen, view.scale, paint, width);
    line.visit(view.scale / layer.coarseness, first, last, view.bounds(widestPx(view.scale)), (points, at, past) => {
      let before = points[at];
      pen.moveTo(view.toX(wireX[before]), view.toY(wireY[before]));
      for (let next = at + 1; next < past; next++) {
        const index = points[next];
        const cut = cuts[index];
        const isOther = cut !== null && (cut !== paint || widthUm(index) !== width);
        if (isOther) {
          ink.flush();
          paint = cut;
          width = widthUm(index);
          dip(pen, view.scale, paint, width);
        }
        if (ink.took(1) || isOther) pen.moveTo(view.toX(wireX[before]), view.toY(wireY[before]));
        if (cut) pen.lineTo(view.toX(wireX[index]), view.toY(wireY[index]));
        else pen.moveTo(view.toX(wireX[index]), view.toY(wireY[index]));
        before = index;
      }
    });
    ink.flush();
    layer.took(ink.points);
  }

  /**
   * Bring the layer to sample `last`; only what is new is drawn, unless the view or the way back asks for all.
   * @param {View} view
   * @param {number} ratio
   * @param {boolean} isMoving
   * @param {number} last
   */
  function bring(view, ratio, isMoving, last) {
    const isNew = layer.cover(view, ratio, isMoving);
    if (!isNew && last < drawn) layer.clear();
    const first = isNew || last < drawn ? 0 : drawn;
    if (last > first) draw(first, last);
    drawn = last;
  }

  return {
    /**
     * Draw the kerf up to a sample, and on to where the wire is.
     * @param {Pen} pen
     * @param {View} view
     * @param {number} ratio
     * @param {boolean} isMoving
     * @param {number} last
     * @param {Place} wire
     */
    draw(pen, view, ratio, isMoving, last, wire) {
      bring(view, ratio, isMoving, last);
      layer.copyTo(pen, view);
      const cut = cuts[last + 1];
      if (!cut) return;
      dip(pen, view.scale, cut, widthUm(last + 1));
      pen.beginPath();
      pen.moveTo(view.toX(wireX[last]), view.toY(wireY[last]));
      pen.lineTo(view.toX(wire[0]), view.toY(wire[1]));
      pen.stroke();
    },
    get isTrue() { return layer.isTrue; },
    spoil: layer.spoil,
  };
}
