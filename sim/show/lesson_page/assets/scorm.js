// A learning platform round the page (SCORM 1.2, run-time environment): it knows who learns, and takes the score.

/** Windows above this one in which the specification has a page look for the platform. */
const MOST_WINDOWS = 7;
const DONE = "";

/**
 * What a platform offers: texts in, texts out.
 * @typedef {object} Platform
 * @property {(empty: string) => string} LMSInitialize
 * @property {(empty: string) => string} LMSFinish
 * @property {(empty: string) => string} LMSCommit
 * @property {(name: string) => string} LMSGetValue
 * @property {(name: string, value: string) => string} LMSSetValue
 */

/**
 * The platform that a window or one above it has; one of another origin says nothing.
 * @param {Window | null} from
 * @returns {Platform | null}
 */
function platformOf(from) {
  let at = from;
  for (let count = 0; at && count < MOST_WINDOWS; count += 1) {
    try {
      const found = /** @type {Window & { API?: Platform }} */ (at).API;
      if (found) return found;
    } catch {
      return null;
    }
    at = at.parent === at ? null : at.parent;
  }
  return null;
}

/**
 * Time as SCORM has it, HHHH:MM:SS.
 * @param {number} seconds
 */
export function spanOf(seconds) {
  const whole = Math.floor(seconds);
  const parts = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return parts.map((part, at) => String(part).padStart(at ? 2 : 4, "0")).join(":");
}

/** The platform of this page, begun; null where there is none. */
export function newPlatform() {
  const platform = platformOf(window) ?? platformOf(window.opener);
  if (!platform || platform.LMSInitialize(DONE) !== "true") return null;
  const began = performance.now();
  let isOver = false;
  if (platform.LMSGetValue("cmi.core.lesson_status") === "not attempted") {
    platform.LMSSetValue("cmi.core.lesson_status", "incomplete");
  }

  /** End the session, once. */
  function finish() {
    if (isOver) return;
    isOver = true;
    platform?.LMSSetValue("cmi.core.session_time", spanOf((performance.now() - began) / 1000));
    platform?.LMSCommit(DONE);
    platform?.LMSFinish(DONE);
  }

  window.addEventListener("pagehide", finish);
  return {
    name: platform.LMSGetValue("cmi.core.student_name"),
    /**
     * Hand a score over: a share of all points.
     * @param {number} share
     */
    score(share) {
      platform.LMSSetValue("cmi.core.score.min", "0");
      platform.LMSSetValue("cmi.core.score.max", "100");
      platform.LMSSetValue("cmi.core.score.raw", String(Math.round(share * 1000) / 10));
      platform.LMSSetValue("cmi.core.lesson_status", "completed");
      platform.LMSCommit(DONE);
    },
  };
}
