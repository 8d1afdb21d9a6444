// One task: what was chosen, how it is weighed, and the answer.
import { element, elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Drill } from "./data.js" */

/** @typedef {ReturnType<typeof taskIn>} Task */

/**
 * A task in its form.
 * @param {HTMLElement} form
 * @param {Drill} drill
 * @param {() => void} onDone
 */
export function taskIn(form, drill, onDone) {
  const answer = element(".answer", HTMLElement, form);
  const said = element(".said", HTMLElement, form);
  let isAnswered = false;

  /**
   * The value that was chosen of a name; empty where none was.
   * @param {string} name
   */
  function chosen(name) {
    const found = form.querySelector(`input[name^="${name}-"]:checked`);
    return found instanceof HTMLInputElement ? found.value : "";
  }

  const isLineRight = () => drill.lines.includes(Number(chosen("line")));
  const isGroupRight = () => chosen("group") === drill.group;

  /**
   * Take no other choice; a wrong one is marked.
   * @param {HTMLElement} input
   */
  function close(input) {
    if (!(input instanceof HTMLInputElement)) return;
    input.disabled = true;
    const label = input.closest("label");
    if (input.checked && label && !label.classList.contains("at")) label.classList.add("wrong");
  }

  /** How right it was, in words. */
  function told() {
    if (isLineRight()) return isGroupRight() ? language.say("both_right") : language.say("line_right");
    return isGroupRight() ? language.say("fault_right") : language.say("both_wrong");
  }

  /** Say how right it was. */
  function write() {
    if (!isAnswered) return;
    said.textContent = told();
    said.className = `said ${isLineRight() && isGroupRight() ? "right" : "wrong"}`;
  }

  /** Take what was chosen, and show the answer. */
  function weigh() {
    isAnswered = true;
    form.classList.add("answered");
    for (const input of elements("input", form)) close(input);
    for (const fault of form.querySelectorAll("path.fault, .red")) fault.removeAttribute("hidden");
    element(".asks", HTMLElement, form).hidden = true;
    element(".goes", HTMLElement, form).hidden = false;
    answer.hidden = false;
    write();
    element("button", HTMLElement, form).focus();
  }

  form.addEventListener("submit", () => (isAnswered ? onDone() : weigh()));
  language.onChange(write);

  return {
    get line() { return chosen("line"); },
    get group() { return chosen("group"); },
    /** One for the line, one for what is wrong. */
    get points() { return isAnswered ? Number(isLineRight()) + Number(isGroupRight()) : 0; },
    /**
     * Show it, or hide it on the screen.
     * @param {boolean} isShown
     */
    show(isShown) {
      form.classList.toggle("aside-now", !isShown);
      if (!isShown) return;
      window.scrollTo(0, 0);
      element("h2", HTMLElement, form).focus();
    },
  };
}
