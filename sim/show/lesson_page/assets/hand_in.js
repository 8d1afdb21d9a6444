// The file that a pupil hands in.
import { save } from "../../html/assets/csv.js";

/** @import { HandInDocument } from "./data.js" */

/**
 * Save what was answered, under the names of class and pupil.
 * @param {HandInDocument} handIn
 */
export function saveHandIn(handIn) {
  const name = `${handIn.group} ${handIn.name}`.replace(/[\p{Cc}\\/:*?"<>|.]/gu, " ").replace(/\s+/g, " ").trim();
  save(`${name}.drycut.json`, JSON.stringify(handIn), "application/json");
}
