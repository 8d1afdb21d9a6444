// The decisions of the interpolator beside their steps, as many as there is room for.
import { freeRoom } from "./free_room.js";
import * as words from "./words.js";

/**
 * @import { Replay } from "./decode.js"
 * @import { Free, Room } from "./free_room.js"
 * @import { Model } from "./model.js"
 * @import { Colours } from "./palette.js"
 * @import { Pen } from "./pen.js"
 * @import { Moment } from "./player.js"
 * @import { View } from "./view.js"
 */

/** @typedef {{ plate: Room, pole: Room }} Spot Where a text stands, and the line that leads to it. */

const ROW = 17; // px that a text takes, upwards
const FLAG_ROWS = 5;
const CROSS = 11; // px about the commanded and the actual place that stay free
const WRITTEN = 250; // decisions tried at once

/**
 * Plates right and left of a place, each with the pole that leads to it.
 * @param {number} px
 * @param {number} py
 * @param {number} width
 * @returns {Spot[]}
 */
function beside(px, py, width) {
  const [top, bottom] = [py - ROW / 2, py + ROW / 2];
  return [
    { plate: [px + 12, top, px + 12 + width, bottom], pole: [px + 4, py, px + 12, py] },
    { plate: [px - 12 - width, top, px - 12, bottom], pole: [px - 12, py, px - 4, py] },
  ];
}

/**
 * Plates at the ends of poles of growing length, up and down, flying to either side.
 * @param {number} px
 * @param {number} py
 * @param {number} width
 */
function flags(px, py, width) {
  /** @type {Spot[]} */
  const spots = [];
  for (let row = 0; row < FLAG_ROWS; row++) {
    const away = 8 + row * (ROW + 2);
    for (const left of [px - 3, px + 3 - width]) {
      spots.push(
        { plate: [left, py - away - ROW, left + width, py - away], pole: [px, py - away, px, py - 4] },
        { plate: [left, py + away, left + width, py + away + ROW], pole: [px, py + 4, px, py + away] },
      );
    }
  }
  return spots;
}

/**
 * Labels of a replay's decisions.
 * @param {Replay} replay
 * @param {Model} model
 * @param {Colours} colours
 */
export function decisionLabels({ steps: last, way: { x, y } }, model, colours) {
  /**
   * A text on a light ground, framed where it is of the next step.
   * @param {Pen} pen
   * @param {string} text
   * @param {Spot} spot
   * @param {boolean} isNext
   */
  function letter(pen, text, { plate: [left, top, right, bottom], pole }, isNext) {
    const shades = colours();
    pen.strokeStyle = shades.ink;
    pen.lineWidth = isNext ? 1.5 : 1;
    pen.beginPath();
    pen.moveTo(pole[0], pole[1]);
    pen.lineTo(pole[2], pole[3]);
    pen.stroke();
    pen.fillStyle = shades.page;
    pen.globalAlpha = 0.88;
    pen.fillRect(left, top, right - left, bottom - top);
    pen.globalAlpha = 1;
    if (isNext) pen.strokeRect(left, top, right - left, bottom - top);
    pen.fillStyle = shades.ink;
    pen.textAlign = "left";
    pen.fillText(text, left + 4, top + 13);
  }

  /**
   * Write one decision where there is room for it: beside an upright step, on a flag over or under a level one.
   * @param {Pen} pen
   * @param {View} view
   * @param {Free} free
   * @param {number} at
   * @param {boolean} isNext
   */
  function write(pen, view, free, at, isNext) {
    const decision = model.decision(at);
    if (!decision) return;
    const text = words.decision(decision);
    pen.font = isNext ? "700 13px system-ui, sans-serif" : "12px system-ui, sans-serif";
    const width = pen.measureText(text).width + 8;
    const middleX = (view.toX(x(at - 1)) + view.toX(x(at))) / 2;
    const middleY = (view.toY(y(at - 1)) + view.toY(y(at))) / 2;
    const spots = x(at) === x(at - 1) ? beside(middleX, middleY, width) : flags(middleX, middleY, width);
    const spot = spots.find(({ plate, pole }) => free.isFree(plate) && free.isFree(pole));
    if (!spot) return;
    free.take(spot.plate);
    free.take(spot.pole);
    letter(pen, text, spot, isNext);
  }

  /**
   * Take the room of a step's edge.
   * @param {View} view
   * @param {Free} free
   * @param {number} at
   */
  function takeStep(view, free, at) {
    const before = Math.max(0, at - 1);
    const [ax, ay, bx, by] = [view.toX(x(before)), view.toY(y(before)), view.toX(x(at)), view.toY(y(at))];
    free.take([Math.min(ax, bx) - 3, Math.min(ay, by) - 3, Math.max(ax, bx) + 3, Math.max(ay, by) + 3]);
  }

  return {
    /**
     * Draw decisions beside their steps: of the next step first, then of those around it, as far as there is room.
     * @param {Pen} pen
     * @param {View} view
     * @param {number[]} steps
     * @param {Moment} moment
     * @param {Room[]} covered
     */
    draw(pen, view, steps, { step, wire }, covered) {
      const free = freeRoom(view.width, view.height);
      for (const box of covered) free.take(box);
      for (const at of steps) takeStep(view, free, at);
      for (const [atX, atY] of [[x(step), y(step)], wire]) {
        const [px, py] = [view.toX(atX), view.toY(atY)];
        free.take([px - CROSS, py - CROSS, px + CROSS, py + CROSS]);
      }
      const next = step + 1;
      if (next <= last) write(pen, view, free, next, true);
      const others = steps.filter((at) => at > 0 && at !== next);
      others.sort((a, b) => Math.abs(a - next) - Math.abs(b - next));
      for (const at of others.slice(0, WRITTEN)) write(pen, view, free, at, false);
    },
  };
}
