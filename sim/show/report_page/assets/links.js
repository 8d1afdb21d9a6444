// What a link leads to is open; the replay is opened in the language of the page.
import { elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** Open what the address names, if it can be opened. */
function openNamed() {
  const named = document.getElementById(window.location.hash.slice(1));
  const folded = named?.closest("details");
  if (folded) folded.open = true;
}

/** Lead to the replay in the language of the page. */
function nameReplay() {
  for (const link of elements("a.replay")) link.setAttribute("href", `replay.html#lang=${language.current()}`);
}

/** Have links and printing do so. */
export function wireLinks() {
  window.addEventListener("hashchange", openNamed);
  language.onChange(nameReplay);
  nameReplay();
  openNamed();
}
