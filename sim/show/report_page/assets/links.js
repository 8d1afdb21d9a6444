// What a link leads to is open, and explanations are when they are printed; the replay is opened in the language of the page.
import { elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** Open what the address names, if it can be opened. */
function openNamed() {
  const named = document.getElementById(window.location.hash.slice(1));
  if (named instanceof HTMLDetailsElement) named.open = true;
}

/** Open all explanations. */
function openExplanations() {
  for (const folded of elements(".codes details")) folded.setAttribute("open", "");
}

/** Lead to the replay in the language of the page. */
function nameReplay() {
  for (const link of elements("a.replay")) link.setAttribute("href", `replay.html#lang=${language.current()}`);
}

/** Have links and printing do so. */
export function wireLinks() {
  window.addEventListener("hashchange", openNamed);
  window.addEventListener("beforeprint", openExplanations);
  language.onChange(nameReplay);
  nameReplay();
  openNamed();
}
