// The keys of the panel: buttons, and the same on the keyboard.
import { element, elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

const SPEEDS = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000];
const HAND_UM = 0.3; // in a tick of 1 ms
const STEP = 0.01;

/**
 * What the keys drive.
 * @typedef {object} Driven
 * @property {(name: string, value?: number) => void} press
 * @property {(times: number) => void} speed
 * @property {() => Settings} now
 */

/**
 * How the keys stand.
 * @typedef {object} Settings
 * @property {number} set
 * @property {number} on
 * @property {number} off
 * @property {string} mode
 * @property {Record<string, boolean>} pressed of the keys that stay down
 */

/**
 * Listen to the keys.
 * @param {Driven} driven
 */
export function newKeys(driven) {
  const at = { speed: 3, hand: 0 };
  const speed = element("#speed", HTMLInputElement);
  const mode = element("#mode", HTMLSelectElement);

  /** Write how the keys stand. */
  function write() {
    const now = driven.now();
    const times = SPEEDS[at.speed];
    const texts = { set: now.set.toFixed(2), off: `${now.off} µs`, on: `${now.on} µs`, speed: `× ${times}` };
    for (const [name, text] of Object.entries(texts)) {
      const output = element(`#${name}-value`, HTMLElement);
      if (output.textContent !== text) output.textContent = text;
    }
    for (const [name, isOn] of Object.entries(now.pressed)) element(`#key-${name}`, HTMLButtonElement).setAttribute("aria-pressed", String(isOn));
    if (mode.value !== now.mode) mode.value = now.mode;
    if (speed.value !== String(at.speed)) speed.value = String(at.speed);
    speed.setAttribute("aria-valuetext", language.say("times", { times }));
  }

  /** @param {"set" | "off" | "on"} name @param {number} by @param {number} low @param {number} high */
  function turn(name, by, low, high) {
    const before = driven.now()[name];
    const value = Math.round(Math.min(Math.max(before + by, low), high) * 1000) / 1000;
    if (value !== before) driven.press(name, value);
  }

  /** @param {number} to */
  function quicken(to) {
    at.speed = Math.min(Math.max(to, 0), SPEEDS.length - 1);
    driven.speed(SPEEDS[at.speed]);
  }

  /** @param {string} name */
  function toggle(name) {
    driven.press(name, Number(!driven.now().pressed[name]));
  }

  /** @param {number} way */
  function byHand(way) {
    if (at.hand === way) return;
    at.hand = way;
    driven.press("hand", way * HAND_UM);
  }

  /** @type {Record<string, () => void>} */
  const actions = {
    "set-less": () => turn("set", -STEP, 0.01, 0.99),
    "set-more": () => turn("set", STEP, 0.01, 0.99),
    "off-less": () => turn("off", -10, 10, 1000),
    "off-more": () => turn("off", 10, 10, 1000),
    "on-less": () => turn("on", -0.5, 0.5, 50),
    "on-more": () => turn("on", 0.5, 0.5, 50),
    "slower": () => quicken(at.speed - 1),
    "faster": () => quicken(at.speed + 1),
    "thread-place": () => driven.press("thread", 0),
    "thread-start": () => driven.press("thread", 1),
    "restart": () => driven.press("restart", 1),
    "restart-block": () => driven.press("restart", 0),
    "resume": () => driven.press("resume"),
    "chip": () => driven.press("chip"),
    "tear": () => driven.press("tear"),
    "fail": () => driven.press("fail"),
  };
  for (const name of ["hold", "sparks", "pump", "drum"]) actions[name] = () => toggle(name);
  for (const button of elements("[data-key]")) button.addEventListener("click", () => actions[button.dataset.key ?? ""]());
  for (const [id, way] of /** @type {[string, number][]} */ ([["#key-back", -1], ["#key-forward", 1]])) {
    const button = element(id, HTMLButtonElement);
    button.addEventListener("pointerdown", () => byHand(way));
    for (const end of ["pointerup", "pointerleave", "pointercancel", "blur"]) button.addEventListener(end, () => byHand(0));
    button.addEventListener("keydown", (event) => { if (event.key === " " || event.key === "Enter") byHand(way); });
    button.addEventListener("keyup", () => byHand(0));
  }
  speed.max = String(SPEEDS.length - 1);
  speed.addEventListener("input", () => quicken(Number(speed.value)));
  mode.addEventListener("change", () => driven.press("mode", mode.selectedIndex));

  /** @type {Record<string, string>} */
  const letters = {
    ArrowUp: "set-more", ArrowDown: "set-less", "+": "faster", "-": "slower", "=": "faster", h: "hold", s: "sparks", p: "pump", d: "drum",
    t: "thread-place", o: "thread-start", r: "resume", c: "chip", b: "tear", f: "fail", e: "restart",
  };
  window.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target instanceof HTMLInputElement || event.target instanceof HTMLSelectElement) return;
    if (event.key === "ArrowLeft") byHand(-1);
    else if (event.key === "ArrowRight") byHand(1);
    else if (event.key in letters) actions[letters[event.key]]();
    else return;
    event.preventDefault();
  });
  window.addEventListener("keyup", (event) => { if (event.key === "ArrowLeft" || event.key === "ArrowRight") byHand(0); });
  quicken(at.speed);
  return { write };
}
