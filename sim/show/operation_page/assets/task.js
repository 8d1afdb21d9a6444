// One drill: what happened, what hands do in which order, and the cut that goes on then or not.
import { both, element, elements, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { jobOf } from "../../panel_page/assets/machine.js";
import { judge } from "../../panel_page/assets/plain_hands.js";

/** @import { OperationDrill, Operation } from "./data.js" */

const MOST_TRIES = 2;
const MOST_ACTIONS = 6;
const OUTCOMES = ["goes_on", "stands", "breaks_then", "shorts_then", "too_slow"];

/**
 * What a cut comes to after actions, in the order of `OUTCOMES`.
 * @param {Operation} data
 * @param {OperationDrill} drill
 * @param {number[]} actions
 */
export function outcomeOf(data, drill, actions) {
  const none = { kind: [], for_s: [], size: [], at: [], by_step: [0], by_time: [0] };
  return judge(jobOf({ ...data.panel, events: none }), Float64Array.from(drill.state), Float64Array.from(actions), drill.least_um);
}

/**
 * A drill in its form.
 * @param {HTMLElement} form
 * @param {Operation} data
 * @param {number} at
 * @param {() => void} onDone
 */
export function taskIn(form, data, at, onDone) {
  const drill = data.drills[at];
  const verdict = element("p.said", HTMLElement, form);
  const list = element(".chosen", HTMLElement, form);
  const go = element(".try", HTMLButtonElement, form);
  const undo = element(".undo", HTMLButtonElement, form);
  const next = element(".next", HTMLButtonElement, form);
  const task = { kind: "", actions: /** @type {number[]} */ ([]), tries: 0, what: 0, done: 0, outcome: -1 };

  /** Write which actions were chosen. */
  function write() {
    list.replaceChildren(...task.actions.map((action) => make("li", {}, ...both(language.said(`do_${data.actions[action]}`)))));
  }

  /** What the last try came to. */
  function tell() {
    const key = task.outcome < 0 ? "choose" : OUTCOMES[task.outcome];
    const isGood = task.outcome === 0;
    verdict.className = `said ${isGood ? "right" : "wrong"}`;
    const parts = [language.said(key)];
    if (task.outcome >= 0) parts.unshift(language.said(task.what ? "right_kind" : "wrong_kind", {}));
    if (task.outcome > 0 && task.tries < MOST_TRIES) parts.push(language.said("again"));
    verdict.replaceChildren(...parts.flatMap((part) => [...both(part), " "]));
  }

  /** Show which kind is right. */
  function reveal() {
    for (const input of elements(".kinds input", form)) {
      if (!(input instanceof HTMLInputElement)) continue;
      input.disabled = true;
      const label = input.closest("label");
      label?.classList.toggle("at", input.value === drill.kind);
      label?.classList.toggle("wrong", input.checked && input.value !== drill.kind);
    }
  }

  form.addEventListener("submit", () => {
    const chosen = form.querySelector(".kinds input:checked");
    task.kind = chosen instanceof HTMLInputElement ? chosen.value : "";
    if (!task.kind || !task.actions.length) {
      task.outcome = -1;
      tell();
      return;
    }
    if (task.tries === 0) task.what = Number(task.kind === drill.kind);
    task.tries += 1;
    task.outcome = outcomeOf(data, drill, task.actions);
    if (task.outcome === 0) task.done = task.tries === 1 ? 1 : 0.5;
    reveal();
    tell();
    if (task.outcome === 0 || task.tries >= MOST_TRIES) {
      go.hidden = true;
      undo.hidden = true;
      next.hidden = false;
      next.focus();
    }
  });
  for (const button of elements("[data-action]", form)) {
    button.addEventListener("click", () => {
      if (task.actions.length < MOST_ACTIONS && next.hidden) task.actions.push(Number(button.dataset.action));
      write();
    });
  }
  undo.addEventListener("click", () => {
    task.actions.pop();
    write();
  });
  next.addEventListener("click", onDone);

  return {
    task,
    /** @param {boolean} isShown */
    show(isShown) {
      form.classList.toggle("aside-now", !isShown);
      if (!isShown) return;
      window.scrollTo(0, 0);
      element("h2", HTMLElement, form).focus();
    },
  };
}

/** @typedef {ReturnType<typeof taskIn>} Task */
