// The clock of the replay: where it stands, how fast it runs, and the stretch that it goes round.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const SLOWEST = 0.01;
  const FASTEST = 10000;
  const LONGEST_FRAME_S = 0.25; // a hidden page does not leap when it comes back
  const WATCHED_S = 60; // how long a whole replay lasts at first

  /** The next speed of 1, 2, 5, 10, 20 … in a direction. */
  function roundSpeed(speed, direction) {
    const decade = 10 ** Math.floor(Math.log10(speed) + 1e-9);
    const all = [0.5, 1, 2, 5, 10, 20].map((digit) => digit * decade);
    const next = direction > 0 ? all.find((one) => one > speed * 1.001) : all.findLast((one) => one < speed * 0.999);
    return Math.min(FASTEST, Math.max(SLOWEST, next));
  }

  /** Player of a replay; `onChange` listeners hear of everything that is set, not of time going by. */
  function player(replay, model) {
    const { first_step: firstStep, border_s: border } = replay.doc.blocks;
    const blocks = replay.doc.blocks.kind.length;
    const listeners = [];
    const gates = [];
    let place = { t: 0, step: 0, block: 0 };
    let playing = false;
    let speed = Math.min(FASTEST, Math.max(1, roundSpeed(model.duration / WATCHED_S, 1)));
    let loop = { from: null, to: null, isOn: false };

    const tell = () => listeners.forEach((listener) => listener());
    const bounded = (value, most) => Math.min(most, Math.max(0, value));

    /** Place at a time; times of steps are rounded, and still those of a block lie between its borders. */
    function placeAt(t) {
      const block = model.blockAt(t);
      const step = Math.min(Math.max(model.stepAt(t), firstStep[block]), firstStep[block + 1]);
      return { t, step, block };
    }

    /** Block that makes the step after so many are done. */
    const blockAfter = (step) => Math.max(0, Math.min(blocks, Drycut.countUpTo(firstStep, step)) - 1);

    /** Be at a place. */
    function set(newPlace) {
      place = newPlace;
      tell();
    }

    /** The first gate that time passes. */
    function gateBetween(since, until) {
      const passed = gates.filter((gate) => gate.isShut() && gate.t >= since && gate.t <= until);
      return passed.reduce((first, gate) => (first && first.t <= gate.t ? first : gate), null);
    }

    /** Where time gets to from `since`, round the loop or up to the end. */
    function goOn(since, until) {
      if (loop.isOn && since < loop.to && until >= loop.to) return loop.from + ((until - loop.to) % (loop.to - loop.from));
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
      onChange: (listener) => listeners.push(listener),
      /** Stop at a time for as long as `isShut()`, and call `reached()`. */
      addGate: (gate) => gates.push(gate),
      seek: (t) => set(placeAt(bounded(t, model.duration))),
      seekBlock(row) {
        const block = bounded(row, blocks - 1);
        const t = Math.min(border[block], model.duration);
        set(t < border[block] ? placeAt(t) : { t, step: firstStep[block], block });
      },
      seekStep(number) {
        const step = bounded(number, replay.steps);
        set({ t: model.timeOf(step), step, block: blockAfter(step) });
      },
      stepBy(count) {
        api.pause();
        api.seekStep(place.step + count);
      },
      /** So many blocks on or back; back within a block leads to its start. */
      blockBy(count) {
        api.pause();
        const isWithin = place.step > firstStep[place.block];
        const row = place.block + count + (count < 0 && isWithin ? 1 : 0);
        if (row >= blocks) api.seek(model.duration);
        else api.seekBlock(row);
      },
      play() {
        if (place.t >= model.duration) place = placeAt(loop.isOn ? loop.from : 0);
        playing = true;
        tell();
      },
      pause() {
        playing = false;
        tell();
      },
      toggle: () => (playing ? api.pause() : api.play()),
      setSpeed(wanted) {
        speed = Math.min(FASTEST, Math.max(SLOWEST, wanted));
        tell();
      },
      faster: (direction) => api.setSpeed(roundSpeed(speed, direction)),
      /** Begin or end the loop here; with both ends it is on. */
      setLoop(end, t = place.t) {
        loop = { ...loop, [end]: t };
        if (loop.from !== null && loop.to !== null && loop.from > loop.to) loop = { ...loop, from: loop.to, to: loop.from };
        loop.isOn = loop.from !== null && loop.to !== null && loop.from < loop.to;
        tell();
      },
      /** Go round the loop or not; round the running block where none is set. */
      toggleLoop() {
        if (loop.from === null || loop.to === null || loop.from >= loop.to) {
          const until = Math.min(border[place.block + 1], model.duration);
          loop = { from: Math.min(border[place.block], until), to: until, isOn: false };
        }
        loop = { ...loop, isOn: !loop.isOn && loop.from < loop.to };
        tell();
      },
      clearLoop() {
        loop = { from: null, to: null, isOn: false };
        tell();
      },
      /** Let so much real time go by. */
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
        const commanded = { x: replay.x[step], y: replay.y[step], count_left: model.countLeft(block, step) };
        return { ...model.stateAt(place.t), ...place, ...commanded, playing, speed, loop };
      },
    };
    return api;
  }

  Object.assign(Drycut, { playerOf: player, SPEEDS: { slowest: SLOWEST, fastest: FASTEST } });
})(globalThis);
