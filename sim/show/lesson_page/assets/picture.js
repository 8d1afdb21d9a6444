// The picture of a task: what is asked for, what an answer cuts, and places with their names.
import { point_on, points_on } from "./plain_curves.js";

/** @import { Curve, Point } from "./plain_curves.js" */

/**
 * A place with its name.
 * @typedef {object} Mark
 * @property {Point} at
 * @property {string} name
 * @property {string} [kind] a class: `place` where it is left out
 */

/**
 * What a picture shows.
 * @typedef {object} Scene
 * @property {Curve[]} drawing
 * @property {Curve[]} path
 * @property {Mark[]} marks
 */

const SPACE = "http://www.w3.org/2000/svg";
const WIDE = 720;
const HIGH = 480;
const EDGE = 46;
const BEYOND = 0.6; // of the extent of what is asked for: as far as a path is shown

/**
 * A new element of a picture.
 * @param {string} tag
 * @param {Record<string, string | number>} attributes
 */
function part(tag, attributes) {
  const made = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  return made;
}

/**
 * Draw a scene into a picture.
 * @param {Element} svg
 * @param {Scene} scene
 */
export function draw(svg, { drawing, path, marks }) {
  const frame = frameOf(drawing, path, marks);
  /** @param {Point} at */
  const place = ({ x, y }) => [WIDE / 2 + (x - frame.x) / frame.unit, HIGH / 2 - (y - frame.y) / frame.unit];
  /** @param {Curve[]} curves */
  const data = (curves) => curves.map((curve, number) => pathOf(curve, number, place, frame.unit)).join("");
  svg.setAttribute("viewBox", `0 0 ${WIDE} ${HIGH}`);
  svg.replaceChildren(
    part("path", { class: "drawing", d: data(drawing) }),
    part("path", { class: "path", d: data(path) }),
    ...marks.flatMap((mark) => named(mark, place(mark.at))),
  );
}

/**
 * A dot and its name.
 * @param {Mark} mark
 * @param {number[]} at
 */
function named({ name, kind = "place" }, [x, y]) {
  const dot = part("circle", { class: kind, cx: x, cy: y, r: 6 });
  const text = part("text", { class: kind, x: Math.min(Math.max(x + 10, 4), WIDE - 20 - 22 * name.length), y: y - 10 });
  text.textContent = name;
  return [dot, text];
}

/**
 * The middle of a picture, µm, and µm to a unit.
 * @param {Curve[]} drawing
 * @param {Curve[]} path
 * @param {Mark[]} marks
 */
function frameOf(drawing, path, marks) {
  const asked = drawing.length ? drawing : path;
  const wanted = boxOf([...asked.flatMap(points_on), ...marks.filter(({ kind }) => !kind).map(({ at }) => at)]);
  const near = BEYOND * Math.max(wanted.high_x - wanted.low_x, wanted.high_y - wanted.low_y);
  const reached = path.length ? boxOf(path.flatMap(points_on)) : wanted;
  const low = [Math.min(wanted.low_x, Math.max(reached.low_x, wanted.low_x - near)), Math.min(wanted.low_y, Math.max(reached.low_y, wanted.low_y - near))];
  const high = [Math.max(wanted.high_x, Math.min(reached.high_x, wanted.high_x + near)), Math.max(wanted.high_y, Math.min(reached.high_y, wanted.high_y + near))];
  const unit = Math.max((high[0] - low[0]) / (WIDE - 2 * EDGE), (high[1] - low[1]) / (HIGH - 2 * EDGE), 1e-3);
  return { x: (low[0] + high[0]) / 2, y: (low[1] + high[1]) / 2, unit };
}

/** @param {Point[]} points */
function boxOf(points) {
  const box = { low_x: Infinity, low_y: Infinity, high_x: -Infinity, high_y: -Infinity };
  for (const { x, y } of points) {
    box.low_x = Math.min(box.low_x, x);
    box.low_y = Math.min(box.low_y, y);
    box.high_x = Math.max(box.high_x, x);
    box.high_y = Math.max(box.high_y, y);
  }
  return points.length ? box : { low_x: 0, low_y: 0, high_x: 1, high_y: 1 };
}

/**
 * Path data of a curve, an arc in parts of half a turn at most.
 * @param {Curve} curve
 * @param {number} number
 * @param {(at: Point) => number[]} place
 * @param {number} unit µm
 */
function pathOf(curve, number, place, unit) {
  /** @param {Point} at */
  const text = (at) => place(at).map((value) => value.toFixed(1)).join(" ");
  const begins = number === 0 ? `M${text(curve.start)}` : "";
  if (curve.turn === 0) return `${begins}L${text(curve.end)}`;
  const parts = Math.max(Math.ceil(Math.abs(curve.sweep_rad) / Math.PI + 0.01), 1);
  const radius = (curve.radius / unit).toFixed(1);
  const ends = Array.from({ length: parts }, (_, part_) => text(point_on(curve, (part_ + 1) / parts)));
  return begins + ends.map((end) => `A${radius} ${radius} 0 0 ${curve.turn > 0 ? 0 : 1} ${end}`).join("");
}
