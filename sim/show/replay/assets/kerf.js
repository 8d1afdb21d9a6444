// The kerf: a band as wide as wire and spark gaps, wherever the wire really was while it cut.
import { detailOf } from "./detail.js";
import { newLayer } from "./layer.js";

/**
 * @import { Samples } from "./decode.js"
 * @import { Place } from "./document.js"
 * @import { Colours } from "./palette.js"
 * @import { Pen } from "./pen.js"
 * @import { View } from "./view.js"
 */

const LEAST_WIDTH = 4; // px: thinner, it would hide under the ideal path

/**
 * Marks the samples where cutting begins or ends.
 * @param {Uint8Array} isCut
 */
function borders(isCut) {
  const marks = new Uint8Array(isCut.length);
  for (let at = 0; at + 1 < isCut.length; at++) marks[at] = isCut[at] !== isCut[at + 1] ? 1 : 0;
  return marks;
}

/**
 * Kerf of a replay; `isCut` tells of each sample whether the wire cut on its way there.
 * @param {Samples} samples
 * @param {Uint8Array} isCut
 * @param {number} widthUm
 * @param {Colours} colours
 */
export function kerfOf(samples, isCut, widthUm, colours) {
  const { wireX, wireY } = samples;
  const line = detailOf(wireX, wireY, borders(isCut));
  const layer = newLayer();
  let drawn = 0; // samples on the layer

  /**
   * Set a pen to draw the band.
   * @param {Pen} pen
   * @param {number} scale
   */
  function dip(pen, scale) {
    pen.strokeStyle = colours().kerf;
    pen.lineWidth = Math.max(LEAST_WIDTH, widthUm * scale);
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
    dip(pen, view.scale);
    pen.beginPath();
    line.visit(view.scale, first, last, view.bounds(pen.lineWidth), (points, at, past) => {
      pen.moveTo(view.toX(wireX[points[at]]), view.toY(wireY[points[at]]));
      for (let next = at + 1; next < past; next++) {
        const index = points[next];
        if (isCut[index]) pen.lineTo(view.toX(wireX[index]), view.toY(wireY[index]));
        else pen.moveTo(view.toX(wireX[index]), view.toY(wireY[index]));
      }
    });
    pen.stroke();
  }

  /**
   * Bring the layer to sample `last`; only what is new is drawn, unless the view or the way back asks for all.
   * @param {View} view
   * @param {number} ratio
   * @param {number} last
   */
  function bring(view, ratio, last) {
    const isNew = layer.cover(view, ratio);
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
     * @param {number} last
     * @param {Place} wire
     */
    draw(pen, view, ratio, last, wire) {
      bring(view, ratio, last);
      layer.copyTo(pen, view);
      if (last + 1 >= isCut.length || !isCut[last + 1]) return;
      dip(pen, view.scale);
      pen.beginPath();
      pen.moveTo(view.toX(wireX[last]), view.toY(wireY[last]));
      pen.lineTo(view.toX(wire[0]), view.toY(wire[1]));
      pen.stroke();
    },
    spoil: layer.spoil,
  };
}
