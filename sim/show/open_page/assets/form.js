// The form of the run: its values, which of them cannot be, and the offset that wire and gap give.
import { elements, element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { mm } from "./size.js";

/** @import { MachineFile } from "./data.js" */

const LATER_MS = 150;
/** What a technology tells, so that no field may. */
const OF_TECHNOLOGY = ["gap_mm", "lag_um"];
/** @type {Record<string, string>} */
const SIDES = { left: "side-left", right: "side-right" };

/** @param {HTMLElement} field */
const isField = (field) => field instanceof HTMLInputElement || field instanceof HTMLSelectElement;

/**
 * The number that is meant: full-width digits and a comma are read as people of the trade write them.
 * @param {string} text
 */
const numberIn = (text) => (text ? Number(text.normalize("NFKC").replace(",", ".")) : NaN);

/**
 * The form of the page.
 * @param {(isRead: boolean) => void} onChange hears of each change; of one that the check looks at a moment later
 */
export function wireForm(onChange) {
  const form = element("#run", HTMLElement);
  const wrong = element("#wrong", HTMLElement);
  const side = element("[name=side]", HTMLSelectElement, form);
  const fields = elements("input, select", form).filter(isField);
  const technology = element("[name=technology]", HTMLSelectElement, form);
  const numbers = fields.filter((field) => field instanceof HTMLInputElement);
  let waiting = 0;

  /**
   * What is wrong with a field's text; empty where nothing is.
   * @param {HTMLInputElement} field
   */
  function faultOf({ value, dataset }) {
    const [low, high] = [Number(dataset.low), Number(dataset.high)];
    const words = dataset.many === undefined ? [value.trim()] : value.normalize("NFKC").trim().split(/[\s,]+/);
    const isFine = words.every((word) => !word || (dataset.many !== undefined && word === "0") || (numberIn(word) >= low && numberIn(word) <= high));
    return isFine ? "" : language.say("field-bounds", { found: value.trim(), low, high });
  }

  /** Mark the fields that cannot be; whether all can. */
  function isRight() {
    const faults = numbers.map((field) => {
      const fault = field.disabled ? "" : faultOf(field);
      field.setAttribute("aria-invalid", String(Boolean(fault)));
      return fault;
    });
    const first = faults.findIndex(Boolean);
    const named = first < 0 ? "" : `${numbers[first].labels?.[0].innerText.trim() ?? ""}: ${faults[first]}`;
    const fault = named || (wire().reachUm > 0 ? "" : language.say("no-kerf"));
    wrong.hidden = !fault;
    wrong.textContent = fault;
    return !fault;
  }

  /**
   * A length of the form, µm: what is usual where it says none that can be.
   * @param {string} name
   */
  function um(name) {
    const field = element(`[name=${name}]`, HTMLInputElement, form);
    const value = field.disabled || faultOf(field) ? NaN : numberIn(field.value.trim());
    return 1000 * (Number.isNaN(value) ? Number(field.placeholder) : value);
  }

  /** The wire's diameter, and half the width that it cuts: f = d/2 + gap. */
  function wire() {
    return { wireUm: um("wire_mm"), gapUm: um("gap_mm"), reachUm: Math.max(0, um("wire_mm") / 2 + um("gap_mm")) };
  }

  /** Work out what the values give. */
  function show() {
    for (const field of numbers) field.disabled = Boolean(technology.value) && OF_TECHNOLOGY.includes(field.name);
    const { wireUm, gapUm, reachUm } = wire();
    element("#reach", HTMLElement).textContent = technology.value ? language.say("reach-by-technology", { reach: mm(reachUm) }) : `${mm(wireUm)} / 2 ${gapUm < 0 ? "−" : "+"} ${mm(Math.abs(gapUm))} = ${mm(reachUm)} mm`;
    for (const option of side.options) option.textContent = `${language.say(SIDES[option.value])} (${option.dataset.iso})`;
    isRight();
  }

  /**
   * Offer files in a list, and choose the first of them.
   * @param {string} selector
   * @param {MachineFile[]} files
   */
  function offer(selector, files) {
    const list = element(selector, HTMLSelectElement, form);
    for (const { name, title: { en, zh } } of files) {
      const option = make("option", { value: name });
      Object.assign(option.dataset, { textEn: en, textZh: zh });
      list.append(option);
    }
    language.nameControls();
    list.value = files[0].name;
    list.dispatchEvent(new window.Event("input", { bubbles: true }));
  }

  form.addEventListener("input", () => {
    show();
    onChange(false);
    window.clearTimeout(waiting);
    waiting = window.setTimeout(() => onChange(true), LATER_MS);
  });
  language.onChange(show);

  return {
    isRight,
    wire,
    /**
     * Offer a machine whose file came to the page, and choose it.
     * @param {MachineFile} file
     */
    addMachine(file) {
      offer("[name=machine]", [file]);
    },
    /**
     * Offer a technology whose file came to the page, once for each material, and choose the first.
     * @param {MachineFile[]} files
     */
    addTechnologies(files) {
      offer("[name=technology]", files);
    },
    /**
     * The values by their names, as texts.
     * @returns {Record<string, string>}
     */
    values() {
      return Object.fromEntries(fields.map((field) => {
        if (field instanceof HTMLSelectElement) return [field.name, field.value];
        if (!(field instanceof HTMLInputElement)) return ["", ""];
        if (field.disabled) return [field.name, ""];
        const text = field.value.trim();
        return [field.name, field.dataset.many === undefined && text ? text.normalize("NFKC").replace(",", ".") : text];
      }));
    },
  };
}
