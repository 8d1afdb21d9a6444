// The stretch of the run that the time line shows: all of it, or the part that is looked at more closely.
import { clamp } from "./numbers.js";

/** @typedef {ReturnType<typeof spanOf>} Span */

const LEAST_S = 0.01; // that is shown over the whole bar

/**
 * Span of a run of so many seconds; its width in px is set as the page has it.
 * @param {number} duration
 */
export function spanOf(duration) {
  let since = 0;
  let until = duration;

  const span = {
    width: 1,
    get since() { return since; },
    get until() { return until; },
    get isWhole() { return since <= 0 && until >= duration; },
    /**
     * Where a time is on the bar, px; outside of it where the bar does not show it.
     * @param {number} t
     */
    toX: (t) => (until > since ? ((Math.min(t, duration) - since) / (until - since)) * span.width : 0),
    /**
     * Time under a place of the bar.
     * @param {number} x
     */
    toT: (x) => since + clamp(x / span.width, 0, 1) * (until - since),
    /**
     * Show a stretch, within the run.
     * @param {number} from
     * @param {number} to
     */
    show(from, to) {
      const length = clamp(to - from, Math.min(LEAST_S, duration), duration);
      since = clamp(from, 0, duration - length);
      until = since + length;
    },
    whole: () => span.show(0, duration),
    /**
     * Show so many times less, so that the time under a place stays there.
     * @param {number} x
     * @param {number} factor
     */
    zoomAt(x, factor) {
      const [t, length] = [span.toT(x), (until - since) / factor];
      span.show(t - clamp(x / span.width, 0, 1) * length, t + length);
    },
    /**
     * Bring a time into what is shown; whether it was not.
     * @param {number} t
     */
    bring(t) {
      if (t >= since && t <= until) return false;
      span.show(t, t + until - since);
      return true;
    },
  };
  return span;
}
