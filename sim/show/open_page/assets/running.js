// The run of the text as it stands: what it is run with, how far it is, and its files.
import * as asked from "./asked.js";
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { RunState } from "./data.js" */

const LOOK_MS = 250;
const FILES = /** @type {const} */ ([
  ["replay.html", "file-replay"], ["report.html", "file-report"], ["cut.png", "file-picture"], ["report.json", "file-data"],
]);

/** @type {Record<string, string>} */
const STAGES = {
  checks: "stage-checks", plan: "stage-plan", run: "stage-run", kerf: "stage-kerf", pictures: "stage-pictures",
  pages: "stage-pages",
};

/**
 * Let the form run programs.
 * @param {() => { name: string, text: string }} current the program as it stands
 * @param {(key: string) => void} tell says what went wrong
 */
export function wireRun(current, tell) {
  const form = element("#run", HTMLElement);
  const start = element("#start", HTMLButtonElement);
  const cancel = element("#cancel", HTMLButtonElement);
  const bar = element("#progress", HTMLProgressElement);
  const said = element("#stage", HTMLElement);
  const made = element("#made", HTMLElement);
  let looking = 0;
  /** @type {RunState} */
  let known = { state: "idle" };

  /** The values of the form by their names. */
  function values() {
    const fields = form.querySelectorAll("input, select");
    return Object.fromEntries([...fields].map((field) => {
      if (!(field instanceof HTMLInputElement || field instanceof HTMLSelectElement)) return ["", ""];
      return [field.name, field.value.trim()];
    }));
  }

  /** What there is to say of the run. */
  function sentence() {
    if (known.state === "running") return known.stage ? language.say(STAGES[known.stage] ?? "starting") : language.say("starting");
    if (known.state === "done") return language.say(known.verdict === "pass" ? "ran-pass" : "ran-fail", { machine: known.machine ?? "" });
    if (known.state === "wrong") return known.why ? known.why.replace(/^\S*\/program\//, "") : language.say("ran-broken");
    return known.state === "cancelled" ? language.say("ran-cancelled") : "";
  }

  /** Links to the files of a run. */
  function links() {
    if (known.state !== "done") return [];
    return FILES.map(([file, key]) => {
      const href = `run/${known.run}/${file}`;
      return make("a", { href, target: "_blank", rel: "noopener" }, language.say(key));
    });
  }

  /** Show how far the run is. */
  function show() {
    const isRunning = known.state === "running";
    start.disabled = isRunning;
    cancel.hidden = bar.hidden = !isRunning;
    bar.value = isRunning && known.of ? ((known.at ?? 0) + (known.share ?? 0)) / known.of : 0;
    said.textContent = sentence();
    said.className = known.state === "done" ? known.verdict ?? "" : known.state;
    made.replaceChildren(...links());
  }

  /**
   * Take what is known, and look again while it runs.
   * @param {Promise<RunState>} coming
   */
  async function take(coming) {
    window.clearTimeout(looking);
    try {
      known = await coming;
      if (known.state === "running") looking = window.setTimeout(() => take(asked.progress()), LOOK_MS);
    } catch {
      known = { state: "idle" };
      tell("no-server");
    }
    show();
  }

  start.addEventListener("click", () => take(asked.run({ ...current(), ...values() })));
  cancel.addEventListener("click", () => take(asked.cancel()));
  language.onChange(show);
}
