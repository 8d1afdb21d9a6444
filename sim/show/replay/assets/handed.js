// Reads the document that the page hands over, and unpacks its long columns.
import { unpacked } from "../../html/assets/packed.js";

/** @import { Packed } from "../../html/assets/packed.js" */
/** @import { Curves, ReplayDocument } from "./document.js" */

/** @typedef {ReplayDocument & { faces: Curves[] }} Handed With what a leaning wire cuts at bottom and top; else empty. */

/**
 * Columns with their values at hand: of long ones typed arrays, which do all that is asked of columns.
 * @param {Record<string, ArrayLike<unknown> | Packed | null>} columns
 */
export async function columnsOf(columns) {
  const found = Object.entries(columns).map(async ([name, column]) => [name, column && (await unpacked(column))]);
  return Object.fromEntries(await Promise.all(found));
}

/**
 * The document of a page: of this one, or of another that was read.
 * @param {ParentNode} page
 * @returns {Promise<Handed>}
 */
export async function readDocument(page = document) {
  const handed = JSON.parse(page.querySelector("#document")?.textContent ?? "");
  const drawn = handed.drawing && columnsOf(handed.drawing);
  const [blocks, plan, drawing] = await Promise.all([columnsOf(handed.blocks), columnsOf(handed.plan), drawn]);
  const lean = JSON.parse(page.querySelector("#lean")?.textContent ?? "null");
  const faces = lean ? await Promise.all([columnsOf(lean.lower), columnsOf(lean.upper)]) : [];
  return { ...handed, blocks, plan, drawing, faces };
}
