// What lies still: travel of the table, work, clamps, the ideal path, the start.
import { newLayer } from "./layer.js";
import { outline } from "./outline.js";
import { pathOf } from "./path.js";

/**
 * @import { Place, ReplayDocument } from "./document.js"
 * @import { Handed } from "./handed.js"
 * @import { Layer } from "./layer.js"
 * @import { Colours } from "./palette.js"
 * @import { Path } from "./path.js"
 * @import { Pen } from "./pen.js"
 * @import { Box, View } from "./view.js"
 */

const CLOSE = 5; // px per µm: there the ideal path is drawn for itself, not as a hint

/**
 * Scene of a replay's document.
 * @param {Handed} doc
 * @param {Path} path
 * @param {Colours} colours
 */
export function sceneOf(doc, path, colours) {
  const { left, bottom, right, top } = travelOf(doc);
  /** @type {Place[]} */
  const travel = [[left, bottom], [right, bottom], [right, top], [left, top]];
  const ideal = newLayer();
  const drawing = doc.drawing && pathOf(doc.drawing);
  const faces = doc.faces.map(pathOf);

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
   * What a leaning wire cuts at the bottom or the top of the work; how many points that took.
   * @param {Path} face
   * @param {string} shade
   * @param {Pen} pen
   * @param {View} view
   * @param {number} coarseness
   */
  function drawFace(face, shade, pen, view, coarseness) {
    pen.strokeStyle = shade;
    pen.lineWidth = 2;
    return face.stroke(pen, view, (kind) => kind !== "jump", coarseness);
  }

  /**
   * The path as the drawing means it, thin, jumps dashed; how many points that took.
   * @param {Layer} layer
   */
  function drawIdeal({ pen, view, coarseness }) {
    const shades = colours();
    const isClose = view.scale > CLOSE;
    const ends = faces.map((face, at) => drawFace(face, [shades.bottom, shades.top][at], pen, view, coarseness));
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
    return ends.reduce((sum, points) => sum + points, solid + dashed);
  }

  /**
   * The drawing that the cut was held against: the edge of the kerf runs on it where the part is as drawn.
   * @param {Pen} pen
   * @param {View} view
   * @param {Path} drawn
   */
  function drawDrawing(pen, view, drawn) {
    pen.strokeStyle = colours().drawing;
    pen.lineWidth = 2.5;
    drawn.stroke(pen, view, (kind) => kind !== "jump");
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
     * The drawing and the ideal path over the kerf.
     * @param {Pen} pen
     * @param {View} view
     * @param {number} ratio
     * @param {boolean} isMoving
     */
    drawIdeal(pen, view, ratio, isMoving) {
      if (drawing) drawDrawing(pen, view, drawing);
      if (ideal.cover(view, ratio, isMoving)) ideal.took(drawIdeal(ideal));
      ideal.copyTo(pen, view);
      drawStart(pen, view);
    },
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
