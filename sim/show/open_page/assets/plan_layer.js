// The plan as the picture has it: drawn over the drawing, with the grips of one of its figures.
import { pathOf } from "../../replay/assets/path.js";
import { drawGrips, gripsOf } from "./grips.js";
import { drawPlan, figureAt } from "./plan.js";
import { rowAt } from "./snap.js";

/** @import { Planned } from "./data.js" */
/** @import { Grips } from "./grips.js" */
/** @import { Place } from "../../replay/assets/document.js" */
/** @import { Pen } from "../../replay/assets/pen.js" */
/** @import { Shades } from "../../replay/assets/palette.js" */
/** @import { View } from "../../replay/assets/view.js" */

/** The plan that is shown, if there is one. */
export function planLayer() {
  /** @type {{ plan: Planned, drawn: ReturnType<typeof pathOf> } | null} */
  let planned = null;
  /** @type {Grips | null} */
  let grips = null;
  let gripped = 0; // number of the figure that has grips

  return {
    /**
     * Another plan; null for none.
     * @param {Planned | null} plan
     */
    set(plan) {
      planned = plan?.path ? { plan, drawn: pathOf(plan.path) } : null;
      grips = planned && gripsOf(planned.plan, gripped);
    },
    /**
     * @param {Pen} pen
     * @param {View} view
     * @param {Shades} shades
     */
    draw(pen, view, shades) {
      if (!planned) return;
      drawPlan(pen, view, planned.plan, planned.drawn, shades);
      if (grips) drawGrips(pen, view, grips, shades);
    },
    /**
     * The figure at a place, µm; null where none is near.
     * @param {Place} place
     * @param {number} nearUm
     */
    figureAt(place, nearUm) {
      const { plan, drawn } = planned ?? {};
      return plan?.path && drawn ? figureAt(plan.figures ?? [], place, rowAt(plan.path, drawn, place, nearUm), nearUm) : null;
    },
    /**
     * Give the figure at a place the grips; whether it has not had them.
     * @param {Place} place
     * @param {number} nearUm
     */
    grip(place, nearUm) {
      const figure = this.figureAt(place, nearUm);
      if (!planned || !figure || figure.number === grips?.figure.number) return false;
      gripped = figure.number;
      grips = gripsOf(planned.plan, gripped);
      return true;
    },
    /** The plan, its row at a place, and the grips. */
    now: () => planned && grips && {
      plan: planned.plan,
      grips,
      /**
       * @param {Place} place
       * @param {number} nearUm
       */
      rowAt: (place, nearUm) => (planned?.plan.path ? rowAt(planned.plan.path, planned.drawn, place, nearUm) : -1),
    },
  };
}
