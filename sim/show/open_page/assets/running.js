// The run of the text as it stands: what it is run with, and how far it is.
import * as asked from "./asked.js";
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { wireMade } from "./made.js";

/** @import { RunState } from "./data.js" */

const LOOK_MS = 250;
const NOTHING = { name: "", text: "", number: "", drawing: "", block: "" };

/** @type {Record<string, string>} */
const STAGES = {
  checks: "stage-checks", plan: "stage-plan", run: "stage-run", kerf: "stage-kerf", pictures: "stage-pictures",
  pages: "stage-pages", film: "stage-film", drawing: "stage-drawing", figures: "stage-figures", write: "stage-write",
  comparison: "stage-comparison", drills: "stage-drills",
};

/**
 * Let the form run programs; the answer tells it that the program is another one.
 * @param {object} page
 * @param {() => { name: string, text: string, number: string, drawing: string, block: string }} page.current
 *   the program as it stands, and the block of the caret
 * @param {() => Record<string, string>} page.values of the form
 * @param {() => boolean} page.isRight whether all of them can be
 * @param {() => void} page.onStart
 * @param {() => void} page.onDrafted a program was made of a drawing
 * @param {(run: number | null) => void} page.onRun another run has ended well, or there is none any more
 * @param {(key: string) => void} page.tell says what went wrong
 */
export function wireRun({ current, values, isRight, onStart, onDrafted, onRun, tell }) {
  const start = element("#start", HTMLButtonElement);
  const cancel = element("#cancel", HTMLButtonElement);
  const bar = element("#progress", HTMLProgressElement);
  const said = element("#stage", HTMLElement);
  const moment = element("#moment", HTMLAnchorElement);
  const made = wireMade((more) => take(asked.more(more)));
  let looking = 0;
  /** @type {RunState} */
  let known = { state: "idle" };
  let ran = { ...NOTHING };
  /** @type {number | null} */
  let told = null; // the run that was told of last

  /** What came of a job that has ended well. */
  function ending() {
    if (known.job === "program") return language.say("drafted");
    return language.say(known.verdict === "fail" ? "ran-fail" : "ran-pass", { machine: known.machine ? language.pick(known.machine) : "" });
  }

  /** What there is to say of the run. */
  function sentence() {
    if (known.state === "running") return language.say(STAGES[known.stage ?? ""] ?? "starting");
    if (known.state === "done") return ending();
    if (known.state === "wrong") return known.why ? language.pick(known.why) : language.say("ran-broken");
    return known.state === "cancelled" ? language.say("ran-cancelled") : "";
  }

  /**
   * A link to the block of the caret in the replay, where that is of the text as it stands.
   * @param {boolean} isOther
   */
  function showMoment(isOther) {
    const { block } = current();
    moment.hidden = !known.files || isOther || !block;
    moment.href = `run/${known.run}/replay.html#block=${encodeURIComponent(block)}`;
    moment.textContent = language.say("replay-at", { block });
  }

  /**
   * Show the buttons and how far a job is.
   * @param {boolean} isRunning
   */
  function showJob(isRunning) {
    start.disabled = isRunning || !isRight() || !current().text.trim(); // a program that has not come yet is none to run
    start.hidden = isRunning;
    cancel.hidden = bar.hidden = !isRunning;
    bar.value = isRunning && known.of ? ((known.at ?? 0) + (known.share ?? 0)) / known.of : 0;
  }

  /** Show how far the run is. */
  function show() {
    showJob(known.state === "running");
    const isOther = Boolean(known.files) && current().text !== ran.text;
    said.textContent = sentence();
    if (isOther) said.append(` · ${language.say("ran-other", { name: ran.name })}`);
    said.className = known.state === "done" ? known.verdict ?? "" : known.state;
    made.show(known, ran.name);
    showMoment(isOther);
    const run = known.files && !isOther ? known.run ?? null : null;
    if (run !== told) {
      told = run;
      onRun(run);
    }
  }

  /**
   * Take what is known, and look again while it runs.
   * @param {Promise<RunState>} coming
   */
  async function take(coming) {
    window.clearTimeout(looking);
    try {
      known = await coming;
      if (known.state === "done" && known.job === "program") onDrafted();
      if (known.state === "running") looking = window.setTimeout(() => take(asked.progress()), LOOK_MS);
    } catch {
      known = { state: "idle" };
      tell("no-server");
    }
    show();
  }

  start.addEventListener("click", () => {
    ran = current();
    onStart();
    take(asked.run({ ...ran, ...values() }));
  });
  cancel.addEventListener("click", () => take(asked.cancel()));
  language.onChange(show);
  return {
    show,
    follow: take,
    /** What the run of the text as it stands came to; null where there is none. */
    result: () => (known.files && current().text === ran.text ? { verdict: known.verdict ?? "pass", findings: known.findings ?? [], pages: known.pages ?? {} } : null),
  };
}
