// Begins the page: its language, then the replay of its document.
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { decode } from "./decode.js";
import { readDocument } from "./handed.js";
import { buildPage } from "./page.js";

/**
 * What tests and other scripts may call.
 * @param {ReturnType<typeof buildPage>} page
 */
function publicPart({ player: all, view }) {
  const { seek, seekBlock, seekStep, stepBy, blockBy, play, pause, setSpeed, setLoop, state, duration } = all;
  return { seek, seekBlock, seekStep, stepBy, blockBy, play, pause, setSpeed, setLoop, state, duration, view };
}

/** Decode and build; what goes wrong stands in the page. */
async function start() {
  try {
    const page = buildPage(await decode(await readDocument()));
    Object.assign(player, publicPart(page));
  } catch (error) {
    element("#loading", HTMLElement).textContent = language.say("cannot_play", { error: String(error) });
    throw error;
  }
}

language.begin();

/** For tests and other scripts: `ready`, and from then on the player's functions and the view. */
export const player = { ready: start() };
