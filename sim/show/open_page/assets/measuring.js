// Measuring on the picture: its button and keys, the two places, their marks, and what is said of them.
import { between, ofArc } from "./measure.js";
import { snapAt } from "./snap.js";
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Path as Drawn } from "../../replay/assets/path.js" */
/** @import { Pen } from "../../replay/assets/pen.js" */
/** @import { View } from "../../replay/assets/view.js" */
/** @import { Path } from "./data.js" */
/** @import { Snap } from "./snap.js" */
/** @import { Measure } from "./measure.js" */

const REACH = 14; // px
const MARK = 6; // px

/** @type {Record<Snap["kind"], string>} */
const KINDS = {
  end: "snap-end", center: "snap-center", tangent: "snap-tangent", across: "snap-across", on: "snap-on", free: "snap-free",
};

/**
 * A mark for a place, by what it is: a square at an end, a cross at a centre, a disc on the path, a ring elsewhere.
 * @param {Pen} pen
 * @param {Snap} snap
 * @param {number} px
 * @param {number} py
 */
function drawMark(pen, { kind }, px, py) {
  pen.beginPath();
  if (kind === "end") pen.rect(px - MARK, py - MARK, 2 * MARK, 2 * MARK);
  else if (kind === "center") {
    pen.moveTo(px - MARK, py);
    pen.lineTo(px + MARK, py);
    pen.moveTo(px, py - MARK);
    pen.lineTo(px, py + MARK);
  } else pen.arc(px, py, kind === "on" ? MARK / 2 : MARK, 0, 2 * Math.PI);
  pen.stroke();
}

/**
 * Measuring on a picture.
 * @param {View} view
 * @param {() => void} later draws anew
 */
export function wireMeasuring(view, later) {
  const button = element("#measure", HTMLButtonElement);
  const box = element("#measured", HTMLElement);
  let isOn = false;
  /** @type {Path | null} */
  let path = null;
  /** @type {Drawn | null} */
  let drawn = null;
  /** @type {Snap[]} */
  let held = [];
  /** @type {Snap | null} */
  let under = null;

  /** The places that are shown: those that are held, and the one under the pointer. */
  const places = () => (under && held.length < 2 ? [...held, under] : held);

  /**
   * The place to take hold of at a point of the canvas.
   * @param {number} px
   * @param {number} py
   */
  function at(px, py) {
    if (!path || !drawn) return null;
    return snapAt(path, drawn, view.placeOf(px, py), REACH / view.scale, held.length === 1 ? held[0] : null);
  }

  /** @param {Measure} measure */
  function row([name, value, unit]) {
    const shown = unit === "mm" ? (value / 1000).toFixed(3) : value.toFixed(3);
    const text = `${/^-0\.0*$/.test(shown) ? shown.slice(1) : shown}${unit === "mm" ? " mm" : "°"}`;
    return make("div", {}, make("dt", {}, language.say(name)), make("dd", {}, text));
  }

  /** What is measured, in words. */
  function tell() {
    box.hidden = !isOn;
    const [a, b] = places();
    if (!path || !a) {
      box.replaceChildren(make("p", {}, language.say("measure-how")));
      return;
    }
    const kinds = places().map((snap) => language.say(KINDS[snap.kind])).join(" → ");
    const figures = b ? between(path, a, b) : ofArc(path, a);
    const place = b ? [] : /** @type {Measure[]} */ ([["at-x", a.x, "mm"], ["at-y", a.y, "mm"]]);
    box.replaceChildren(make("p", {}, kinds), make("dl", {}, ...[...place, ...figures].map(row)));
  }

  /** Begin anew, or end. */
  function clear() {
    held = [];
    under = null;
    tell();
    later();
  }

  /** @param {boolean} on */
  function turn(on) {
    isOn = on;
    button.setAttribute("aria-pressed", String(on));
    clear();
  }

  button.addEventListener("click", () => turn(!isOn));
  document.addEventListener("keydown", ({ key, target, ctrlKey, metaKey, altKey }) => {
    const isWritten = target instanceof Element && /^(INPUT|TEXTAREA|SELECT)$/.test(target.tagName);
    if (isWritten || ctrlKey || metaKey || altKey) return;
    if (key === "m" || key === "M") turn(!isOn);
    else if (key === "Escape" && isOn) turn(false);
  });
  language.onChange(tell);

  return {
    isOn: () => isOn,
    /**
     * Another path: what was measured was of the one before.
     * @param {Path | null} newPath
     * @param {Drawn | null} newDrawn
     */
    show(newPath, newDrawn) {
      [path, drawn] = [newPath, newDrawn];
      if (isOn) clear();
    },
    /**
     * The pointer is over a point of the canvas.
     * @param {number} px
     * @param {number} py
     */
    move(px, py) {
      under = at(px, py);
      tell();
      later();
    },
    /**
     * Take hold of a place; a third one begins anew.
     * @param {number} px
     * @param {number} py
     */
    click(px, py) {
      if (held.length === 2) held = [];
      const snap = at(px, py);
      if (snap) held.push(snap);
      under = null;
      tell();
      later();
    },
    /**
     * Draw the places and the line between them.
     * @param {Pen} pen
     * @param {string} shade
     */
    draw(pen, shade) {
      if (!isOn) return;
      pen.strokeStyle = shade;
      pen.lineWidth = 2;
      const points = places().map((snap) => ({ snap, px: view.toX(snap.x), py: view.toY(snap.y) }));
      if (points.length === 2) {
        pen.beginPath();
        pen.moveTo(points[0].px, points[0].py);
        pen.lineTo(points[1].px, points[1].py);
        pen.stroke();
      }
      for (const { snap, px, py } of points) drawMark(pen, snap, px, py);
    },
  };
}
