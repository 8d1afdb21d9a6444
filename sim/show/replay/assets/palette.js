// The colours of the style sheet, for what is drawn on a canvas.

const NAMES = /** @type {const} */ ([
  "page", "ink", "muted", "line", "raised", "accent", "control-line", "good", "table", "gone", "kerf", "ideal", "jump",
  "start", "end", "drawing", "work", "work-edge", "clamp", "clamp-edge", "slug", "wire", "steps", "trim-1", "trim-2", "trim-3",
  "trim-4", "top", "bottom",
]);

/** @typedef {Record<typeof NAMES[number], string>} Shades */
/** @typedef {() => Shades} Colours The colours as they are now. */

/** @returns {Shades} */
function readShades() {
  const style = getComputedStyle(document.documentElement);
  const pairs = NAMES.map((name) => [name, style.getPropertyValue(`--${name}`).trim()]);
  return Object.fromEntries(pairs);
}

/**
 * Colours of the style sheet by name; read anew where the scheme changes, and for paper.
 * @param {() => void} onChange
 * @returns {Colours}
 */
export function coloursOf(onChange) {
  /** @type {Shades | null} */
  let found = null;
  for (const query of ["(prefers-color-scheme: dark)", "print"]) {
    window.matchMedia(query).addEventListener("change", () => {
      found = null;
      onChange();
    });
  }
  return () => (found ??= readShades());
}
