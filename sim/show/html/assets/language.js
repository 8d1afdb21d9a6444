// The language of the page: of the address (#lang=zh-CN), else as chosen before, else of the browser.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const KEY = "drycut.lang";
  const LANGUAGES = ["en", "zh-CN"];
  const page = document.documentElement;
  const listeners = [];
  let texts = null; // what scripts say, key to {en, zh}, from the element "words"

  /** One of LANGUAGES for a language tag, or null. */
  function known(tag) {
    if (!tag) return null;
    return /^zh/i.test(tag) ? "zh-CN" : /^en/i.test(tag) ? "en" : null;
  }

  /** What was chosen before; browsers may forbid pages of files to keep anything. */
  function kept() {
    try {
      return known(root.localStorage.getItem(KEY));
    } catch {
      return null;
    }
  }

  /** Keep a choice for the next page. */
  function keep(language) {
    try {
      root.localStorage.setItem(KEY, language);
    } catch {
      // The choice lasts as long as the page does.
    }
  }

  /** Language that the address asks for. */
  function asked() {
    const found = /[#&]lang=([\w-]+)/.exec(root.location.hash);
    return found && known(found[1]);
  }

  /** First language of the browser that the page has. */
  function ofBrowser() {
    for (const tag of root.navigator.languages || [root.navigator.language]) {
      const language = known(tag);
      if (language) return language;
    }
    return LANGUAGES[0];
  }

  /** Name the controls in the language of the page. */
  function nameControls() {
    const key = Drycut.language.isChinese() ? "labelZh" : "labelEn";
    for (const control of document.querySelectorAll("[data-label-en]")) {
      control.setAttribute("aria-label", control.dataset[key]);
      control.title = control.dataset[key];
    }
  }

  /** Show the page in a language. */
  function show(language) {
    page.lang = language;
    nameControls();
    for (const listener of listeners) listener(language);
  }

  /** The text of a key in both languages, {en, zh}, with values in its places. */
  function said(key, values = {}) {
    texts ??= JSON.parse(document.getElementById("words").textContent);
    const filled = (text) => text.replace(/\{(\w+)\}/g, (_, name) => values[name]);
    return { en: filled(texts[key].en), zh: filled(texts[key].zh) };
  }

  /** The text of the page's language of {en, zh}. */
  const pick = (text) => (page.lang === "zh-CN" ? text.zh : text.en);

  Drycut.language = {
    current: () => page.lang,
    isChinese: () => page.lang === "zh-CN",
    /** Change the language and keep it. */
    set(language) {
      keep(language);
      show(language);
    },
    /** Call a function after each change. */
    onChange: (listener) => listeners.push(listener),
    pick,
    said,
    /** The text of a key in the page's language. */
    say: (key, values) => pick(said(key, values)),
  };

  for (const button of document.querySelectorAll("[data-language-switch]")) {
    button.addEventListener("click", () => Drycut.language.set(Drycut.language.isChinese() ? "en" : "zh-CN"));
  }
  root.addEventListener("hashchange", () => asked() && show(asked()));
  show(asked() || kept() || ofBrowser());
})(globalThis);
