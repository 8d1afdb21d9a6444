// A browser too old for the tables of a page is told so, in its language. It reads the words of 2009 alone.
(function () {
  if ("DecompressionStream" in window && "replaceChildren" in Element.prototype) return;
  if (/^zh/i.test((window.navigator.languages || [window.navigator.language])[0])) document.documentElement.lang = "zh-CN";
  /** @type {HTMLElement} */ (document.getElementById("too-old")).style.display = "block";
})();
