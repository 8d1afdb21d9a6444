// A moment of the run in the address of the page: #t=12.5, in seconds, or #block=N18, as the listing has it.
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { ReplayDocument } from "./document.js" */
/** @import { Player } from "./player.js" */

/**
 * What the address asks for under a name; nothing where it is not written as addresses are.
 * @param {string} name
 */
export function asked(name) {
  try {
    return new window.URLSearchParams(window.location.hash.slice(1)).get(name);
  } catch {
    return null;
  }
}

/**
 * The first row of a block by its name, its label or its number; -1 where there is none.
 * @param {ReplayDocument} doc
 * @param {string} block
 */
function rowOf({ blocks: { name, label, number } }, block) {
  return [name.indexOf(block), label.indexOf(block), number.indexOf(Number(block))].find((row) => row >= 0) ?? -1;
}

/**
 * Stand where the address says, now and whenever it changes; a link to where the replay stands.
 * @param {ReplayDocument} doc
 * @param {Player} player
 */
export function wireMoment(doc, player) {
  const button = element('[data-do="link"]', HTMLElement);
  const said = element("#live", HTMLElement);

  /** Go to what the address asks for; what is no moment of this run is left alone. */
  function go() {
    const [t, block] = [asked("t"), asked("block")];
    const row = block ? rowOf(doc, block) : -1;
    if (t && Number.isFinite(Number(t))) player.seek(Number(t));
    else if (row >= 0) player.seekBlock(row);
  }

  window.addEventListener("hashchange", go);
  button.hidden = window.top !== window; // the address of a frame is nobody's to copy
  go();

  return {
    /** Put the moment into the address, and copy that. */
    async link() {
      const kept = asked("lang");
      window.location.hash = `t=${player.state().t.toFixed(3)}${kept ? `&lang=${kept}` : ""}`;
      try {
        await window.navigator.clipboard.writeText(window.location.href);
        said.textContent = button.title = language.say("link_copied");
      } catch {
        said.textContent = button.title = language.say("link_in_address");
      }
    },
  };
}
