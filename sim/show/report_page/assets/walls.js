// The walls that a leaning wire cuts, in space, and their section at a height: turned by mouse, fingers and keys.
import { element } from "../../html/assets/elements.js";

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

const TURN = 0.008; // rad for each pixel of a drag
const KEY_TURN = Math.PI / 36;
const FROM = { turn: -0.6, tip: 0.5 };
const LEAST_TIP = -Math.PI / 2;
const MOST_TIP = Math.PI / 2;
const ROOM = 0.9; // of the canvas that the walls take

/** Show the walls of the page. */
export function showWalls() {
  /** @type {Walls} */
  const walls = JSON.parse(element("#walls-data", HTMLElement).textContent);
  const view = element("#walls", HTMLCanvasElement);
  const plan = element("#section", HTMLCanvasElement);
  const height = element("#walls-height", HTMLInputElement);
  const along = element("#walls-along", HTMLInputElement);
  const told = element("#walls-told", HTMLElement);
  let { turn, tip } = FROM;

  function draw() {
    const share = Number(height.value) / Number(height.max);
    const at = Number(along.value);
    drawWalls(view, walls, { turn, tip, share, at });
    drawSection(plan, walls, share, at);
    told.textContent = toldOf(walls, share, at);
  }

  /**
   * Turn the walls by angles.
   * @param {number} byTurn
   * @param {number} byTip
   */
  function turnBy(byTurn, byTip) {
    turn += byTurn;
    tip = Math.min(MOST_TIP, Math.max(LEAST_TIP, tip + byTip));
    draw();
  }

  along.max = String(walls.bottom.length - 1);
  along.value = "0";
  for (const slider of [height, along]) slider.addEventListener("input", draw);
  view.addEventListener("pointerdown", (event) => view.setPointerCapture(event.pointerId));
  view.addEventListener("pointermove", (event) => {
    if (event.buttons & 1) turnBy(event.movementX * TURN, event.movementY * TURN);
  });
  view.addEventListener("keydown", (event) => {
    const by = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key];
    if (event.key === "Home") ({ turn, tip } = FROM);
    else if (!by) return;
    event.preventDefault();
    turnBy((by?.[0] ?? 0) * KEY_TURN, (by?.[1] ?? 0) * KEY_TURN);
  });
  new ResizeObserver(draw).observe(view);
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", draw);
  draw();
}

/**
 * Where the wire is at a share of the height, on the straight line between its places at bottom and top.
 * @param {Walls} walls
 * @param {number} at number of a place
 * @param {number} share 0 at the bottom, 1 at the top; less and more beyond
 * @returns {Place}
 */
function wireAt(walls, at, share) {
  const [low, high] = [walls.bottom[at], walls.top[at]];
  return [low[0] + (high[0] - low[0]) * share, low[1] + (high[1] - low[1]) * share];
}

/**
 * Height, width and depth of the section, block, and where the wire is, in figures.
 * @param {Walls} walls
 * @param {number} share
 * @param {number} at
 */
function toldOf(walls, share, at) {
  const [low, high] = boxOf(walls, [share]);
  const [x, y] = wireAt(walls, at, share);
  const u = walls.top[at][0] - walls.bottom[at][0];
  const v = walls.top[at][1] - walls.bottom[at][1];
  const span = (walls.upper_guide_mm - walls.lower_guide_mm) / walls.work_mm;
  return [
    `z ${(share * walls.work_mm).toFixed(2)} mm`,
    `${(high[0] - low[0]).toFixed(3)} × ${(high[1] - low[1]).toFixed(3)} mm`,
    `#${walls.block[at]}`,
    `X ${x.toFixed(3)} Y ${y.toFixed(3)}`,
    `U ${(u * span).toFixed(3)} V ${(v * span).toFixed(3)}`,
  ].join(" · ");
}

/**
 * Lowest and highest X and Y of the way at some shares of the height.
 * @param {Walls} walls
 * @param {number[]} shares
 * @returns {[Place, Place]}
 */
function boxOf(walls, shares) {
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
function cleared(canvas) {
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
function colours(...names) {
  const style = getComputedStyle(document.documentElement);
  return names.map((name) => style.getPropertyValue(name).trim());
}

/**
 * Draw the walls as they are seen from somewhere, the wire at a place, and the section at a height.
 * @param {HTMLCanvasElement} canvas
 * @param {Walls} walls
 * @param {{ turn: number, tip: number, share: number, at: number }} seen
 */
function drawWalls(canvas, walls, { turn, tip, share, at }) {
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
  const ends = [-beyond, 1 + beyond].map((each) => seenAt(wireAt(walls, at, each), each * walls.work_mm));
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
function line(ink, walls, placeOf, colour, wide, dash) {
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

/**
 * Draw the section at a height from above, with bottom and top, and where the wire is.
 * @param {HTMLCanvasElement} canvas
 * @param {Walls} walls
 * @param {number} share
 * @param {number} at
 */
function drawSection(canvas, walls, share, at) {
  const { ink, width, height } = cleared(canvas);
  const [accent, topInk, bottomInk, wireInk] = colours("--accent", "--top", "--bottom", "--error");
  const [low, high] = boxOf(walls, [0, 1]);
  const scale = ROOM * Math.min(width / Math.max(high[0] - low[0], 1e-9), height / Math.max(high[1] - low[1], 1e-9));

  /**
   * Where a place shows.
   * @param {number[]} place
   * @returns {Place}
   */
  function seenAt([x, y]) {
    return [width / 2 + scale * (x - (low[0] + high[0]) / 2), height / 2 - scale * (y - (low[1] + high[1]) / 2)];
  }

  line(ink, walls, (number) => seenAt(walls.bottom[number]), bottomInk, 1.25, [6, 4]);
  line(ink, walls, (number) => seenAt(walls.top[number]), topInk, 1.25, []);
  line(ink, walls, (number) => seenAt(wireAt(walls, number, share)), accent, 2.5, []);
  const [x, y] = seenAt(wireAt(walls, at, share));
  ink.fillStyle = wireInk;
  ink.beginPath();
  ink.arc(x, y, 4, 0, 2 * Math.PI);
  ink.fill();
}
