// The kerf: a band as wide as wire and spark gaps, wherever the wire really was while it cut.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const LEAST_WIDTH = 4; // px: thinner, it would hide under the ideal path

  /** Marks the samples where cutting begins or ends. */
  function borders(isCut) {
    const marks = new Uint8Array(isCut.length);
    for (let at = 0; at + 1 < isCut.length; at++) marks[at] = isCut[at] !== isCut[at + 1] ? 1 : 0;
    return marks;
  }

  /** Kerf of a replay; `isCut` tells of each sample whether the wire cut on its way there. */
  function kerf(samples, isCut, widthUm, colours) {
    const { wireX, wireY } = samples;
    const line = Drycut.detail(wireX, wireY, borders(isCut));
    const layer = Drycut.layer();
    let drawn = 0; // samples on the layer

    /** Set a pen to draw the band. */
    function dip(pen, scale) {
      pen.strokeStyle = colours().kerf;
      pen.lineWidth = Math.max(LEAST_WIDTH, widthUm * scale);
      pen.lineCap = "round";
      pen.lineJoin = "round";
    }

    /** Draw the way from sample `first` to `last` on the layer. */
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

    /** Bring the layer to sample `last`; only what is new is drawn, unless the view or the way back asks for all. */
    function bring(view, ratio, last) {
      const isNew = layer.cover(view, ratio);
      if (!isNew && last < drawn) layer.clear();
      const first = isNew || last < drawn ? 0 : drawn;
      if (last > first) draw(first, last);
      drawn = last;
    }

    return {
      /** Draw the kerf up to a sample, and on to where the wire is. */
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

  Drycut.kerf = kerf;
})(globalThis);
