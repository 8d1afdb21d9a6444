// The walls that a leaning wire cuts, in the report: in space, and their section at a height.
import { element } from "../../html/assets/elements.js";
import { boxOf, cleared, colours, drawWalls, line, ROOM, turnedBy, wireAt } from "../../html/assets/walls.js";

/** @import { Angles, Place, Walls } from "../../html/assets/walls.js" */

/** Show the walls of the page. */
export function showWalls() {
  /** @type {Walls} */
  const walls = JSON.parse(element("#walls-data", HTMLElement).textContent);
  const view = element("#walls", HTMLCanvasElement);
  const plan = element("#section", HTMLCanvasElement);
  const height = element("#walls-height", HTMLInputElement);
  const along = element("#walls-along", HTMLInputElement);
  const told = element("#walls-told", HTMLElement);

  /** @param {Angles} angles */
  function draw(angles) {
    const share = Number(height.value) / Number(height.max);
    const at = Number(along.value);
    drawWalls(view, walls, { ...angles, share, low: walls.bottom[at], high: walls.top[at] });
    drawSection(plan, walls, share, at);
    told.textContent = toldOf(walls, share, at);
  }

  along.max = String(walls.bottom.length - 1);
  along.value = "0";
  const angles = turnedBy(view, draw);
  for (const slider of [height, along]) slider.addEventListener("input", () => draw(angles));
  draw(angles);
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
