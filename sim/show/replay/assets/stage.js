// The table on its canvas: everything that is drawn, in order, for one moment of the replay.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const STEPS_SCALE = 48; // px per µm when looking at single steps
  const NAMES = [
    "page", "ink", "muted", "line", "raised", "accent", "control-line", "good", "table", "gone", "kerf", "ideal", "jump",
    "start", "end", "work", "work-edge", "clamp", "clamp-edge", "slug", "wire", "steps",
  ];

  /** Colours of the style sheet by name; read anew where the scheme changes. */
  function palette(onChange) {
    let found = null;
    root.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => {
      found = null;
      onChange();
    });
    return () => {
      if (!found) {
        const style = getComputedStyle(document.documentElement);
        found = Object.fromEntries(NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]));
      }
      return found;
    };
  }

  /** Whether the wire cut on its way to each sample, and not in a jump. */
  function cutSamples({ doc, samples }) {
    const { border_s: border, kind } = doc.blocks;
    const isCut = new Uint8Array(samples.t.length);
    let row = 0;
    for (let at = 0; at < isCut.length; at++) {
      while (row + 1 < kind.length && samples.t[at] > border[row + 1]) row++;
      isCut[at] = kind[row] === "jump" ? 0 : 1;
    }
    return isCut;
  }

  /** Stage of a replay on a canvas; `onNeed` asks for a frame. */
  function stage(canvas, replay, model, onNeed) {
    const { doc } = replay;
    const pen = canvas.getContext("2d", { alpha: false });
    const view = Drycut.view();
    const colours = palette(spoil);
    const path = Drycut.path(doc.blocks);
    const scene = Drycut.scene(doc, path, colours);
    const kerf = Drycut.kerf(replay.samples, cutSamples(replay), 2 * doc.offset_um, colours);
    const micro = Drycut.micro(replay, model, colours);
    const isCalm = root.matchMedia("(prefers-reduced-motion: reduce)");
    let ratio = 1;
    let outlined = null;
    let fitted = null; // {box, scale, center} of the view as it was fitted last

    /** Draw everything anew in the next frame. */
    function spoil() {
      scene.spoil();
      kerf.spoil();
      onNeed();
    }

    /** Box of the path with its kerf. */
    function whole() {
      const box = path.box();
      const width = Math.max(doc.offset_um, 1);
      return { left: box.left - width, right: box.right + width, bottom: box.bottom - width, top: box.top + width };
    }

    /** What of the page lies over the canvas: boxes of left, top, right, bottom in px of it. */
    function covered() {
      const own = canvas.getBoundingClientRect();
      return [...canvas.parentElement.querySelectorAll("[data-over]")].map((over) => {
        const box = over.getBoundingClientRect();
        return [box.left - own.left, box.top - own.top, box.right - own.left, box.bottom - own.top];
      });
    }

    /** Show all of a box clear of what lies over the canvas at its top and bottom. */
    function fit(box) {
      const [tools, legend] = covered();
      view.fit(box, { top: tools[3], bottom: view.height - legend[1] });
      fitted = { box, scale: view.scale, center: view.center };
    }

    /** Box that the view was fitted to and still shows, if nobody has moved it since. */
    function stillFitted() {
      if (!fitted) return whole();
      const { box, scale, center } = fitted;
      return view.scale === scale && view.center.every((along, axis) => along === center[axis]) ? box : null;
    }

    /** Be as large as the page makes it. */
    function resize() {
      const still = stillFitted();
      ratio = root.devicePixelRatio || 1;
      view.resize(canvas.clientWidth, canvas.clientHeight);
      canvas.width = Math.round(view.width * ratio);
      canvas.height = Math.round(view.height * ratio);
      view.limitTo(scene.travel);
      if (still) fit(still);
      onNeed();
    }

    /** The block under the pointer, or in the text: a broad band along it. */
    function drawOutlined() {
      if (outlined === null) return;
      pen.beginPath();
      path.wayOf(pen, view, outlined);
      pen.strokeStyle = colours().accent;
      pen.globalAlpha = 0.75;
      pen.lineWidth = 5;
      pen.lineCap = "round";
      pen.stroke();
      pen.globalAlpha = 1;
    }

    new ResizeObserver(resize).observe(canvas);
    resize();

    return {
      view,
      colours,
      get isFalling() { return scene.isFalling; },
      fit: () => fit(whole()),
      fitTable: () => fit(scene.travel),
      /** Look at single steps about a place. */
      toSteps: (x, y) => view.lookAt(x, y, STEPS_SCALE),
      outline(row) {
        outlined = row;
        onNeed();
      },
      /** Draw a state, deviations `times` as large; `isPlaying` lets pieces fall. */
      draw(state, times, isPlaying, now) {
        pen.setTransform(ratio, 0, 0, ratio, 0, 0);
        pen.fillStyle = colours().page;
        pen.fillRect(0, 0, view.width, view.height);
        scene.drawGround(pen, view);
        kerf.draw(pen, view, ratio, Math.max(0, Drycut.countUpTo(replay.samples.t, state.t) - 1), state.wire);
        scene.drawPieces(pen, view, state.t, now, isPlaying && !isCalm.matches);
        scene.drawIdeal(pen, view, ratio);
        drawOutlined();
        const plate = Drycut.deviationPlate(pen, view, state, times);
        if (micro.shows(view.scale)) micro.draw(pen, view, state, [...covered(), ...(plate ? [plate.box] : [])]);
        Drycut.drawWire(pen, view, state, times, doc.wire_diameter_um, colours);
        Drycut.drawScaleBar(pen, view, colours);
      },
    };
  }

  Drycut.stage = stage;
})(globalThis);
