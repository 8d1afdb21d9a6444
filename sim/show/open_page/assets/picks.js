// What is picked of a drawing, and where the wire is threaded: places as they lie beneath a program, and their marks.

/** @import { Placement } from "./data.js" */
/** @import { View } from "../../replay/assets/view.js" */

/** @type {Placement} */
export const IN_PLACE = { turn_rad: 0, shift_um: [0, 0], mirror: false };

/**
 * A place of the drawing as it lies beneath the program.
 * @param {Placement} placement
 * @param {[x: number, y: number]} place
 * @returns {[x: number, y: number]}
 */
function laid({ turn_rad: turn, shift_um: [byX, byY], mirror }, [x, y]) {
  const [cos, sin, own] = [Math.cos(turn), Math.sin(turn), mirror ? -x : x];
  return [cos * own - sin * y + byX, sin * own + cos * y + byY];
}

/**
 * The place of the drawing that lies somewhere beneath the program.
 * @param {Placement} placement
 * @param {[x: number, y: number]} place
 * @returns {[x: number, y: number]}
 */
export function lifted({ turn_rad: turn, shift_um: [byX, byY], mirror }, [x, y]) {
  const [cos, sin] = [Math.cos(turn), Math.sin(turn)];
  const own = cos * (x - byX) + sin * (y - byY);
  return [mirror ? -own : own, cos * (y - byY) - sin * (x - byX)];
}

/**
 * The place that a pick names, mm; null where it names something else.
 * @param {string} pick
 * @returns {[x: number, y: number] | null}
 */
function placeOf(pick) {
  const [, x, y] = /^(-?[\d.]+) *, *(-?[\d.]+)$/.exec(pick) ?? [];
  return x && y ? [Number(x), Number(y)] : null;
}

/**
 * What stands in a field, one by one, with ; between.
 * @param {string} text
 */
function listed(text) {
  return text.split(";").map((each) => each.trim()).filter(Boolean);
}

/**
 * The places that a field names, as they lie beneath the program, µm.
 * @param {string} text
 * @param {Placement} placement
 * @returns {[x: number, y: number][]}
 */
export function placesIn(text, placement) {
  const places = listed(text).map(placeOf).filter((place) => place !== null);
  return places.map(([x, y]) => laid(placement, [1000 * x, 1000 * y]));
}

/**
 * Which of the places that a field names lies nearest to one of the picture, µm; −1 where none is near.
 * @param {string} text
 * @param {Placement} placement
 * @param {[x: number, y: number]} place
 * @param {number} nearUm
 */
export function numberAt(text, placement, place, nearUm) {
  const away = placesIn(text, placement).map(([x, y]) => Math.hypot(x - place[0], y - place[1]));
  const nearest = Math.min(...away);
  return nearest < nearUm ? away.indexOf(nearest) : -1;
}

/**
 * What stands in a field once one of its places is another one of the drawing, µm.
 * @param {string} text
 * @param {number} number among its places
 * @param {[x: number, y: number]} place
 */
export function moved(text, number, place) {
  let at = -1;
  const all = listed(text).map((each) => {
    if (placeOf(each)) at += 1;
    return placeOf(each) && at === number ? written(place) : each;
  });
  return all.join("; ");
}

/**
 * A place of the drawing, µm, as a field has it.
 * @param {[x: number, y: number]} place
 */
function written(place) {
  return place.map((um) => (um / 1000).toFixed(3)).join(",");
}

/**
 * What stands in a field once a place of the drawing, µm, is named in it, or the one near it no longer.
 * @param {string} text
 * @param {[x: number, y: number]} place
 * @param {number} nearUm
 */
export function toggled(text, place, nearUm) {
  const all = listed(text);
  const others = all.filter((each) => {
    const own = placeOf(each);
    return !own || Math.hypot(1000 * own[0] - place[0], 1000 * own[1] - place[1]) >= nearUm;
  });
  return (others.length < all.length ? others : [...all, written(place)]).join("; ");
}

/**
 * Draw the marks of thread points that are asked for: rings with a cross.
 * @param {CanvasRenderingContext2D} pen
 * @param {View} view
 * @param {[x: number, y: number][]} places
 * @param {string} shade
 */
export function drawStarts(pen, view, places, shade) {
  pen.strokeStyle = shade;
  pen.lineWidth = 2;
  for (const [x, y] of places) {
    const [across, down] = [view.toX(x), view.toY(y)];
    pen.beginPath();
    pen.arc(across, down, 7, 0, 2 * Math.PI);
    for (const [byX, byY] of [[12, 0], [0, 12]]) {
      pen.moveTo(across - byX, down - byY);
      pen.lineTo(across + byX, down + byY);
    }
    pen.stroke();
  }
}

/**
 * Draw the marks of where cuts are to start: small squares.
 * @param {CanvasRenderingContext2D} pen
 * @param {View} view
 * @param {[x: number, y: number][]} places
 * @param {string} shade
 */
export function drawEntries(pen, view, places, shade) {
  pen.fillStyle = shade;
  for (const [x, y] of places) pen.fillRect(view.toX(x) - 6, view.toY(y) - 6, 12, 12);
}

/**
 * Draw the marks of what is picked.
 * @param {CanvasRenderingContext2D} pen
 * @param {View} view
 * @param {[x: number, y: number][]} places
 * @param {string} shade
 */
export function drawPicks(pen, view, places, shade) {
  pen.fillStyle = pen.strokeStyle = shade;
  pen.lineWidth = 2;
  for (const [x, y] of places) {
    for (const radius of [9, 5]) {
      pen.beginPath();
      pen.arc(view.toX(x), view.toY(y), radius, 0, 2 * Math.PI);
      if (radius === 5) pen.fill();
      else pen.stroke();
    }
  }
}
