// The figure: the path, what of it is cut and how wide, and where the wire stands.

/** @import { Panel } from "./data.js" */

const EDGE = 24;
const WIDE_UM = 4; // a gap that is so much wider is shown in the full colour

/**
 * Colours of the page, as they are now.
 * @param {HTMLElement} of
 */
function inks(of) {
  const style = getComputedStyle(of);
  /** @param {string} name */
  const ink = (name) => style.getPropertyValue(name).trim();
  return { path: ink("--control-line"), cut: ink("--accent"), wide: ink("--error"), narrow: ink("--good"), wire: ink("--warning"), ink: ink("--ink"), back: ink("--error") };
}

/**
 * Places along the path, one for each stretch.
 * @param {Panel} panel
 */
function placesOf({ points, way, stretch_um }) {
  const length = way.along_um[way.along_um.length - 1];
  const count = Math.floor(length / stretch_um) + 1;
  const places = new Float64Array(2 * (count + 1));
  let row = 0;
  for (let at = 0; at <= count; at += 1) {
    const along = Math.min(at * stretch_um, length);
    while (row < points.length - 1 && along > way.along_um[row + 1]) row += 1;
    const [x, y] = along_row(points[row], (along - way.along_um[row]) / (way.along_um[row + 1] - way.along_um[row]));
    places[2 * at] = x;
    places[2 * at + 1] = y;
  }
  return places;
}

/**
 * The place at a share of a row, whose points are evenly spaced.
 * @param {number[]} flat x and y by turns
 * @param {number} share
 */
function along_row(flat, share) {
  const parts = flat.length / 2 - 1;
  const at = Math.min(Math.max(share, 0), 1) * parts;
  const low = Math.min(Math.floor(at), parts - 1);
  const rest = at - low;
  return [0, 1].map((axis) => flat[2 * low + axis] * (1 - rest) + flat[2 * low + 2 + axis] * rest);
}

/**
 * A figure on a canvas.
 * @param {HTMLCanvasElement} canvas
 * @param {Panel} panel
 */
export function newFigure(canvas, panel) {
  const places = placesOf(panel);
  const all = panel.points.flat();
  const xs = all.filter((_, at) => at % 2 === 0);
  const ys = all.filter((_, at) => at % 2 === 1);
  const box = [xs, ys].map((values) => values.reduce(([low, high], value) => [Math.min(low, value), Math.max(high, value)], [Infinity, -Infinity]));

  /** @returns {(x: number, y: number) => [number, number]} */
  function view() {
    const { width, height } = canvas;
    const [[low_x, high_x], [low_y, high_y]] = box;
    const unit = Math.max((high_x - low_x) / (width - 2 * EDGE), (high_y - low_y) / (height - 2 * EDGE), 1e-3);
    return (x, y) => [width / 2 + (x - (low_x + high_x) / 2) / unit, height / 2 - (y - (low_y + high_y) / 2) / unit];
  }

  /** Let the canvas have as many dots as the screen. */
  function fit() {
    const { width, height } = canvas.getBoundingClientRect();
    const dots = window.devicePixelRatio || 1;
    const wanted = [Math.round(width * dots), Math.round(height * dots)];
    if (canvas.width !== wanted[0] || canvas.height !== wanted[1]) [canvas.width, canvas.height] = wanted;
    return dots;
  }

  /**
   * The path as it lies.
   * @param {CanvasRenderingContext2D} context
   * @param {ReturnType<typeof view>} to
   */
  function drawPath(context, to) {
    context.beginPath();
    for (const flat of panel.points) {
      for (let at = 0; at < flat.length; at += 2) {
        const [x, y] = to(flat[at], flat[at + 1]);
        if (at) context.lineTo(x, y);
        else context.moveTo(x, y);
      }
    }
    context.stroke();
  }

  /**
   * What is cut, in the colour of how wide it is.
   * @param {CanvasRenderingContext2D} context
   * @param {ReturnType<typeof view>} to
   * @param {ReturnType<typeof inks>} ink
   * @param {{ far_um: number, wider_um: Float64Array }} seen
   */
  function drawCut(context, to, ink, { far_um, wider_um }) {
    const done = Math.min(Math.floor(far_um / panel.stretch_um), wider_um.length);
    const every = Math.max(Math.floor(wider_um.length / 4000), 1);
    for (let at = 0; at < done; at += every) {
      const next = Math.min(at + every, done);
      const isCut = at < done - panel.half; // nearer walls are still being cut
      const share = isCut ? Math.min(Math.max(wider_um[at] / WIDE_UM, -1), 1) : 0;
      const isUsual = Math.abs(share) < 0.15;
      context.strokeStyle = isUsual ? ink.cut : share > 0 ? ink.wide : ink.narrow;
      context.globalAlpha = isUsual ? 0.75 : 0.35 + 0.65 * Math.abs(share);
      context.beginPath();
      context.moveTo(...to(places[2 * at], places[2 * at + 1]));
      context.lineTo(...to(places[2 * next], places[2 * next + 1]));
      context.stroke();
    }
    context.globalAlpha = 1;
  }

  return {
    /**
     * Draw all of it.
     * @param {{ place_um: number, far_um: number, wider_um: Float64Array, is_short: boolean }} seen
     */
    draw(seen) {
      const dots = fit();
      const context = canvas.getContext("2d");
      if (!context) return;
      const ink = inks(canvas);
      const to = view();
      context.clearRect(0, 0, canvas.width, canvas.height);
      Object.assign(context, { lineCap: "round", lineJoin: "round", lineWidth: 1.5 * dots, strokeStyle: ink.path });
      drawPath(context, to);
      context.lineWidth = 4 * dots;
      drawCut(context, to, ink, seen);
      context.beginPath();
      context.arc(...to(...this.place(seen.place_um)), 6 * dots, 0, 2 * Math.PI);
      Object.assign(context, { fillStyle: seen.is_short ? ink.back : ink.wire, lineWidth: 1.5 * dots, strokeStyle: ink.ink });
      context.fill();
      context.stroke();
    },
    /**
     * The place along the path, µm.
     * @param {number} along_um
     * @returns {[number, number]}
     */
    place(along_um) {
      const at = Math.min(Math.floor(along_um / panel.stretch_um), places.length / 2 - 2);
      const rest = Math.min(along_um / panel.stretch_um - at, 1);
      return [places[2 * at] * (1 - rest) + places[2 * at + 2] * rest, places[2 * at + 1] * (1 - rest) + places[2 * at + 3] * rest];
    },
  };
}
