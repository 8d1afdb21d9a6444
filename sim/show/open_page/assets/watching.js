// What is watched: the path at the feeds or the run, with bar and text that follow it, and what the pointer is over.
import * as asked from "./asked.js";
import { showOfPath, showOfRun, wirePlaying } from "./playing.js";
import { mm } from "./size.js";
import { element } from "../../html/assets/elements.js";
import * as words from "../../replay/assets/words.js";

/** @import { Finding, Path } from "./data.js" */
/** @import { Show, Shown } from "./playing.js" */
/** @import { Picture } from "./picture.js" */
/** @import { Status } from "./status.js" */

const LATER_MS = 250; // until the time line is that of a text that was typed

/**
 * Let path and run be watched.
 * @param {object} page
 * @param {Picture} page.picture
 * @param {Status} page.status
 * @param {() => Path | null} page.path of the text as it stands
 * @param {() => Finding[]} page.findings all of them
 * @param {() => { wireUm: number, reachUm: number }} page.wire
 * @param {(line: number, isFollowed: boolean) => void} page.run marks the line that is played
 * @param {(key: string) => void} page.tell says what went wrong
 */
export function wireWatching({ picture, status, path, findings, wire, run, tell }) {
  const hover = element("#hover", HTMLElement);
  const playing = wirePlaying({ colours: picture.colours, draw: picture.at, tell: follow });
  /** @type {Show | null} */
  let ofRun = null;
  let number = 0; // of the run that is waited for
  let waiting = 0;

  /**
   * Let bar and text follow what is played.
   * @param {Shown | null} shown
   */
  function follow(shown) {
    status.at(shown);
    run(shown?.moment.t ? path()?.line[shown.moment.block] ?? 0 : 0, shown?.isPlaying ?? false);
  }

  /** Play the run, else the path at the feeds; of another program from its start. */
  function play(isNew = false) {
    window.clearTimeout(waiting);
    const known = path();
    playing.begin(ofRun ?? (known && showOfPath(known, findings(), wire(), picture.colours)), isNew);
  }

  return {
    play,
    /** Play it once nobody types any more. */
    later() {
      window.clearTimeout(waiting);
      waiting = window.setTimeout(() => play(), LATER_MS);
    },
    /**
     * Go to the first block of a line, from 1, where the replay is under way.
     * @param {number} line
     */
    toLine: (line) => playing.follow(path()?.line.indexOf(line) ?? -1),
    /**
     * A run takes the place of the path at the feeds; null where there is none any more.
     * @param {number | null} newNumber
     */
    async take(newNumber) {
      ofRun = null;
      number = newNumber ?? 0;
      if (newNumber === null) {
        play();
        return;
      }
      try {
        const shown = await showOfRun(await asked.pageOfRun(newNumber, "replay.html"), picture.colours);
        if (number !== newNumber) return;
        ofRun = shown;
        play();
      } catch {
        tell("no-replay");
      }
    },
    /**
     * Say what the pointer is over: a place, and the row of a block, −1 of none.
     * @param {[x: number, y: number] | null} place
     * @param {number} row
     */
    hover(place, row) {
      status.cursor(place);
      const known = path();
      if (!known || row < 0) {
        hover.textContent = "";
        return;
      }
      const radius = known.kind[row] === "arc" ? ` · R ${mm(known.radius_um[row])} mm` : "";
      hover.textContent = `${words.block({ ...known, label: known.name }, row)} · ${mm(known.length_um[row])} mm${radius}`;
    },
  };
}
