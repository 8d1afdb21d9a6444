// How the running block is decoded: each word with the field that it sets, the buffer, and the way of the block.
import { both, make } from "../../html/assets/elements.js";

/** @import { DecodedBlock, ReplayDocument } from "./document.js" */

/**
 * Elements that show a decoded block.
 * @param {DecodedBlock} block
 */
function parts({ text, steps, buffer, ways }) {
  const rows = steps.map(({ order, word, field, value }) =>
    make(
      "tr",
      {},
      make("td", {}, `${order} `, ...both(word)),
      make("td", { className: "mono" }, field),
      make("td", {}, ...both(value)),
    ),
  );
  const named = ways.flatMap(({ name, text: said }) => [make("dt", {}, ...both(name)), make("dd", {}, ...both(said))]);
  return [
    make("p", { className: "mono" }, text),
    make("table", {}, make("tbody", {}, ...rows)),
    make("dl", {}, make("dt", {}, "PROG_BUFFER"), make("dd", { className: "mono" }, buffer), ...named),
  ];
}

/**
 * The decoded block in the first of `boxes`; a page without decoded blocks has none.
 * @param {HTMLElement[]} boxes
 * @param {ReplayDocument} doc
 */
export function decodingIn([box], { decoding }) {
  let shown = -1;
  return {
    /**
     * Show the block of a row.
     * @param {number} row
     */
    run(row) {
      if (!box || !decoding) return;
      const index = decoding.of_row[row];
      if (index === shown || index < 0) return;
      shown = index;
      box.replaceChildren(...parts(decoding.blocks[index]));
    },
  };
}
