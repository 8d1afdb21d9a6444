// The page of a class while its lesson is served: it is shown anew when somebody has handed in.
import * as language from "../../html/assets/language.js";

const EVERY_MS = 2000;
/** @type {string | null} */
let known = null;

/** Look how many have handed in. */
async function look() {
  const answer = await window.fetch("number").catch(() => null);
  if (!answer || !answer.ok) return;
  const number = await answer.text();
  if (known !== null && number !== known) window.location.reload();
  known = number;
}

language.begin();
window.setInterval(look, EVERY_MS);
look();
