// A meter with a needle: a scale of ten marks, and a value that the needle follows.

const SPACE = "http://www.w3.org/2000/svg";
const LOW = -60; // degrees from upright
const HIGH = 60;
const FOLLOWS_S = 0.12;

/**
 * A new element of a picture.
 * @param {string} tag
 * @param {Record<string, string | number>} attributes
 * @param {string} text
 */
function part(tag, attributes, text = "") {
  const made = document.createElementNS(SPACE, tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, String(value));
  made.textContent = text;
  return made;
}

/** @param {number} share */
const angle = (share) => LOW + (HIGH - LOW) * Math.min(Math.max(share, -0.02), 1.02);

/**
 * A place on the scale.
 * @param {number} share
 * @param {number} radius
 */
function place(share, radius) {
  const turned = (angle(share) * Math.PI) / 180;
  return [60 + radius * Math.sin(turned), 66 - radius * Math.cos(turned)];
}

/**
 * Draw a meter into a picture.
 * @param {Element} svg
 * @param {number} most value at the end of the scale
 * @param {string} unit
 */
export function newGauge(svg, most, unit) {
  const [x0, y0] = place(0, 48);
  const [x1, y1] = place(1, 48);
  svg.setAttribute("viewBox", "0 0 120 76");
  svg.replaceChildren(part("path", { class: "scale", d: `M${x0} ${y0}A48 48 0 0 1 ${x1} ${y1}` }));
  for (let mark = 0; mark <= 10; mark += 1) {
    const [a, b] = place(mark / 10, 48);
    const [c, d] = place(mark / 10, mark % 5 ? 44 : 40);
    svg.append(part("path", { class: "scale", d: `M${a} ${b}L${c} ${d}` }));
    if (mark % 5) continue;
    const [x, y] = place(mark / 10, 31);
    svg.append(part("text", { x, y: y + 3, "text-anchor": "middle" }, String(Math.round((most * mark) / 10 * 10) / 10)));
  }
  const setting = part("path", { class: "setting", d: "M60 15L57 8L63 8Z" });
  const needle = part("path", { class: "needle", d: "M60 66L60 22" });
  svg.append(part("text", { x: 108, y: 72, "text-anchor": "end", class: "unit" }, unit), setting, needle, part("circle", { class: "hub", cx: 60, cy: 66, r: 3.5 }));
  let shown = 0;

  return {
    /**
     * Let the needle follow a share of the scale for a while of real time.
     * @param {number} share
     * @param {number} seconds
     */
    follow(share, seconds) {
      shown += (share - shown) * (1 - Math.exp(-seconds / FOLLOWS_S));
      needle.setAttribute("transform", `rotate(${angle(shown).toFixed(2)} 60 66)`);
    },
    /**
     * Mark the set value, or nothing.
     * @param {number | null} share
     */
    mark(share) {
      setting.toggleAttribute("hidden", share === null);
      if (share !== null) setting.setAttribute("transform", `rotate(${angle(share).toFixed(2)} 60 66)`);
    },
    /** The share that the needle shows. */
    shown: () => shown,
  };
}
