// Numbers and lamps of the panel.
import { clock } from "../../html/assets/clock.js";
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import {
  AREA_RATE, AT, BREAKS, CHIP_UNTIL, DRUMLESS_UNTIL, FARTHEST, GAP_UM, LOST_TICKS, PUMPLESS_UNTIL, RETREATED_UM, ROW, RUNNING, SHORTS,
  SHORT_US, SPARKLESS_UNTIL, TICKS, TICK_S, TICK_SPARKS, WIRE_OUT, POWER_OUT,
} from "./plain_state.js";

/** @import { Cut } from "./machine.js" */
/** @import { Panel } from "./data.js" */

/** @param {number} um */
const mm = (um) => (um / 1000).toFixed(3).replace("-", "−");

/**
 * The readouts of a panel.
 * @param {Panel} panel
 */
export function newReadouts(panel) {
  /** @param {string} name @param {string} text */
  function write(name, text) {
    const output = element(`#out-${name}`, HTMLElement);
    if (output.textContent !== text) output.textContent = text;
  }
  /** @param {string} name @param {boolean} isLit */
  function lamp(name, isLit) {
    const found = element(`#lamp-${name}`, HTMLElement);
    if ((found.dataset.lit === "1") === isLit) return;
    found.dataset.lit = isLit ? "1" : "0";
    element(".state", HTMLElement, found).textContent = language.say(isLit ? "lit" : "dark");
  }

  return {
    /**
     * Show a cut.
     * @param {Cut} cut
     * @param {{ x_um: number, y_um: number, deviation: number, count_left_um: number }} counters
     * @param {{ voltage: number, feed_um_s: number, speed: number }} seen
     */
    show(cut, counters, { voltage, feed_um_s, speed }) {
      const { state, job } = cut;
      const row = Math.trunc(state[ROW]);
      const total = job.way.before[job.way.before.length - 1];
      const left_um = Math.max(job.way.along_um[job.way.along_um.length - 1] * (1 - state[FARTHEST] / total), 0);
      write("x", mm(counters.x_um));
      write("y", mm(counters.y_um));
      write("block", `${panel.blocks[row]} / ${panel.blocks[panel.blocks.length - 1]}`);
      write("text", panel.texts[row]);
      write("j", String(counters.count_left_um));
      write("f", String(counters.deviation).replace("-", "−"));
      write("done", `${((100 * state[AT]) / total).toFixed(1)} %`);
      write("time", clock(state[TICKS] * TICK_S));
      write("left", feed_um_s > 0.5 ? clock(left_um / feed_um_s) : "–");
      const isRunning = cut.status === RUNNING;
      write("feed", isRunning ? ((feed_um_s * 60) / 1000).toFixed(2) : "0");
      write("rate", isRunning ? state[AREA_RATE].toFixed(0) : "0");
      write("voltage", (voltage * panel.open_v).toFixed(0));
      write("gap", state[GAP_UM] >= 50 ? "≥ 50" : state[GAP_UM].toFixed(1).replace("-", "−"));
      write("shorts", String(state[SHORTS]));
      write("breaks", String(state[BREAKS]));
      write("back", mm(state[RETREATED_UM]));
      write("lost", clock(state[LOST_TICKS] * TICK_S));
      write("speed", `× ${speed < 10 ? speed.toFixed(1) : Math.round(speed)}`);
      lamp("sparks", isRunning && state[TICK_SPARKS] > 0);
      lamp("short", state[SHORT_US] > 0);
      lamp("chip", state[CHIP_UNTIL] > state[TICKS]);
      lamp("wire", state[WIRE_OUT] > 0);
      lamp("power", state[POWER_OUT] > 0);
      lamp("pump", state[PUMPLESS_UNTIL] > state[TICKS]);
      lamp("drum", state[DRUMLESS_UNTIL] > state[TICKS]);
      lamp("generator", state[SPARKLESS_UNTIL] > state[TICKS]);
    },
  };
}
