// What the control under sparks did at the moment that is shown: meters, its own time, and what happened in the block.
import { clock } from "../../html/assets/clock.js";
import { both, element, make } from "../../html/assets/elements.js";
import { newGauge } from "../../panel_page/assets/gauge.js";

/** @import { Said } from "../../html/assets/language.js" */

/** Written by `make pages` from the model in Python. */

/**
 * Means of the instruments, in the order of the steps at which they were seen.
 * @typedef {object} SparkTape
 * @property {number} open_v
 * @property {number | null} set_share
 * @property {number[]} step
 * @property {number[]} t_s
 * @property {number[]} voltage
 * @property {number[]} current
 * @property {SparkEvent[]} events
 */

/**
 * Something that happened: in which row of the toolpath, when in the cut under sparks, and its words.
 * @typedef {object} SparkEvent
 * @property {number} row
 * @property {number} t_s
 * @property {Said} what
 */

/** Up to here. */

/**
 * What tells where the replay stands.
 * @typedef {object} Watched
 * @property {Promise<unknown>} ready
 * @property {() => { step: number, block: number }} [state]
 */

/**
 * The row of the tape that was seen nearest to a step.
 * @param {number[]} steps in order
 * @param {number} step
 */
export function nearest(steps, step) {
  let [low, high] = [0, steps.length - 1];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (steps[middle] < step) low = middle + 1;
    else high = middle;
  }
  return low > 0 && step - steps[low - 1] < steps[low] - step ? low - 1 : low;
}

/**
 * Show the instruments for as long as the page lasts.
 * @param {Watched} player
 */
export async function begin(player) {
  /** @type {SparkTape} */
  const tape = JSON.parse(element("#spark-tape", HTMLElement).textContent);
  const volts = newGauge(/** @type {Element} */ (document.querySelector("#spark-volts")), tape.open_v, "V");
  const amps = newGauge(/** @type {Element} */ (document.querySelector("#spark-amps")), 100, "%");
  const time = element("#spark-time", HTMLElement);
  const list = element("#spark-events", HTMLElement);
  volts.mark(tape.set_share);
  amps.mark(null);
  await player.ready;
  let last = performance.now();
  let block = -1;

  /** @param {number} now */
  function frame(now) {
    const state = player.state?.();
    const real_s = Math.min((now - last) / 1000, 0.5);
    last = now;
    if (state && tape.step.length) {
      const at = nearest(tape.step, state.step);
      volts.follow(tape.voltage[at], real_s);
      amps.follow(tape.current[at], real_s);
      const text = clock(tape.t_s[at]);
      if (time.textContent !== text) time.textContent = text;
      if (state.block !== block) {
        block = state.block;
        list.replaceChildren(...tape.events.filter(({ row }) => row === block).slice(0, 4)
          .map(({ t_s, what }) => make("li", {}, make("span", { className: "mono" }, `${clock(t_s)} `), ...both(what))));
      }
    }
    window.requestAnimationFrame(frame);
  }
  window.requestAnimationFrame(frame);
}
