// The program's text with the running block marked: only the lines that show are in the page.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const ROW = 22; // px, as in replay.css
  const SPARE = 6; // lines above and below those that show
  const LEFT_ALONE_MS = 4000; // after a reader scrolled, the list follows no block

  /** Rows of blocks by line, from 1. */
  function rowsByLine(blocks) {
    const rows = new Map();
    blocks.line.forEach((line, row) => {
      if (!rows.has(line)) rows.set(line, []);
      rows.get(line).push(row);
    });
    return rows;
  }

  /** An element with a class and a text. */
  function element(tag, name, text = "") {
    const made = document.createElement(tag);
    made.className = name;
    made.textContent = text;
    return made;
  }

  /** List of the program in `box`; `onPick(row)` and `onHover(row or null, event)` hear of blocks. */
  function program(box, doc, { onPick, onHover }) {
    const { blocks, program: { lines } } = doc;
    const rows = rowsByLine(blocks);
    const inner = element("div", "lines");
    const shown = new Map(); // line number to its element
    let running = 0;
    let scrolledAt = -Infinity;
    let isOwnScroll = false;
    inner.style.height = `${lines.length * ROW}px`;
    box.append(inner);

    /** Texts of a line: blocks, and what stands between them. */
    function pieces(line) {
      const text = lines[line - 1];
      const parts = [];
      let past = 0;
      let last = -1;
      for (const row of rows.get(line) || []) {
        if (blocks.character[row] === last) continue; // a row that the controller added to that block
        last = blocks.character[row];
        if (last > past) parts.push(document.createTextNode(text.slice(past, last)));
        past = Math.max(past, last + blocks.characters[row]);
        const block = element("span", "block", text.slice(last, past));
        block.dataset.row = row;
        parts.push(block);
      }
      return [...parts, document.createTextNode(text.slice(past))];
    }

    /** Mark the running block in its line. */
    function mark(line) {
      const isRunning = line === blocks.line[running];
      const made = shown.get(line);
      made.classList.toggle("running", isRunning);
      made.setAttribute("aria-selected", isRunning);
      if (isRunning) box.setAttribute("aria-activedescendant", made.id);
      for (const block of made.querySelectorAll(".block")) {
        const isIt = isRunning && blocks.character[block.dataset.row] === blocks.character[running];
        block.classList.toggle("now", isIt);
      }
    }

    /** The element of a line. */
    function build(line) {
      const made = element("div", "line");
      made.id = `line-${line}`;
      made.setAttribute("role", "option");
      made.setAttribute("aria-setsize", lines.length);
      made.setAttribute("aria-posinset", line);
      made.style.transform = `translateY(${(line - 1) * ROW}px)`;
      if (rows.has(line)) made.dataset.row = rows.get(line)[0];
      made.append(element("span", "number", line), ...pieces(line));
      inner.append(made);
      shown.set(line, made);
      mark(line);
    }

    /** Have the lines in the page that show, and no others. */
    function show() {
      const first = Math.max(1, Math.floor(box.scrollTop / ROW) + 1 - SPARE);
      const last = Math.min(lines.length, Math.ceil((box.scrollTop + box.clientHeight) / ROW) + SPARE);
      for (const [line, made] of shown) {
        if (line >= first && line <= last) continue;
        made.remove();
        shown.delete(line);
      }
      for (let line = first; line <= last; line++) if (!shown.has(line)) build(line);
    }

    /** Scroll so that the running line is well within the list. */
    function follow() {
      if (performance.now() - scrolledAt < LEFT_ALONE_MS) return;
      const top = (blocks.line[running] - 1) * ROW;
      if (top >= box.scrollTop + ROW && top <= box.scrollTop + box.clientHeight - 2 * ROW) return;
      isOwnScroll = true;
      box.scrollTop = top - box.clientHeight / 2;
    }

    /** Row of the block under a pointer, or null. */
    function rowAt(event) {
      const on = event.target.closest("[data-row]");
      return on ? Number(on.dataset.row) : null;
    }

    box.addEventListener("scroll", () => {
      if (!isOwnScroll) scrolledAt = performance.now();
      isOwnScroll = false;
      show();
    });
    box.addEventListener("click", (event) => rowAt(event) !== null && onPick(rowAt(event)));
    box.addEventListener("pointermove", (event) => event.pointerType === "mouse" && onHover(rowAt(event), event));
    box.addEventListener("pointerleave", (event) => onHover(null, event));
    new ResizeObserver(() => {
      follow();
      show();
    }).observe(box);

    return {
      /** Mark the block that runs, and bring it into view. */
      run(row) {
        if (row === running && shown.size) return;
        const before = running;
        running = row;
        follow();
        show();
        for (const line of [blocks.line[before], blocks.line[row]]) if (shown.has(line)) mark(line);
      },
    };
  }

  Object.assign(Drycut, { program, element });
})(globalThis);
