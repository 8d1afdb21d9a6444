// The read-outs beside the table; a text is set only where it has changed.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const { say } = Drycut.language;
  const MANY = 10000; // blocks: their number has no room beside that of the running one

  /** How F stands for the next step, as the controller works it out. */
  function formula(made) {
    const { number, way, weighed } = Drycut.words;
    const squared = (value) => (value < 0 ? `(${number(value)})²` : `${number(value)}²`);
    const [x, y] = [number(made.x), number(made.y)];
    const [wordX, wordY] = [number(made.wordX), number(made.wordY)];
    if (made.kind === "arc") {
      const toward = say(made.toward === "center" ? "toward_center" : "from_center");
      return `F = x² + y² − R² = ${squared(made.x)} + ${squared(made.y)} − ${number(Number(made.rSquared))}; ${weighed(made.f)} → ${way(made)} ${toward}`;
    }
    const terms = made.motion === "L1" || made.motion === "L3"
      ? `Xe·y − Ye·x = ${wordX}·${y} − ${wordY}·${x}`
      : `Ye·x − Xe·y = ${wordY}·${x} − ${wordX}·${y}`;
    return `F = ${terms}; ${weighed(made.f)} → ${way(made)}`;
  }

  /** Read-outs in elements of a page, found by `data-out`. */
  function readouts(page, doc, model) {
    const rows = doc.blocks.kind.length;
    const isCard = doc.interpolator === "card";
    const fields = new Map([...page.querySelectorAll("[data-out]")].map((field) => [field.dataset.out, field]));

    /** Write one read-out. */
    function write(name, text) {
      const field = fields.get(name);
      if (field.textContent !== text) field.textContent = text;
    }

    return {
      /** Show a state. */
      show(state) {
        const { number, mm, clock, weighed, way } = Drycut.words;
        const next = state.isAsked ? null : model.decision(state.step + 1);
        write("x", mm(state.x));
        write("y", mm(state.y));
        write("left", state.count_left === null ? "–" : `${number(state.count_left)} G${doc.blocks.count_axis[state.block]}`);
        write("feed", number((state.feed_um_s * 60) / 1000, 2));
        write("block", rows < MANY ? `${number(state.block + 1)} / ${number(rows)}` : number(state.block + 1));
        write("step", number(state.step));
        write("elapsed", clock(state.t));
        write("remaining", clock(state.remaining_s));
        write("deviation", state.deviation ? number(state.deviation.um, 2) : "–");
        write("f", next ? `${weighed(next.f)} → ${way(next)}` : "–");
        write("formula", next ? formula(next) : isCard ? say("no_f") : "");
      },
    };
  }

  Drycut.readouts = readouts;
})(globalThis);
