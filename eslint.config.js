// What the linter asks of the scripts of pages; types are checked by tsc (tsconfig.json). Pages run in Chrome 86 of
// 2020, which knows the language of 2021; tests/pages/test_old_browser.py opens them there.
import js from "@eslint/js";

// The globals of a browser that the scripts use: any other one, as `name` or `event`, is a mistake.
const BROWSER = [
  "Blob", "DecompressionStream", "Element", "HTMLAnchorElement", "HTMLCanvasElement", "HTMLDetailsElement",
  "HTMLButtonElement", "HTMLDialogElement", "HTMLElement", "HTMLInputElement", "HTMLProgressElement", "HTMLSelectElement", "HTMLTextAreaElement", "ResizeObserver", "Response", "URL", "atob",
  "document", "getComputedStyle", "performance", "requestAnimationFrame", "window",
];

export default [
  { ignores: ["*", "!sim", "!eslint.config.js"] },
  js.configs.recommended,
  {
    languageOptions: {
      ecmaVersion: 2021,
      sourceType: "module",
      globals: Object.fromEntries(BROWSER.map((name) => [name, "readonly"])),
    },
    rules: {
      "complexity": ["error", 10],
      "eqeqeq": "error",
      "max-lines": ["error", { max: 250, skipComments: true }],
      "no-shadow": "error",
      "no-unused-expressions": "error",
      "no-use-before-define": ["error", { functions: false, variables: false }],
      "no-var": "error",
      "object-shorthand": "error",
      "prefer-const": "error",
      "prefer-template": "error",
    },
  },
  {
    files: ["**/too_old.js", "**/too_old_for_tables.js"],
    languageOptions: { ecmaVersion: 5, sourceType: "script" },
    rules: { "no-var": "off" },
  },
];
