// What is dragged at a planned figure goes into the fields of the drawing, and a plan is asked for anew.
import { element } from "../../html/assets/elements.js";
import { dragged, gripAt, passAt, turned, withMore } from "./grips.js";

/** @import { Wishes } from "./grips.js" */
/** @import { Picture } from "./picture.js" */
/** @import { Place } from "../../replay/assets/document.js" */

const NEAR_PX = 12; // as far off a place of a pointer still means something

/**
 * Let the grips of the plan be dragged and clicked.
 * @param {Picture} picture
 */
export function wireGripping(picture) {
  const direction = element("#direction", HTMLSelectElement);
  const side = element("#wire-side", HTMLSelectElement);
  const tab = element("#tab", HTMLInputElement);
  const passes = element("#passes", HTMLInputElement);
  const clickDoes = element("#click-does", HTMLSelectElement);

  /** What can be taken hold of; null where no plan is shown, or its tab is not. */
  function now() {
    return element("#panel-drawing", HTMLElement).hidden ? null : picture.planned();
  }

  /** @returns {Wishes} */
  function wishes() {
    const written = passes.value.match(/[\d.]+/g) ?? [passes.placeholder];
    return { direction: direction.value, side: side.value, tab: tab.value.trim(), passes: written.map(Number) };
  }

  /**
   * Put into the fields what is wished otherwise than before.
   * @param {Wishes} before
   * @param {Wishes} wished
   */
  function put(before, wished) {
    /** @type {[HTMLSelectElement | HTMLInputElement, string, string][]} */
    const fields = [
      [direction, before.direction, wished.direction], [side, before.side, wished.side], [tab, before.tab, wished.tab],
      [passes, before.passes.join(" "), wished.passes.join(" ")],
    ];
    for (const [field, was, is] of fields) {
      if (was === is) continue;
      field.value = is;
      field.dispatchEvent(new window.Event("input", { bubbles: true }));
    }
  }

  return {
    /**
     * Take hold of the grip, or the pass, at a place, µm: what drags it to others; null where there is none.
     * @param {Place} place
     * @param {number} nearUm
     * @returns {((place: Place) => void) | null}
     */
    mark(place, nearUm) {
      const shown = now();
      if (!shown) return null;
      const [pxUm, before] = [nearUm / NEAR_PX, wishes()];
      const grip = gripAt(shown.grips, place, nearUm, pxUm) ?? passAt(shown.plan, shown.rowAt(place, nearUm), place, before, pxUm);
      return grip && ((to) => put(wishes(), dragged(grip, shown.grips, to, before)));
    },
    /**
     * Turn what is clicked round, or add a pass where clicks do that; whether the click is taken.
     * @param {Place} place
     * @param {number} nearUm
     */
    click(place, nearUm) {
      const shown = now();
      if (!shown) return false;
      const grip = gripAt(shown.grips, place, nearUm, nearUm / NEAR_PX);
      if (grip?.name === "direction" || grip?.name === "side") put(wishes(), turned(grip.name, shown.grips.figure, wishes()));
      else if (clickDoes.value === "passes" && picture.figureAt(place, nearUm)) put(wishes(), withMore(wishes()));
      else return grip !== null;
      return true;
    },
    /**
     * The pointer is at a place: the figure there has the grips.
     * @param {Place | null} place
     * @param {number} nearUm
     */
    hover(place, nearUm) {
      if (place && now()) picture.grip(place, nearUm);
    },
  };
}
