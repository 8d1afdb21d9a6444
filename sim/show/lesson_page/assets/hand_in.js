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

/**
 * Send what was answered to the server of the class; whether it arrived.
 * @param {HandInDocument} handIn
 */
export async function sendHandIn(handIn) {
  const answer = await window.fetch("hand-in", { method: "POST", body: JSON.stringify(handIn) }).catch(() => null);
  return answer !== null && answer.ok;
}
