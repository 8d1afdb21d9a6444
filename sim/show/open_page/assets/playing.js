// The time line under the picture: it plays the path at the machine's feeds at once, and a run once there is one.
import { element, elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { playerActions, showPlayer, wireButtons, wireSpeed } from "../../replay/assets/controls.js";
import { actionOf, readKeys } from "../../replay/assets/keys.js";
import { decode } from "../../replay/assets/decode.js";
import { readDocument } from "../../replay/assets/handed.js";
import { kerfOf } from "../../replay/assets/kerf.js";
import { modelOf } from "../../replay/assets/model.js";
import { piecesOf } from "../../replay/assets/pieces.js";
import { playerOf } from "../../replay/assets/player.js";
import { cutSamples, widthSamples } from "../../replay/assets/stage.js";
import { timelineIn } from "../../replay/assets/timeline.js";
import * as words from "../../replay/assets/words.js";
import { plannedOf } from "./planned.js";

/** @import { Finding, Path } from "./data.js" */
/** @import { Kerf } from "../../replay/assets/kerf.js" */
/** @import { Deviation } from "../../replay/assets/model.js" */
/** @import { Pieces } from "../../replay/assets/pieces.js" */
/** @import { Played, Player, PlayerState, Timed } from "../../replay/assets/player.js" */
/** @import { Lined } from "../../replay/assets/timeline.js" */
/** @import { Colours } from "../../replay/assets/palette.js" */

/**
 * What is played: a path at the feeds, or a run.
 * @typedef {object} Show
 * @property {Played & { doc: Lined }} replay
 * @property {Timed & { deviation: (t: number) => Deviation }} model
 * @property {Kerf} kerf
 * @property {ArrayLike<number>} sampleT
 * @property {Pieces | null} pieces of a run
 * @property {number} wireUm diameter
 * @property {boolean} isRun
 */

/**
 * What a frame shows: a moment, whether it is played, and when that is for what falls, ms.
 * @typedef {{ show: Show, moment: PlayerState & { deviation: Deviation, isAsked: boolean }, isPlaying: boolean, time: number }} Shown
 */

/**
 * The run of a replay's page, to be played here.
 * @param {string} html of that page
 * @param {Colours} colours
 * @returns {Promise<Show>}
 */
export async function showOfRun(html, colours) {
  const replay = await decode(await readDocument(new window.DOMParser().parseFromString(html, "text/html")));
  const { doc, samples } = replay;
  return {
    replay, model: modelOf(replay), sampleT: samples.t,
    kerf: kerfOf(samples, cutSamples(replay), widthSamples(replay), colours),
    pieces: piecesOf(doc, colours), wireUm: doc.wire_diameter_um, isRun: true,
  };
}

/**
 * A path at the machine's feeds.
 * @param {Path} path
 * @param {Finding[]} findings
 * @param {{ wireUm: number, reachUm: number }} wire its diameter, and half the width that it cuts
 * @param {Colours} colours
 * @returns {Show}
 */
export function showOfPath(path, findings, { wireUm, reachUm }, colours) {
  const { replay, model, samples, cuts } = plannedOf(path, findings);
  return {
    replay, model, kerf: kerfOf(samples, cuts, () => 2 * reachUm, colours), sampleT: samples.t, pieces: null, wireUm, isRun: false,
  };
}

/**
 * The time line of the page.
 * @param {object} page
 * @param {Colours} page.colours
 * @param {(shown: Shown | null) => boolean} page.draw draws a moment; whether a piece still falls
 * @param {(shown: Shown | null) => void} page.tell hears of each moment that shows
 */
export function wirePlaying({ colours, draw, tell }) {
  const place = element("#play", HTMLElement);
  const keys = readKeys();
  const template = element("#transport-template", window.HTMLTemplateElement);
  /** @type {{ show: Show, player: Player, timeline: ReturnType<typeof timelineIn> } | null} */
  let now = null;
  let wanted = 0;
  /** @type {number | null} */
  let last = null;
  let isUnderWay = false; // whether anyone has played or sought in what is played

  /** Ask for a frame. */
  function redraw() {
    if (!wanted) wanted = requestAnimationFrame(frame);
  }

  /**
   * @param {string} name
   * @param {string} text
   */
  function out(name, text) {
    const found = element(`[data-out="${name}"]`, HTMLElement, place);
    if (found.textContent !== text) found.textContent = text;
  }

  /**
   * One frame: let time go by, and show the moment.
   * @param {number} time
   */
  function frame(time) {
    wanted = 0;
    if (!now) {
      draw(null);
      tell(null);
      return;
    }
    const { show, player, timeline } = now;
    const wasPlaying = player.playing;
    player.advance(last === null ? 0 : (time - last) / 1000);
    const state = player.state();
    const deviation = show.model.deviation(state.t);
    const [x, y] = show.isRun ? [state.x, state.y] : state.wire; // no steps command a path that was not run
    const moment = { ...state, x, y, deviation, isAsked: false };
    const shown = { show, moment, isPlaying: wasPlaying, time };
    const isFalling = draw(shown);
    timeline.at(state.t);
    const bar = element("#bar", HTMLElement, place);
    bar.setAttribute("aria-valuenow", state.t.toFixed(3));
    bar.setAttribute("aria-valuetext", words.clock(state.t));
    out("elapsed", words.clock(state.t));
    out("remaining", words.clock(state.remaining_s));
    tell(shown);
    last = player.playing || isFalling ? time : null;
    if (last !== null) redraw();
  }

  /**
   * Keys act where the picture or the time line has the focus: elsewhere they belong to text and form.
   * @param {KeyboardEvent} event
   */
  function onKey(event) {
    const action = now && playerActions(now.player)[actionOf(event, keys) ?? ""];
    if (!action) return;
    event.preventDefault();
    action();
  }

  place.addEventListener("keydown", onKey);
  element("#picture", HTMLElement).addEventListener("keydown", onKey);
  language.onChange(() => {
    now?.timeline.redo();
    redraw();
  });

  return {
    redraw,
    /**
     * Play something else; the place in time stays where it is the same program, played in the same way.
     * @param {Show | null} show
     * @param {boolean} isNew whether it is another program
     */
    begin(show, isNew) {
      const before = now;
      const mayStay = !isNew && before !== null && show !== null && before.show.isRun === show.isRun;
      place.hidden = !show;
      place.replaceChildren();
      now = null;
      last = null;
      redraw();
      if (!show) return;
      place.append(template.content.cloneNode(true));
      language.nameControls();
      const player = playerOf(show.replay, show.model);
      const timeline = timelineIn(
        {
          bar: element("#bar", HTMLElement, place), marks: element("#marks", HTMLCanvasElement, place),
          cursor: element("#cursor", HTMLElement, place), findings: element("#finding-marks", HTMLElement, place),
          whole: element("#whole-run", HTMLElement, place),
        },
        show.replay.doc, player, colours,
        {
          onSeek: player.seek, onBlock: player.seekBlock,
          onFinding: ({ row, t_s: t }) => (row === null ? player.seek(t) : player.seekBlock(row)),
        },
      );
      element("#bar", HTMLElement, place).setAttribute("aria-valuemax", String(player.duration));
      element("[data-of-run]", HTMLElement, place).hidden = !show.isRun;
      element("[data-of-feeds]", HTMLElement, place).hidden = show.isRun;
      now = { show, player, timeline };
      wireButtons(playerActions(player), elements("[data-do]", place));
      wireSpeed(element("#speed", HTMLInputElement, place), element("#speed-shown", HTMLElement, place), player);
      if (mayStay) player.seek(before.player.place.t);
      else isUnderWay = false;
      player.onChange(() => {
        isUnderWay = true;
        showPlayer(player);
        timeline.loop(player.loop);
        redraw();
      });
      showPlayer(player);
    },
    /**
     * Go to a block by its row, where the replay is under way.
     * @param {number} row
     */
    follow(row) {
      const player = now?.player;
      if (player && isUnderWay && !player.playing && row >= 0 && row !== player.place.block) player.seekBlock(row);
    },
  };
}
