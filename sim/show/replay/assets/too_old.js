// A browser too old for the replay is told so, and lists the program all the same. It reads the words of 2009 alone.
(function () {
  if ("DecompressionStream" in window && "replaceChildren" in Element.prototype) return;
  if (/^zh/i.test((window.navigator.languages || [window.navigator.language])[0])) document.documentElement.lang = "zh-CN";
  /** @param {string} id */
  function found(id) {
    return /** @type {HTMLElement} */ (document.getElementById(id));
  }
  var program = found("program");
  program.style.whiteSpace = "pre";
  program.textContent = JSON.parse(found("document").textContent || "").program.lines.join("\n");
  found("loading").style.display = "none";
  found("too-old").style.display = "block";
})();
