// Find the fault: a line and what is wrong with it.
import { element, elements, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Step } from "./step.js" */

/**
 * A task of a fault.
 * @param {Step} step
 */
export function faultTask({ form, rules, number }) {
  const { lines, group } = rules.faults[number];
  const answer = element(".answer", HTMLElement, form);
  const reasons = element(".reasons", HTMLElement, form);

  /**
   * The value that was chosen of a name; empty where none was.
   * @param {string} name
   */
  function chosen(name) {
    const found = form.querySelector(`input[name^="${name}-"]:checked`);
    return found instanceof HTMLInputElement ? found.value : "";
  }

  return {
    answer: () => (chosen("line") && chosen("group") ? `${chosen("line")} ${chosen("group")}` : ""),
    /**
     * What of an attempt is right.
     * @param {string} text
     */
    reveal(text) {
      const [line, what] = text.split(" ");
      const isLine = lines.includes(Number(line));
      const key = isLine === (what === group) ? "" : isLine ? "line_right" : "fault_right";
      reasons.replaceChildren(...(key ? [make("li", {}, language.say(key))] : []));
    },
    write() {},
    /** Show the answer. */
    close() {
      form.classList.add("answered");
      answer.hidden = false;
      for (const fault of form.querySelectorAll("path.fault, .red")) fault.removeAttribute("hidden");
      for (const input of elements("input", form)) {
        if (!(input instanceof HTMLInputElement)) continue;
        input.disabled = true;
        const label = input.closest("label");
        if (input.checked && label && !label.classList.contains("at")) label.classList.add("wrong");
      }
    },
  };
}
