// Single steps: the grid of 1 µm, and each step as an edge and a dot; beside them the decisions of the interpolator.
import { decisionLabels } from "./decision_labels.js";
import { countUpTo } from "./numbers.js";

/**
 * @import { Replay } from "./decode.js"
 * @import { Room } from "./free_room.js"
 * @import { Model } from "./model.js"
 * @import { Colours } from "./palette.js"
 * @import { Pen } from "./pen.js"
 * @import { Moment } from "./player.js"
 * @import { Box, View } from "./view.js"
 */

const GRID_FROM = 14; // px per µm
const TEXT_FROM = 22;
const MOST = 1500; // steps shown at once: those near the one that runs

/**
 * Single steps of a replay.
 * @param {Replay} replay
 * @param {Model} model
 * @param {Colours} colours
 */
export function microOf(replay, model, colours) {
  const { steps: last, way: { x, y, visitNear } } = replay;
  const labels = decisionLabels(replay, model, colours);

  /**
   * Steps in a box, those nearest to `step` in the order of their number.
   * @param {Box} near
   * @param {number} step
   */
  function stepsIn(near, step) {
    /** @type {number[]} */
    const found = [];
    visitNear(near, (run) => {
      for (let index = 0; index < run.size; index++) {
        const [atX, atY] = [run.x[index], run.y[index]];
        if (atX >= near.left && atX <= near.right && atY >= near.bottom && atY <= near.top) found.push(run.first + index);
      }
    });
    if (found.length <= MOST) return found;
    const middle = countUpTo(found, step);
    const since = Math.max(0, Math.min(middle - MOST / 2, found.length - MOST));
    return found.slice(since, since + MOST);
  }

  /**
   * The grid of whole µm.
   * @param {Pen} pen
   * @param {View} view
   * @param {Box} near
   */
  function grid(pen, view, near) {
    pen.beginPath();
    for (let across = Math.ceil(near.left); across <= near.right; across++) {
      pen.moveTo(view.toX(across), 0);
      pen.lineTo(view.toX(across), view.height);
    }
    for (let up = Math.ceil(near.bottom); up <= near.top; up++) {
      pen.moveTo(0, view.toY(up));
      pen.lineTo(view.width, view.toY(up));
    }
    pen.strokeStyle = colours().ink;
    pen.globalAlpha = 0.13;
    pen.lineWidth = 1;
    pen.stroke();
    pen.globalAlpha = 1;
  }

  /**
   * Edges of steps.
   * @param {Pen} pen
   * @param {View} view
   * @param {number[]} steps
   */
  function edges(pen, view, steps) {
    pen.beginPath();
    for (const at of steps) {
      if (at === 0 || at > last) continue;
      pen.moveTo(view.toX(x(at - 1)), view.toY(y(at - 1)));
      pen.lineTo(view.toX(x(at)), view.toY(y(at)));
    }
    pen.stroke();
  }

  /**
   * Edges and dots of steps.
   * @param {Pen} pen
   * @param {View} view
   * @param {number[]} steps
   * @param {number} step
   */
  function stairs(pen, view, steps, step) {
    edges(pen, view, steps);
    for (const at of steps) {
      pen.beginPath();
      pen.arc(view.toX(x(at)), view.toY(y(at)), at === step ? 5 : 3, 0, 2 * Math.PI);
      pen.fill();
    }
  }

  /**
   * The staircase: steps to come thin, those done bold, the next one emphasised; done ones alone in a question.
   * @param {Pen} pen
   * @param {View} view
   * @param {number[]} steps
   * @param {Moment} moment
   */
  function staircase(pen, view, steps, { step, isAsked }) {
    const shades = colours();
    const done = countUpTo(steps, step);
    pen.lineCap = "round";
    pen.strokeStyle = shades.steps;
    pen.fillStyle = shades.steps;
    pen.globalAlpha = 0.45;
    pen.lineWidth = 1.5;
    if (!isAsked) stairs(pen, view, steps.slice(done), step);
    pen.globalAlpha = 1;
    pen.lineWidth = 2.5;
    stairs(pen, view, steps.slice(0, done), step);
    pen.strokeStyle = shades.ink;
    pen.lineWidth = 4;
    if (!isAsked) edges(pen, view, [step + 1]);
  }

  return {
    /**
     * Whether single steps can be told apart at a scale.
     * @param {number} scale
     */
    shows: (scale) => scale >= GRID_FROM,
    /**
     * Draw the steps about a moment; `covered` are boxes of the window that show nothing.
     * @param {Pen} pen
     * @param {View} view
     * @param {Moment} moment
     * @param {Room[]} covered
     */
    draw(pen, view, moment, covered) {
      const near = view.bounds();
      const wider = { left: near.left - 1, right: near.right + 1, bottom: near.bottom - 1, top: near.top + 1 };
      const steps = stepsIn(wider, moment.step);
      grid(pen, view, near);
      staircase(pen, view, steps, moment);
      if (view.scale >= TEXT_FROM && !moment.isAsked) labels.draw(pen, view, steps, moment, covered);
    },
  };
}
