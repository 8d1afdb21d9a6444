// The walls that a leaning wire cuts, in space: turned by mouse, fingers and keys, with the wire at a place.

/** Written by `make pages` from the model in Python. */

/**
 * Ways of the wire at the bottom and at the top, places mm, one beside the other; and heights, mm. `cuts` says of each
 * place but the first whether the wire cut on the way to it. `block` is the block that it is in, from 1.
 * @typedef {object} Walls
 * @property {number[][]} bottom
 * @property {number[][]} top
 * @property {boolean[]} cuts
 * @property {number[]} block
 * @property {number} work_mm
 * @property {number} program_mm
 * @property {number} lower_guide_mm
 * @property {number} upper_guide_mm
 */

/** Up to here. */

/** @typedef {[number, number]} Place */
/** @typedef {{ turn: number, tip: number }} Angles From where the walls are seen, rad. */

const TURN = 0.008; // rad for each pixel of a drag
const KEY_TURN = Math.PI / 36;
const FROM = { turn: -0.6, tip: 0.5 };
const LEAST_TIP = -Math.PI / 2;
const MOST_TIP = Math.PI / 2;
/** Share of a canvas that the walls take. */
export const ROOM = 0.9;

/**
 * Let a canvas be turned; `draw` hears of each change of it, of its size and of its colours.
 * @param {HTMLCanvasElement} view
 * @param {(angles: Angles) => void} draw
 */
export function turnedBy(view, draw) {
  const angles = { ...FROM };

  /**
   * Turn by angles.
   * @param {number} byTurn
   * @param {number} byTip
   */
  function turn(byTurn, byTip) {
    angles.turn += byTurn;
    angles.tip = Math.min(MOST_TIP, Math.max(LEAST_TIP, angles.tip + byTip));
    draw(angles);
  }

  view.addEventListener("pointerdown", (event) => view.setPointerCapture(event.pointerId));
  view.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) turn(event.movementX * TURN, event.movementY * TURN);
  });
  view.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (event.key === "Home") Object.assign(angles, FROM);
    else if (!by) return;
    event.preventDefault();
    event.stopPropagation(); // the page has keys of its own
    turn((by?.[0] ?? 0) * KEY_TURN, (by?.[1] ?? 0) * KEY_TURN);
  });
  new ResizeObserver(() => draw(angles)).observe(view);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => draw(angles));
  return angles;
}

/**
 * A place on the straight line between two, at a share of it; less than 0 and more than 1 beyond them.
 * @param {number[]} low
 * @param {number[]} high
 * @param {number} share
 * @returns {Place}
 */
export function between(low, high, share) {
  return [low[0] + (high[0] - low[0]) * share, low[1] + (high[1] - low[1]) * share];
}

/**
 * Where the wire is at a share of the height, on the straight line between its places at bottom and top.
 * @param {Walls} walls
 * @param {number} at number of a place
 * @param {number} share 0 at the bottom, 1 at the top; less and more beyond
 * @returns {Place}
 */
export function wireAt(walls, at, share) {
  return between(walls.bottom[at], walls.top[at], share);
}

/**
 * Lowest and highest X and Y of the way at some shares of the height.
 * @param {Walls} walls
 * @param {number[]} shares
 * @returns {[Place, Place]}
 */
export function boxOf(walls, shares) {
  /** @type {[Place, Place]} */
  const box = [[Infinity, Infinity], [-Infinity, -Infinity]];
  for (const share of shares) {
    for (let at = 0; at < walls.bottom.length; at += 1) {
      const place = wireAt(walls, at, share);
      for (const axis of [0, 1]) {
        box[0][axis] = Math.min(box[0][axis], place[axis]);
        box[1][axis] = Math.max(box[1][axis], place[axis]);
      }
    }
  }
  return box;
}

/**
 * A canvas as large as it shows, and its size in CSS pixels.
 * @param {HTMLCanvasElement} canvas
 */
export function cleared(canvas) {
  const { clientWidth: width, clientHeight: height } = canvas;
  const fine = window.devicePixelRatio || 1;
  canvas.width = Math.round(width * fine);
  canvas.height = Math.round(height * fine);
  const ink = canvas.getContext("2d");
  if (!ink) throw new Error("this browser draws on no canvas");
  ink.scale(fine, fine);
  return { ink, width, height };
}

/**
 * Colours of the page by their names.
 * @param {...string} names
 */
export function colours(...names) {
  const style = getComputedStyle(document.documentElement);
  return names.map((name) => style.getPropertyValue(name).trim());
}

/**
 * Draw the walls as they are seen from somewhere, the wire at a place, and the section at a height.
 * @param {HTMLCanvasElement} canvas
 * @param {Walls} walls
 * @param {Angles & { share: number, low: number[], high: number[] }} seen the wire by its places at bottom and top
 */
export function drawWalls(canvas, walls, { turn, tip, share, low: wireLow, high: wireHigh }) {
  const { ink, width, height } = cleared(canvas);
  const [accent, topInk, bottomInk, wireInk] = colours("--accent", "--top", "--bottom", "--error");
  const [low, high] = boxOf(walls, [0, 1]);
  const middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2, walls.work_mm / 2];
  const reach = Math.hypot(high[0] - low[0], high[1] - low[1], walls.work_mm) || 1;
  const scale = (ROOM * Math.min(width, height)) / reach;
  const [sinTurn, cosTurn, sinTip, cosTip] = [Math.sin(turn), Math.cos(turn), Math.sin(tip), Math.cos(tip)];

  /**
   * Where a place in space shows, and how far off it is.
   * @param {number[]} place
   * @param {number} z
   * @returns {[number, number, number]}
   */
  function seenAt([x, y], z) {
    const [dx, dy, dz] = [x - middle[0], y - middle[1], z - middle[2]];
    const across = dx * cosTurn - dy * sinTurn;
    const away = dx * sinTurn + dy * cosTurn;
    return [
      width / 2 + scale * across,
      height / 2 - scale * (dz * cosTip + away * sinTip),
      away * cosTip - dz * sinTip,
    ];
  }

  /** @type {{ corners: [number, number, number][], away: number, shade: number }[]} */
  const faces = [];
  for (let next = 1; next < walls.bottom.length; next += 1) {
    if (!walls.cuts[next]) continue;
    const corners = [
      seenAt(walls.bottom[next - 1], 0), seenAt(walls.bottom[next], 0),
      seenAt(walls.top[next], walls.work_mm), seenAt(walls.top[next - 1], walls.work_mm),
    ];
    const way = Math.atan2(
      walls.bottom[next][1] + walls.top[next][1] - walls.bottom[next - 1][1] - walls.top[next - 1][1],
      walls.bottom[next][0] + walls.top[next][0] - walls.bottom[next - 1][0] - walls.top[next - 1][0],
    );
    const away = corners.reduce((sum, corner) => sum + corner[2], 0);
    faces.push({ corners, away, shade: 0.22 + 0.38 * Math.abs(Math.cos(way + turn - 0.5)) });
  }
  faces.sort((one, other) => other.away - one.away);
  for (const { corners, shade } of faces) {
    ink.beginPath();
    corners.forEach(([x, y], number) => (number ? ink.lineTo(x, y) : ink.moveTo(x, y)));
    ink.closePath();
    ink.globalAlpha = shade;
    ink.fillStyle = accent;
    ink.fill();
  }
  ink.globalAlpha = 1;
  line(ink, walls, (number) => seenAt(walls.bottom[number], 0), bottomInk, 1.5, [6, 4]);
  line(ink, walls, (number) => seenAt(walls.top[number], walls.work_mm), topInk, 1.5, []);
  line(ink, walls, (number) => seenAt(wireAt(walls, number, share), share * walls.work_mm), accent, 2.5, []);
  const beyond = 0.35;
  const ends = [-beyond, 1 + beyond].map((each) => seenAt(between(wireLow, wireHigh, each), each * walls.work_mm));
  ink.strokeStyle = wireInk;
  ink.lineWidth = 2;
  ink.setLineDash([]);
  ink.beginPath();
  ink.moveTo(ends[0][0], ends[0][1]);
  ink.lineTo(ends[1][0], ends[1][1]);
  ink.stroke();
}

/**
 * Stroke the way of the wire at some height, without its jumps.
 * @param {CanvasRenderingContext2D} ink
 * @param {Walls} walls
 * @param {(number: number) => number[]} placeOf
 * @param {string} colour
 * @param {number} wide
 * @param {number[]} dash
 */
export function line(ink, walls, placeOf, colour, wide, dash) {
  ink.strokeStyle = colour;
  ink.lineWidth = wide;
  ink.setLineDash(dash);
  ink.beginPath();
  for (let number = 0; number < walls.bottom.length; number += 1) {
    const [x, y] = placeOf(number);
    if (number && walls.cuts[number]) ink.lineTo(x, y);
    else ink.moveTo(x, y);
  }
  ink.stroke();
}
