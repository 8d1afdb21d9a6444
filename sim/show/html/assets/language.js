// The language of the page: of the address (#lang=zh-CN), else as chosen before, else of the browser.
import { element, elements } from "./elements.js";

/** @typedef {"en" | "zh-CN"} Language */

/**
 * A text in both languages.
 * @typedef {object} Said
 * @property {string} en
 * @property {string} zh
 */

const KEY = "drycut.lang";
const page = document.documentElement;
/** @type {(() => void)[]} */
const listeners = [];
/** @type {Record<string, Said> | null} */
let texts = null;

/**
 * The language of a tag such as zh-Hans, if the page has it.
 * @param {string | null | undefined} tag
 * @returns {Language | null}
 */
function known(tag) {
  if (!tag) return null;
  return /^zh/i.test(tag) ? "zh-CN" : /^en/i.test(tag) ? "en" : null;
}

/** What was chosen before; browsers may forbid pages of files to keep anything. */
function kept() {
  try {
    return known(window.localStorage.getItem(KEY));
  } catch {
    return null;
  }
}

/**
 * Keep a choice for the next page.
 * @param {Language} language
 */
function keep(language) {
  try {
    window.localStorage.setItem(KEY, language);
  } catch {
    // The choice lasts as long as the page does.
  }
}

/** Language that the address asks for. */
function asked() {
  const found = /[#&]lang=([\w-]+)/.exec(window.location.hash);
  return found && known(found[1]);
}

/**
 * First language of the browser that the page has.
 * @returns {Language}
 */
function ofBrowser() {
  for (const tag of window.navigator.languages || [window.navigator.language]) {
    const language = known(tag);
    if (language) return language;
  }
  return "en";
}

/** Name the controls in the language of the page: all of them, or those that were added. */
export function nameControls() {
  const key = isChinese() ? "labelZh" : "labelEn";
  for (const control of elements("[data-label-en]")) {
    const name = control.dataset[key] ?? "";
    control.setAttribute("aria-label", name);
    control.title = name;
  }
  for (const option of elements("[data-text-en]")) option.textContent = option.dataset[isChinese() ? "textZh" : "textEn"] ?? "";
}

/**
 * Show the page in a language.
 * @param {Language} language
 */
function show(language) {
  page.lang = language;
  nameControls();
  for (const listener of listeners) listener();
}

/** The language that the page is in. */
export function current() {
  return page.lang;
}

/** Whether that is Chinese. */
export function isChinese() {
  return page.lang === "zh-CN";
}

/** Change to the other language and keep it. */
export function change() {
  const other = isChinese() ? "en" : "zh-CN";
  keep(other);
  show(other);
}

/**
 * Call a function after each change.
 * @param {() => void} listener
 */
export function onChange(listener) {
  listeners.push(listener);
}

/**
 * The text of the page's language.
 * @template T
 * @param {{ en: T, zh: T }} text
 */
export function pick(text) {
  return isChinese() ? text.zh : text.en;
}

/**
 * The text of a key in both languages, with values in its places: one of those that the page hands over to its scripts.
 * @param {string} key
 * @param {Record<string, string | number>} values
 * @returns {Said}
 */
export function said(key, values = {}) {
  texts ??= /** @type {Record<string, Said>} */ (JSON.parse(element("#words", HTMLElement).textContent));
  /** @param {string} text */
  const filled = (text) => text.replace(/\{(\w+)\}/g, (_, name) => String(values[name]));
  return { en: filled(texts[key].en), zh: filled(texts[key].zh) };
}

/**
 * The text of a key in the page's language.
 * @param {string} key
 * @param {Record<string, string | number>} values
 */
export function say(key, values = {}) {
  return pick(said(key, values));
}

/** Show the page in its language, and let the button and the address change it. */
export function begin() {
  for (const button of elements("[data-language-switch]")) button.addEventListener("click", change);
  window.addEventListener("hashchange", () => {
    const language = asked();
    if (language) show(language);
  });
  show(asked() || kept() || ofBrowser());
}
