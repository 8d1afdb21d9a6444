// An earlier version beside the present one: its path under it, the lines that changed, and the figures of both.
import * as asked from "./asked.js";
import { VERDICTS } from "./data.js";
import { diffOf } from "./found.js";
import { rowsOf } from "./size.js";
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Answer, Changes, FileText, Finding, Path } from "./data.js" */

/** @typedef {"opened" | "saved" | "ran" | "before"} Kind */

/**
 * A text as it stood, and what the check said of it once that was asked for.
 * @typedef {object} Version
 * @property {FileText} file
 * @property {string} text
 * @property {Answer | null} answer
 */

const MOST_CODES = 6;
/** @type {[kind: Kind, words: string][]} */
const KINDS = [
  ["opened", "version-opened"], ["saved", "version-saved"], ["ran", "version-ran"], ["before", "version-before"],
];

/**
 * Codes of findings, the first of many.
 * @param {Finding[]} findings
 */
function codesOf(findings) {
  const codes = findings.slice(0, MOST_CODES).map(({ code }) => code).join(" ");
  return findings.length > MOST_CODES ? `${codes} … (${findings.length})` : codes || "–";
}

/**
 * What of an answer is compared: names and values.
 * @param {Answer} answer
 * @returns {[name: string, value: string][]}
 */
function figuresOf({ verdict, findings, size, figures }) {
  return [
    [language.say("verdict"), language.say(VERDICTS[verdict])],
    [language.say("findings"), codesOf(findings)],
    [language.say("figures"), String(figures.length)],
    ...(size ? rowsOf(size) : []),
  ];
}

/**
 * Let an earlier version be compared.
 * @param {object} page
 * @param {() => Version} page.now the present version; its answer is null until it is checked
 * @param {(path: Path | null) => void} page.under shows a path under the present one
 * @param {(version: Version) => void} page.go makes a version the present one
 * @param {(line: number) => void} page.goToLine
 * @param {() => { machine: string, thickness_mm: string }} page.values of the form, by which both are checked
 * @param {(key: string) => void} page.tell says what went wrong
 */
export function wireVersions({ now, under, go, goToLine, values, tell }) {
  const select = element("#version", HTMLSelectElement);
  const table = element("#both", HTMLElement);
  const list = element("#changes", HTMLElement);
  const swap = element("#swap", HTMLButtonElement);
  const choice = element("#beside-open", HTMLButtonElement);
  /** @type {Map<Kind, Version>} */
  const kept = new Map();
  /** @type {Version | null} */
  let chosen = null;
  /** @type {Changes | null} */
  let changes = null;

  /** Offer the versions that there are. */
  function offer() {
    const offered = KINDS.filter(([kind]) => kept.has(kind));
    const { value } = select;
    const options = offered.map(([kind, words]) => {
      return make("option", { value: kind }, language.say(words, { name: nameOf(kind) }));
    });
    select.replaceChildren(make("option", { value: "" }, language.say("version-none")), ...options);
    select.value = value;
    choice.textContent = language.say("compare-with", { name: nameOf("before") });
  }

  /** @param {Kind} kind */
  const nameOf = (kind) => kept.get(kind)?.file.name || language.say("untitled");

  /** Show both versions beside each other. */
  function show() {
    const present = now();
    element("#versions", HTMLElement).hidden = element("#legend", HTMLElement).hidden = !chosen;
    if (!chosen?.answer || !present.answer) return;
    const [before, after] = [figuresOf(chosen.answer), figuresOf(present.answer)];
    const names = [...new Set([...before, ...after].map(([name]) => name))];
    const [was, is] = [new Map(before), new Map(after)];
    table.replaceChildren(...names.map((name) => {
      const [one, other] = [was.get(name) ?? "–", is.get(name) ?? "–"];
      return make(
        "tr", { className: one === other ? "" : "other" },
        make("th", { scope: "row" }, name), make("td", {}, one), make("td", {}, other),
      );
    }));
    list.replaceChildren(...(changes ? placesOf(changes) : []));
  }

  /** @param {Changes} found */
  function placesOf({ places, more }) {
    const shown = places.map(({ line, before, after, lines: [was, is] }) => {
      const button = make("button", { type: "button", className: "go" }, language.say("changed-at", { line, was, is }));
      button.addEventListener("click", () => goToLine(line));
      return make("li", {}, button, diffOf(before, after));
    });
    if (more) shown.push(make("li", {}, language.say("more-places", { n: more })));
    return shown.length ? shown : [make("li", { className: "good" }, language.say("no-change"))];
  }

  /** Compare the chosen version with the text as it stands. */
  async function update() {
    const version = chosen;
    try {
      if (version) {
        const { name, number } = version.file;
        version.answer ??= await asked.version({ name, number, text: version.text, ...values() });
        const found = await asked.lines(version.text, now().text);
        if (version !== chosen || !found) return;
        changes = found;
      }
      under(version?.answer?.path ?? null);
      show();
    } catch {
      tell("no-server");
    }
  }

  /** Take the version that is chosen. */
  function choose() {
    chosen = kept.get(/** @type {Kind} */ (select.value)) ?? null;
    return update();
  }

  select.addEventListener("change", () => {
    choice.hidden = true;
    choose();
  });
  choice.addEventListener("click", () => {
    select.value = "before";
    choice.hidden = true;
    choose();
    element("#tab-versions", HTMLElement).click();
  });
  swap.addEventListener("click", () => {
    if (!chosen) return;
    const next = chosen;
    keep("before");
    select.value = "before";
    choose();
    go(next);
  });
  language.onChange(() => {
    offer();
    show();
  });

  /**
   * Keep the present version as one of a kind.
   * @param {Kind} kind
   */
  function keep(kind) {
    kept.set(kind, { ...now(), answer: null });
    offer();
    if (select.value === kind) choose();
    else if (kind === "before") choice.hidden = false;
  }

  return {
    keep,
    update,
    /** Both are checked otherwise from now on. */
    recheck() {
      for (const version of kept.values()) version.answer = null;
    },
  };
}
