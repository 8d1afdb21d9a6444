// A tooltip: a title and pairs of name and value, beside a point of the window.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const GAP = 14;

  /** Tooltip in an element. */
  function tip(box) {
    return {
      hide() { box.hidden = true; },
      /** Show a title and pairs beside (x, y). */
      show(title, pairs, x, y) {
        const list = document.createElement("dl");
        for (const [name, value] of pairs) list.append(Drycut.element("dt", "", name), Drycut.element("dd", "", value));
        box.replaceChildren(Drycut.element("strong", "", title), list);
        box.hidden = false;
        const { width, height } = box.getBoundingClientRect();
        const left = x + GAP + width > innerWidth ? Math.max(4, x - GAP - width) : x + GAP;
        const top = y + GAP + height > innerHeight ? Math.max(4, y - GAP - height) : y + GAP;
        box.style.transform = `translate(${left}px, ${top}px)`;
      },
    };
  }

  Drycut.tip = tip;
})(globalThis);
