// Puts the panel together: the cut goes on with real time, and the instruments show it.
import { clock } from "../../html/assets/clock.js";
import { both, element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { newCounters } from "./counters.js";
import { readPanel } from "./data.js";
import { newFigure } from "./figure.js";
import { newGauge } from "./gauge.js";
import { newKeys } from "./keys.js";
import { newCut } from "./machine.js";
import { mean_current, mean_voltage, path_to_um, place_um } from "./plain_gap.js";
import {
  BREAKS_AGAIN, BROKEN, COLLIDED, FARTHEST, FAR_ROW, FINISHED, IN_VAIN, LOGGED, POWERLESS, ROW, RUNNING, SHORTED, SHORT_US, STALLED, TICKS, TICK_S,
} from "./plain_state.js";
import { widen } from "./plain_walls.js";
import { newReadouts } from "./readouts.js";
import { readSitting, saveSitting } from "./sitting.js";

const panel = readPanel();
const figure = newFigure(element("#figure", HTMLCanvasElement), panel);
const readouts = newReadouts(panel);
const voltmeter = newGauge(/** @type {Element} */ (document.querySelector("#voltmeter")), panel.open_v, "V");
const ammeter = newGauge(/** @type {Element} */ (document.querySelector("#ammeter")), 100, "%");
ammeter.mark(null);
const list = element("#events ol", HTMLElement);
const alarm = element("#alarm", HTMLElement);
/** @type {Record<number, string>} */
const ALARMS = {
  [IN_VAIN]: "in_vain", [SHORTED]: "shorted", [STALLED]: "stalled", [BREAKS_AGAIN]: "breaks_again", [BROKEN]: "broken", [COLLIDED]: "collided",
  [POWERLESS]: "powerless", [FINISHED]: "finished",
};
const CHUNK = 50; // ticks between looks at the time
const BUDGET_MS = 11; // of a frame
const FORGETS_S = 2;
const WALLS_S = 0.4;

let cut = newCut(panel);
let counters = newCounters(panel);
let times = 10;
let last = performance.now();
const wider_um = new Float64Array(cut.job.records.lit_s.length);
const walls = {
  usual_s: Float64Array.from(panel.usual_s), gap_um: Float64Array.from(panel.gap_um), start_um: Float64Array.from(panel.start_um), stretch_um: panel.stretch_um, half: panel.half,
};
const seen = { voltage: 0, feed_um_s: 0, speed: 0, at_um: 0, walls: -1, listed: 0, status: -1, owed: 0 };

/** Begin anew, or play an earlier sitting. @param {Parameters<typeof newCut>[1]} presses */
function begin(presses = []) {
  cut = newCut(panel, presses);
  counters = newCounters(panel);
  Object.assign(seen, { voltage: 0, feed_um_s: 0, at_um: 0, walls: -1, listed: 0, status: -1, owed: 0 });
  list.replaceChildren();
}

/** @param {number} real_s */
function goOn(real_s) {
  const until = performance.now() + BUDGET_MS;
  seen.owed = Math.min(seen.owed + (real_s * times) / TICK_S, (0.25 * times) / TICK_S);
  let went = 0;
  while (seen.owed >= 1 && cut.status === RUNNING && performance.now() < until) {
    const ticks = Math.min(Math.floor(seen.owed), CHUNK);
    cut.advance(ticks);
    seen.owed -= ticks;
    went += ticks;
  }
  if (cut.status !== RUNNING) seen.owed = 0;
  return went * TICK_S;
}

/** @param {number} machine_s @param {number} real_s */
function measure(machine_s, real_s) {
  const { state } = cut;
  const isStill = cut.status !== RUNNING;
  const isWireless = cut.status === BROKEN || cut.status === BREAKS_AGAIN; // then the gap is open
  voltmeter.follow(isStill ? Number(isWireless) : mean_voltage(state), real_s);
  ammeter.follow(isStill ? 0 : mean_current(cut.job, state), real_s);
  seen.voltage = voltmeter.shown();
  const here = place_um(cut.job, state);
  if (machine_s > 0) {
    const feed = (here - seen.at_um) / machine_s;
    seen.feed_um_s += (feed - seen.feed_um_s) * (1 - Math.exp(-machine_s / FORGETS_S));
    seen.speed += (machine_s / Math.max(real_s, 1e-3) - seen.speed) * 0.1;
  } else seen.speed *= 0.9;
  seen.at_um = here;
}

/** Work out the walls, now and then, and where the cut stands. @param {number} now_s */
function lookAtWalls(now_s) {
  if (now_s - seen.walls < WALLS_S && seen.walls >= 0 && seen.status === cut.status) return;
  seen.walls = now_s;
  widen(walls, cut.job.way.along_um, cut.job.records.lit_s, wider_um);
}

/** Add what happened to the list. */
function tellEvents() {
  const { state, job } = cut;
  const logged = Math.min(state[LOGGED], job.records.log.length / 4);
  while (seen.listed < logged) {
    const [t_s, at, kind] = job.records.log.slice(4 * seen.listed, 4 * seen.listed + 3);
    let row = 0;
    while (row < panel.blocks.length - 1 && at >= job.way.before[row + 1]) row += 1;
    const text = language.said(`event_${kind}`, { block: panel.blocks[row] });
    list.prepend(make("li", {}, make("span", { className: "mono" }, `${clock(t_s)} `), ...both(text)));
    while (list.childElementCount > 60) list.lastElementChild?.remove();
    seen.listed += 1;
  }
}

/** Say why the control stands, and what can be done. */
function tellStatus() {
  if (seen.status === cut.status) return;
  seen.status = cut.status;
  const key = ALARMS[cut.status];
  alarm.hidden = !key;
  alarm.className = cut.status === FINISHED ? "good" : "";
  if (key) alarm.replaceChildren(...both(language.said(key, result())));
}

/** What came of the cut so far. */
function result() {
  const far = Math.max(Math.floor(farUm() / panel.stretch_um) - panel.half, 0); // nearer walls are still being cut
  const cutWalls = wider_um.subarray(0, far);
  const widest = cutWalls.reduce((most, value) => Math.max(most, value), 0);
  const narrowest = cutWalls.reduce((least, value) => Math.min(least, value), 0);
  return { time: clock(cut.state[TICKS] * TICK_S), widest: widest.toFixed(1), narrowest: (-narrowest).toFixed(1) };
}

/** How far along the path the wire has come. */
function farUm() {
  return path_to_um(cut.job, cut.state[FAR_ROW], cut.state[FARTHEST]);
}

/** @param {number} now */
function frame(now) {
  const real_s = Math.min((now - last) / 1000, 0.25);
  last = now;
  const machine_s = goOn(real_s);
  measure(machine_s, real_s);
  lookAtWalls(now / 1000);
  voltmeter.mark(panel.law === "voltage" ? cut.settings().set : null);
  keys.write();
  const row = Math.trunc(cut.state[ROW]);
  readouts.show(cut, counters.at(row, Math.min(cut.made(), cut.job.way.before[row + 1] - cut.job.way.before[row])), seen);
  figure.draw({ place_um: seen.at_um, far_um: farUm(), wider_um, is_short: cut.state[SHORT_US] > 0 });
  tellEvents();
  tellStatus();
  window.requestAnimationFrame(frame);
}

const keys = newKeys({
  press: (name, value) => cut.press(name, value),
  speed: (value) => { times = value; },
  now: () => cut.settings(),
});
element("#again", HTMLButtonElement).addEventListener("click", () => begin());
element("#save", HTMLButtonElement).addEventListener("click", () => saveSitting(panel, cut));
element("#load", HTMLInputElement).addEventListener("change", async (event) => {
  const input = /** @type {HTMLInputElement} */ (event.target);
  const presses = await readSitting(panel, input);
  element("#unread", HTMLElement).hidden = presses !== null;
  if (presses) begin(presses);
});
language.onChange(() => { seen.status = -1; });
language.begin();
Object.assign(window, { drycutPanel: { cut: () => cut, begin } });
window.requestAnimationFrame(frame);
