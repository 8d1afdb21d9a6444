// A sitting as a file: the keys that were pressed, by which the same cut is made again.

/** @import { Cut, Press } from "./machine.js" */
/** @import { Panel } from "./data.js" */

const SCHEMA = "drycut.sitting/1";
const MOST_PRESSES = 100000;
const MOST_BYTES = 8e6;

/**
 * Save a sitting.
 * @param {Panel} panel
 * @param {Cut} cut
 */
export function saveSitting(panel, cut) {
  const text = JSON.stringify({ schema: SCHEMA, cut: panel.digest, presses: [...cut.presses, ...cut.ahead] });
  const link = document.createElement("a");
  link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  link.download = "sitting.drycut.json";
  link.click();
  window.setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

/**
 * The keys of a file; null where it is no sitting of this cut.
 * @param {Panel} panel
 * @param {HTMLInputElement} input
 * @returns {Promise<Press[] | null>}
 */
export async function readSitting(panel, input) {
  const [file] = input.files ?? [];
  input.blur();
  if (!file || file.size > MOST_BYTES) return null;
  try {
    return pressesOf(JSON.parse(await file.text()), panel.digest);
  } catch {
    return null;
  } finally {
    input.value = "";
  }
}

/**
 * The keys that a text holds; null where they are none of this cut.
 * @param {{ schema?: unknown, cut?: unknown, presses?: unknown }} read
 * @param {string} digest
 * @returns {Press[] | null}
 */
function pressesOf(read, digest) {
  if (read.schema !== SCHEMA || read.cut !== digest || !Array.isArray(read.presses)) return null;
  if (read.presses.length > MOST_PRESSES) return null;
  const isPress = (/** @type {unknown} */ each) => Array.isArray(each) && each.length === 3
    && Number.isFinite(each[0]) && typeof each[1] === "string" && Number.isFinite(each[2]);
  return read.presses.every(isPress) ? read.presses : null;
}
