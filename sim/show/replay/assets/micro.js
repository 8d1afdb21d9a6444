// Single steps: the grid of 1 µm, each step as an edge and a dot, and beside it the decision of the interpolator.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const GRID_FROM = 14; // px per µm
  const TEXT_FROM = 22;
  const RUN = 512; // steps that share one box
  const ROW = 17; // px that a text takes, upwards
  const FLAG_ROWS = 5;
  const CROSS = 11; // px about the commanded and the actual place that stay free
  const MOST = 1500; // steps shown at once: those near the one that runs
  const WRITTEN = 250; // decisions tried at once

  /** Boxes of runs of steps: left, bottom, right, top in turn. */
  function boxesOf({ x, y }) {
    const boxes = new Int32Array(4 * Math.ceil(x.length / RUN));
    for (let run = 0, box = 0; run < x.length; run += RUN, box += 4) {
      const past = Math.min(run + RUN, x.length);
      let [left, bottom, right, top] = [x[run], y[run], x[run], y[run]];
      for (let at = run + 1; at < past; at++) {
        if (x[at] < left) left = x[at];
        else if (x[at] > right) right = x[at];
        if (y[at] < bottom) bottom = y[at];
        else if (y[at] > top) top = y[at];
      }
      boxes.set([left, bottom, right, top], box);
    }
    return boxes;
  }

  /** Boxes on the canvas that are taken, so that no text covers another. */
  function room(width, height) {
    const taken = [];
    return {
      take: (left, top, right, bottom) => taken.push([left, top, right, bottom]),
      isFree: (left, top, right, bottom) =>
        left >= 2 && top >= 2 && right <= width - 2 && bottom <= height - 2
        && taken.every((box) => right <= box[0] || box[2] <= left || bottom <= box[1] || box[3] <= top),
    };
  }

  /** Single steps of a replay. */
  function micro(replay, model, colours) {
    const { x, y } = replay;
    const boxes = boxesOf(replay);

    /** Steps in a box, those nearest to `step` in the order of their number. */
    function stepsIn(near, step) {
      const found = [];
      for (let run = 0, box = 0; box < boxes.length; run += RUN, box += 4) {
        if (boxes[box] > near.right || boxes[box + 2] < near.left) continue;
        if (boxes[box + 1] > near.top || boxes[box + 3] < near.bottom) continue;
        const past = Math.min(run + RUN, x.length);
        for (let at = run; at < past; at++) {
          if (x[at] >= near.left && x[at] <= near.right && y[at] >= near.bottom && y[at] <= near.top) found.push(at);
        }
      }
      if (found.length <= MOST) return found;
      const middle = Drycut.countUpTo(found, step);
      const since = Math.max(0, Math.min(middle - MOST / 2, found.length - MOST));
      return found.slice(since, since + MOST);
    }

    /** The grid of whole µm. */
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

    /** Edges of steps. */
    function edges(pen, view, steps) {
      pen.beginPath();
      for (const at of steps) {
        if (at === 0 || at >= x.length) continue;
        pen.moveTo(view.toX(x[at - 1]), view.toY(y[at - 1]));
        pen.lineTo(view.toX(x[at]), view.toY(y[at]));
      }
      pen.stroke();
    }

    /** Edges and dots of steps. */
    function stairs(pen, view, steps, step) {
      edges(pen, view, steps);
      for (const at of steps) {
        pen.beginPath();
        pen.arc(view.toX(x[at]), view.toY(y[at]), at === step ? 5 : 3, 0, 2 * Math.PI);
        pen.fill();
      }
    }

    /** The staircase: steps to come thin, those done bold, the next one emphasised; done ones alone in a question. */
    function staircase(pen, view, steps, { step, isAsked }) {
      const shades = colours();
      const done = Drycut.countUpTo(steps, step);
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

    /** Write one decision where there is room for it: beside an upright step, on a flag over or under a level one. */
    function write(pen, view, free, at, isNext) {
      const decision = model.decision(at);
      if (!decision) return;
      const text = Drycut.words.decision(decision);
      pen.font = isNext ? "700 13px system-ui, sans-serif" : "12px system-ui, sans-serif";
      const width = pen.measureText(text).width + 8;
      const middleX = (view.toX(x[at - 1]) + view.toX(x[at])) / 2;
      const middleY = (view.toY(y[at - 1]) + view.toY(y[at])) / 2;
      const places = x[at] === x[at - 1] ? beside(middleX, middleY, width) : flags(middleX, middleY, width);
      const place = places.find(({ plate, pole }) => free.isFree(...plate) && free.isFree(...pole));
      if (!place) return;
      free.take(...place.plate);
      free.take(...place.pole);
      letter(pen, text, place, isNext);
    }

    /** Plates right and left of a place, each with the pole that leads to it. */
    function beside(px, py, width) {
      const [top, bottom] = [py - ROW / 2, py + ROW / 2];
      return [
        { plate: [px + 12, top, px + 12 + width, bottom], pole: [px + 4, py, px + 12, py] },
        { plate: [px - 12 - width, top, px - 12, bottom], pole: [px - 12, py, px - 4, py] },
      ];
    }

    /** Plates at the ends of poles of growing length, up and down, flying to either side. */
    function flags(px, py, width) {
      const places = [];
      for (let row = 0; row < FLAG_ROWS; row++) {
        const away = 8 + row * (ROW + 2);
        for (const left of [px - 3, px + 3 - width]) {
          places.push(
            { plate: [left, py - away - ROW, left + width, py - away], pole: [px, py - away, px, py - 4] },
            { plate: [left, py + away, left + width, py + away + ROW], pole: [px, py + 4, px, py + away] },
          );
        }
      }
      return places;
    }

    /** A text on a light ground, framed where it is of the next step. */
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

    /** Take the room of a step's edge. */
    function takeStep(view, free, at) {
      const before = Math.max(0, at - 1);
      const [ax, ay, bx, by] = [view.toX(x[before]), view.toY(y[before]), view.toX(x[at]), view.toY(y[at])];
      free.take(Math.min(ax, bx) - 3, Math.min(ay, by) - 3, Math.max(ax, bx) + 3, Math.max(ay, by) + 3);
    }

    /** Decisions beside their steps: of the next step first, then of those around it, as far as there is room. */
    function decisions(pen, view, steps, { step, wire }, covered) {
      const free = room(view.width, view.height);
      for (const box of covered) free.take(...box);
      for (const at of steps) takeStep(view, free, at);
      for (const [atX, atY] of [[x[step], y[step]], wire]) {
        const [px, py] = [view.toX(atX), view.toY(atY)];
        free.take(px - CROSS, py - CROSS, px + CROSS, py + CROSS);
      }
      const next = step + 1;
      if (next < x.length) write(pen, view, free, next, true);
      const others = steps.filter((at) => at > 0 && at !== next);
      others.sort((a, b) => Math.abs(a - next) - Math.abs(b - next));
      for (const at of others.slice(0, WRITTEN)) write(pen, view, free, at, false);
    }

    return {
      /** Whether single steps can be told apart at a scale. */
      shows: (scale) => scale >= GRID_FROM,
      /** Draw the steps about a state; `covered` are boxes of the window that show nothing. */
      draw(pen, view, state, covered) {
        const { step } = state;
        const near = view.bounds();
        const wider = { left: near.left - 1, right: near.right + 1, bottom: near.bottom - 1, top: near.top + 1 };
        const steps = stepsIn(wider, step);
        grid(pen, view, near);
        staircase(pen, view, steps, state);
        if (view.scale >= TEXT_FROM && !state.isAsked) decisions(pen, view, steps, state, covered);
      },
    };
  }

  Drycut.micro = micro;
})(globalThis);
