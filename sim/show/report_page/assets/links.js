"use strict";
// What a link leads to is open, and explanations are when they are printed; the replay is opened in the language of the page.
(function (global) {
  const Drycut = (global.Drycut = global.Drycut || {});

  /** Open what the address names, if it can be opened. */
  function openNamed() {
    const named = document.getElementById(global.location.hash.slice(1));
    if (named instanceof HTMLDetailsElement) named.open = true;
  }

  /** Lead to the replay in the language of the page. */
  function nameReplay() {
    for (const link of document.querySelectorAll("a.replay")) link.href = `replay.html#lang=${Drycut.language.current()}`;
  }

  global.addEventListener("hashchange", openNamed);
  global.addEventListener("beforeprint", () => {
    for (const folded of document.querySelectorAll(".codes details")) folded.open = true;
  });
  Drycut.language.onChange(nameReplay);
  nameReplay();
  openNamed();
})(window);
