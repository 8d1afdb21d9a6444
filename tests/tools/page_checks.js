/* What a page tells of itself, for tests/tools/page_checks.py: one object of functions. */
(() => {
  "use strict";

  const WIDGETS = "a[href], button, input:not([type=hidden]), select, textarea, summary, [role=button], [role=slider]," +
    " [role=checkbox], [role=switch], [role=tab], [role=option], [role=menuitem]";
  const CONTROLS = WIDGETS + ", [tabindex]";
  const NAMED = CONTROLS + ", canvas, img, svg[role=img], dialog, [role=dialog], [role=img], [role=application]";
  const COMPOSITES = "[role=grid], [role=listbox], [role=menu], [role=radiogroup], [role=tablist], [role=toolbar]," +
    " [role=tree]";
  const BARE_INPUTS = ["checkbox", "color", "file", "hidden", "image", "radio", "range"];
  const UNSEEN = "script, style, noscript, title, option";

  /** The start tag of an element, to find it by. */
  function tag(element) {
    return element.cloneNode(false).outerHTML.replace(/<\/[^<]*>$/, "").slice(0, 160);
  }

  function shown(element) {
    const box = element.getBoundingClientRect();
    const seen = element.checkVisibility({ opacityProperty: true, visibilityProperty: true });
    return seen && box.width > 0 && box.height > 0;
  }

  function all(selector) {
    return [...document.querySelectorAll(selector)].filter(shown);
  }

  function textOf(id) {
    return document.getElementById(id)?.textContent ?? "";
  }

  /** Name by which a screen reader calls an element; empty where it has none. */
  function nameOf(element) {
    const by = (element.getAttribute("aria-labelledby") ?? "").split(/\s+/).filter(Boolean).map(textOf).join(" ");
    const labels = [...(element.labels ?? [])].map(label => label.innerText).join(" ");
    const value = ["button", "submit", "reset"].includes(element.type) ? element.value : "";
    const content = element.matches("a, button, summary, h1, h2, h3, [role]:not([role=img], [role=slider], [role=dialog])")
      ? element.innerText : "";
    const drawn = element.querySelector(":scope > title")?.textContent;
    const names = [by, element.getAttribute("aria-label"), labels, element.getAttribute("alt"), value, content, drawn,
      element.getAttribute("title")];
    return (names.find(name => name?.trim()) ?? "").trim();
  }

  /** Visible elements that need a name and have none; an empty alt says that a picture says nothing. */
  function unnamed() {
    const nameless = element => !nameOf(element) && !(element.localName === "img" && element.alt === "" &&
      element.hasAttribute("alt"));
    return all(NAMED).filter(element => !element.closest("[aria-hidden=true]") && nameless(element)).map(tag);
  }

  function doubledIds() {
    const ids = [...document.querySelectorAll("[id]")].map(element => element.id);
    return [...new Set(ids.filter((id, at) => ids.indexOf(id) !== at))];
  }

  /** Controls that a keyboard must reach: not one of several arrows move between, if another of those can be reached. */
  function controls() {
    return all(CONTROLS).filter(element => !element.matches(":disabled, [aria-disabled=true]") &&
      !element.closest("[inert]") && (element.tabIndex >= 0 || (element.matches(WIDGETS) && !movedByArrows(element))));
  }

  function movedByArrows(element) {
    const around = element.closest(COMPOSITES);
    return Boolean(around) && [around, ...around.querySelectorAll(WIDGETS)].some(other => other.tabIndex >= 0);
  }

  /** Elements that one tab stop serves: radio buttons of one name. */
  function group(element) {
    return element.type === "radio" && element.name ? `radio ${element.name}` : null;
  }

  /** Which of these has the focus (-1: none), and whether that can be seen. */
  function focused(elements) {
    const style = getComputedStyle(document.activeElement);
    const ring = style.outlineStyle !== "none" && parseFloat(style.outlineWidth) > 0;
    return [elements.indexOf(document.activeElement), ring || style.boxShadow !== "none"];
  }

  /** Elements that stick out of a page to the right, those that are scrolled by themselves left out. */
  function tooWide() {
    const root = document.scrollingElement;
    if (root.scrollWidth <= root.clientWidth) {
      return [];
    }
    const out = all("body *").filter(element => element.getBoundingClientRect().right > root.clientWidth + 1);
    const inner = out.filter(element => !out.some(other => other !== element && element.contains(other)));
    return [`${root.scrollWidth} px wide`, ...inner.slice(0, 5).map(tag)];
  }

  const pen = new OffscreenCanvas(1, 1).getContext("2d", { willReadFrequently: true });

  /** Any CSS colour as red, green, blue (0 to 255) and alpha (0 to 1). */
  function rgba(colour) {
    pen.clearRect(0, 0, 1, 1);
    pen.fillStyle = colour;
    pen.fillRect(0, 0, 1, 1);
    const [red, green, blue, alpha] = pen.getImageData(0, 0, 1, 1).data;
    return [red, green, blue, alpha / 255];
  }

  /** A box as far as it is not cut off by the window or by what scrolls around it. */
  function cut(box, element) {
    let { left, top, right, bottom } = box;
    const clip = other => {
      [left, top] = [Math.max(left, other.left), Math.max(top, other.top)];
      [right, bottom] = [Math.min(right, other.right), Math.min(bottom, other.bottom)];
    };
    clip({ left: 0, top: 0, right: innerWidth, bottom: innerHeight });
    for (let around = element; around && around !== document.documentElement; around = around.parentElement) {
      if (around !== document.body && getComputedStyle(around).overflow !== "visible") {
        clip(around.getBoundingClientRect());
      }
    }
    return right - left > 2 && bottom - top > 2 ? [left, top, right, bottom] : null;
  }

  function inWindow(element) {
    const box = element.getBoundingClientRect();
    return box.bottom > 0 && box.top < innerHeight;
  }

  /** Whether something else lies over the middle of a box. */
  function covered([left, top, right, bottom], element) {
    const over = document.elementFromPoint((left + right) / 2, (top + bottom) / 2);
    return over !== null && !element.contains(over) && !over.contains(element);
  }

  function opacity(element) {
    let product = 1;
    for (let around = element; around; around = around.parentElement) {
      product *= Number(getComputedStyle(around).opacity);
    }
    return product;
  }

  /** How a text in these boxes is written. */
  function written(element, text, boxes) {
    const style = getComputedStyle(element);
    const [red, green, blue, alpha] = rgba(element instanceof SVGElement ? style.fill : style.color);
    const size = parseFloat(style.fontSize) * scale(element);
    const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    const seen = boxes.map(box => cut(box, element)).filter(box => box && !covered(box, element));
    return { text: text.trim().slice(0, 60), boxes: seen, colour: [red, green, blue], large,
      alpha: alpha * opacity(element) };
  }

  /** How much larger an SVG draws its text than its font size says. */
  function scale(element) {
    const matrix = element instanceof SVGGraphicsElement ? element.getScreenCTM() : null;
    return matrix ? Math.hypot(matrix.a, matrix.b) : 1;
  }

  function dimmed(element) {
    return element.closest(":disabled, [aria-disabled=true], [inert]") !== null;
  }

  /** Texts in the window: what they say, where, and in what colour. */
  function texts() {
    const found = [];
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      const element = node.parentElement;
      if (node.data.trim() && inWindow(element) && !element.closest(UNSEEN) && !dimmed(element) && shown(element)) {
        const range = document.createRange();
        range.selectNodeContents(node);
        found.push(written(element, node.data, [...range.getClientRects()]));
      }
    }
    for (const field of all("input, textarea, select")) {
      if (!BARE_INPUTS.includes(field.type) && !dimmed(field)) {
        found.push(written(field, field.value, [field.getBoundingClientRect()]));
      }
    }
    return found.filter(text => text.boxes.length);
  }

  return { all, tag, unnamed, doubledIds, controls, group, focused, tooWide, texts };
})()
