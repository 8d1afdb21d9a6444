// The clock of the replay: where it stands, how fast it runs, and the stretch that it goes round.
import { clamp, countUpTo } from "./numbers.js";

/**
 * @import { Blocks } from "./document.js"
 * @import { Deviation, Model } from "./model.js"
 * @import { Way } from "./way.js"
 */

/** @typedef {{ t: number, step: number, block: number }} Standing Where the replay stands; of the block its row. */
/** @typedef {{ from: number | null, to: number | null, isOn: boolean }} Loop Times, s. */
/** @typedef {{ t: number, isShut: () => boolean, reached: () => void }} Gate */
/** @typedef {ReturnType<typeof playerOf>} Player */
/** @typedef {ReturnType<Player["state"]>} PlayerState */
/** @typedef {PlayerState & { deviation: Deviation, isAsked: boolean }} Moment What a frame shows. */

/**
 * What of a replay is played: its blocks by their steps and times, and where the steps lead.
 * @typedef {{ doc: { blocks: Pick<Blocks, "kind" | "first_step" | "border_s"> }, steps: number, way: Pick<Way, "x" | "y"> }} Played
 */
/** @typedef {Pick<Model, "duration" | "stepAt" | "timeOf" | "blockAt" | "countLeft" | "stateAt">} Timed */

export const SLOWEST = 0.01;
export const FASTEST = 10000;
const LONGEST_FRAME_S = 0.25; // a hidden page does not leap when it comes back
const WATCHED_S = 60; // how long a whole replay lasts at first

/**
 * The next speed of 1, 2, 5, 10, 20 … in a direction.
 * @param {number} speed
 * @param {number} direction
 */
function roundSpeed(speed, direction) {
  const decade = 10 ** Math.floor(Math.log10(speed) + 1e-9);
  const all = [0.5, 1, 2, 5, 10, 20].map((digit) => digit * decade);
  const next = direction > 0 ? all.find((one) => one > speed * 1.001) : all.reverse().find((one) => one < speed * 0.999);
  return clamp(next ?? speed, SLOWEST, FASTEST);
}

/**
 * Player of a replay; `onChange` listeners hear of everything that is set, not of time going by.
 * @param {Played} replay
 * @param {Timed} model
 */
export function playerOf(replay, model) {
  const { first_step: firstStep, border_s: border } = replay.doc.blocks;
  const blocks = replay.doc.blocks.kind.length;
  /** @type {(() => void)[]} */
  const listeners = [];
  /** @type {Gate[]} */
  const gates = [];
  /** @type {Standing} */
  let place = { t: 0, step: 0, block: 0 };
  let playing = false;
  let speed = Math.min(FASTEST, Math.max(1, roundSpeed(model.duration / WATCHED_S, 1)));
  /** @type {Loop} */
  let loop = { from: null, to: null, isOn: false };

  const tell = () => listeners.forEach((listener) => listener());

  /**
   * Place at a time; times of steps are rounded, and still those of a block lie between its borders.
   * @param {number} t
   * @returns {Standing}
   */
  function placeAt(t) {
    const block = model.blockAt(t);
    const step = Math.min(Math.max(model.stepAt(t), firstStep[block]), firstStep[block + 1]);
    return { t, step, block };
  }

  /**
   * Block that makes the step after so many are done.
   * @param {number} step
   */
  const blockAfter = (step) => Math.max(0, Math.min(blocks, countUpTo(firstStep, step)) - 1);

  /**
   * Be at a place.
   * @param {Standing} newPlace
   */
  function set(newPlace) {
    place = newPlace;
    tell();
  }

  /**
   * The first gate that time passes.
   * @param {number} since
   * @param {number} until
   */
  function gateBetween(since, until) {
    const passed = gates.filter((gate) => gate.isShut() && gate.t >= since && gate.t <= until);
    return passed.length ? passed.reduce((first, gate) => (first.t <= gate.t ? first : gate)) : null;
  }

  /**
   * Where time gets to from `since`, round the loop or up to the end.
   * @param {number} since
   * @param {number} until
   */
  function goOn(since, until) {
    const { from, to } = loop;
    const goesRound = loop.isOn && from !== null && to !== null && since < to && until >= to;
    if (goesRound) return from + ((until - to) % (to - from));
    if (until < model.duration) return until;
    playing = false;
    return model.duration;
  }

  const api = {
    get playing() { return playing; },
    get speed() { return speed; },
    get loop() { return loop; },
    get place() { return place; },
    duration: model.duration,
    blocks,
    /** @param {() => void} listener */
    onChange: (listener) => listeners.push(listener),
    /**
     * Stop at a time for as long as `isShut()`, and call `reached()`.
     * @param {Gate} gate
     */
    addGate: (gate) => gates.push(gate),
    /** @param {number} t */
    seek: (t) => set(placeAt(clamp(t, 0, model.duration))),
    /** @param {number} row */
    seekBlock(row) {
      const block = clamp(row, 0, blocks - 1);
      const t = Math.min(border[block], model.duration);
      set(t < border[block] ? placeAt(t) : { t, step: firstStep[block], block });
    },
    /** @param {number} number */
    seekStep(number) {
      const step = clamp(number, 0, replay.steps);
      set({ t: model.timeOf(step), step, block: blockAfter(step) });
    },
    /** @param {number} count */
    stepBy(count) {
      api.pause();
      api.seekStep(place.step + count);
    },
    /**
     * So many blocks on or back; back within a block leads to its start.
     * @param {number} count
     */
    blockBy(count) {
      api.pause();
      const isWithin = place.step > firstStep[place.block];
      const row = place.block + count + (count < 0 && isWithin ? 1 : 0);
      if (row >= blocks) api.seek(model.duration);
      else api.seekBlock(row);
    },
    play() {
      if (place.t >= model.duration) place = placeAt(loop.isOn && loop.from !== null ? loop.from : 0);
      playing = true;
      tell();
    },
    pause() {
      playing = false;
      tell();
    },
    toggle: () => (playing ? api.pause() : api.play()),
    /** @param {number} wanted */
    setSpeed(wanted) {
      speed = clamp(wanted, SLOWEST, FASTEST);
      tell();
    },
    /** @param {number} direction */
    faster: (direction) => api.setSpeed(roundSpeed(speed, direction)),
    /**
     * Begin or end the loop here; with both ends it is on.
     * @param {"from" | "to"} end
     */
    setLoop(end, t = place.t) {
      const from = end === "from" ? t : loop.from;
      const to = end === "to" ? t : loop.to;
      if (from === null || to === null) loop = { from, to, isOn: false };
      else loop = { from: Math.min(from, to), to: Math.max(from, to), isOn: from !== to };
      tell();
    },
    /** Go round the loop or not; round the running block where none is set. */
    toggleLoop() {
      let { from, to } = loop;
      if (from === null || to === null || from >= to) {
        to = Math.min(border[place.block + 1], model.duration);
        from = Math.min(border[place.block], to);
      }
      loop = { from, to, isOn: !loop.isOn && from < to };
      tell();
    },
    clearLoop() {
      loop = { from: null, to: null, isOn: false };
      tell();
    },
    /**
     * Let so much real time go by.
     * @param {number} seconds
     */
    advance(seconds) {
      if (!playing) return;
      const wanted = goOn(place.t, place.t + Math.min(seconds, LONGEST_FRAME_S) * speed);
      const gate = gateBetween(place.t, wanted);
      place = placeAt(gate ? gate.t : wanted);
      if (gate) {
        playing = false;
        gate.reached();
      }
      if (!playing) tell();
    },
    /** All that is known of the moment. */
    state() {
      const { step, block } = place;
      const commanded = { x: replay.way.x(step), y: replay.way.y(step), count_left: model.countLeft(block, step) };
      return { ...model.stateAt(place.t), ...place, ...commanded, playing, speed, loop };
    },
  };
  return api;
}
