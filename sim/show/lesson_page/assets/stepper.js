// Steps of what was written: a slider, and where the wire stands then.
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { Point } from "./plain_curves.js";
import { after_steps, begun, stepped } from "./plain_stepping.js";

/** @import { Block } from "./plain_blocks.js" */
/** @import { Curve } from "./plain_curves.js" */

const MOST_STEPS = 2_000_000;

/**
 * How many steps a block makes.
 * @param {Block} block
 */
function stepsOf(block) {
  let stepper = begun(block);
  let steps = 0;
  while (stepper.count_left > 0 && steps < MOST_STEPS) {
    stepper = stepped(block, stepper);
    steps += 1;
  }
  return steps;
}

/**
 * A slider in a task.
 * @param {HTMLElement} form
 * @param {(at: Point | null) => void} onMove where the wire stands, null where nothing was stepped
 */
export function stepperIn(form, onMove) {
  const slider = element(".stepper input", HTMLInputElement, form);
  const output = element(".stepper output", HTMLElement, form);
  /** @type {{ block: Block, curve: Curve, before: number, steps: number }[]} */
  let rows = [];
  let all = 0;

  /** Say where the wire stands. */
  function write() {
    const number = Number(slider.value);
    const row = rows.find(({ before, steps }) => number <= before + steps);
    output.textContent = "";
    if (!row || !number) {
      onMove(null);
      return;
    }
    const { block, curve, before } = row;
    const stepper = after_steps(block, number - before);
    const from = block.turn === 0 ? curve.start : curve.centre;
    const at = Point(from.x + stepper.x, from.y + stepper.y);
    output.textContent = language.say("stepper", {
      block: rows.indexOf(row) + 1, step: number, steps: all, x: Math.round(at.x), y: Math.round(at.y),
      deviation: stepper.deviation, count: Math.max(stepper.count_left, 0),
    });
    onMove(at);
  }

  slider.addEventListener("input", write);
  language.onChange(write);

  return {
    /**
     * Step other blocks.
     * @param {Block[]} blocks
     * @param {Curve[]} curves
     */
    load(blocks, curves) {
      rows = [];
      all = 0;
      for (const [number, block] of blocks.entries()) {
        const steps = stepsOf(block);
        rows.push({ block, curve: curves[number], before: all, steps });
        all += steps;
        if (all >= MOST_STEPS) break;
      }
      slider.max = String(all);
      slider.value = "0";
      slider.disabled = all === 0;
      write();
    },
  };
}
