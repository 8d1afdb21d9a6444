// Puts the page together: a file comes in, its text is checked while it is edited, and what is found shows at once.
import * as asked from "./asked.js";
import { wireDrawing } from "./drawing.js";
import { wireFiles } from "./files.js";
import { wireForm } from "./form.js";
import { wireGripping } from "./gripping.js";
import { editsOfAll, showFound } from "./found.js";
import { wireListing } from "./listing.js";
import { pictureOf } from "./picture.js";
import { wireRun } from "./running.js";
import { showSize } from "./size.js";
import { wireStatus, worse } from "./status.js";
import { textOf } from "./text.js";
import { wireVersions } from "./versions.js";
import { wireWatching } from "./watching.js";
import { wireTabs } from "../../replay/assets/controls.js";
import { element, elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Answer, FileText, Finding } from "./data.js" */

const PAUSE_MS = 15; // between two keys of who types fast lies more; a check that is out of date is dropped

const list = element("#found", HTMLElement);
const title = element("#name", HTMLElement);
const problem = element("#status", HTMLElement);
const mendAll = element("#mend-all", HTMLButtonElement);
const status = wireStatus();
const form = wireForm((isRead) => (isRead ? recheck() : showForm()));
const picture = pictureOf(element("#picture", HTMLCanvasElement), {
  block: goToBlock,
  hover: (place, row, nearUm) => { watching.hover(place, row); gripping.hover(place, nearUm); },
  place: (place, nearUm) => gripping.click(place, nearUm) || drawing.pick(place, nearUm),
  mark: (place, nearUm) => drawing.mark(place, nearUm) ?? gripping.mark(place, nearUm),
});
const gripping = wireGripping(picture);
const text = textOf(element("#text", HTMLTextAreaElement), element("#lines", HTMLElement), (line) => {
  picture.markLine(line);
  caret = line;
  run.show();
  watching.toLine(line);
});
const watching = wireWatching({ picture, status, path: pathNow, findings: allFound, wire: form.wire, run: text.run, tell });
const versions = wireVersions({
  now: () => ({ file, text: text.value, answer: known?.text === text.value ? known.answer : null }),
  under: picture.under,
  go: (version) => begin({ ...version.file, text: version.text }, false),
  goToLine: text.showLine,
  values: ofForm,
  tell,
});
const run = wireRun({
  current: () => ({ name: nameOf(), text: text.value, number: file.number, drawing: drawing.number(), block: blockAtCaret() }),
  values: form.values,
  isRight: form.isRight,
  onStart: () => versions.keep("ran"),
  onDrafted: () => drawing.done(),
  onRun,
  tell,
});
const drawing = wireDrawing({
  current: () => ({ name: nameOf(), text: text.value }),
  values: form.values,
  follow: run.follow,
  begin: (read) => begin(read),
  beneath: (curves) => {
    picture.beneath(curves);
    show();
  },
  picked: picture.pick,
  planned: picture.plan,
  figureAt: picture.figureAt,
  tell,
});
const files = wireFiles({
  begin,
  draw(number, name) {
    const taken = drawing.take(number, name);
    show();
    return taken;
  },
  list: (dropped) => listing.take(dropped),
  machine({ machine, technologies, why }) {
    if (machine) form.addMachine(machine);
    else if (technologies) form.addTechnologies(technologies);
    else if (why) tell("machine-refused", { why: language.pick(why) });
  },
  unlist: () => listing.hide(),
  current: () => ({ file, text: text.value, name: nameOf() }),
  onSaved: () => versions.keep("saved"),
  tell,
});
const listing = wireListing(files.open);

/** @type {FileText} */
let file = { name: "", text: "", encoding: "utf-8", newline: "\n", number: "" };
/** @type {{ answer: Answer, text: string } | null} */
let known = null;
let waiting = 0;
let caret = 0;
let asking = new window.AbortController();

/**
 * Say something of the page itself.
 * @param {string} key
 * @param {Record<string, string | number>} values
 */
function tell(key, values = {}) {
  problem.textContent = key && language.say(key, values);
}

/** What of the form the check looks at. */
function ofForm() {
  const { machine, thickness_mm: thickness } = form.values();
  return { machine, thickness_mm: thickness };
}

/** The path of the text as it stands; null where it is not known. */
function pathNow() {
  return known?.text === text.value ? known.answer.path : null;
}

/**
 * Select what a finding speaks of.
 * @param {Finding} finding
 */
function go(finding) {
  if (finding.past > finding.first && known?.text === text.value) text.select(finding.first, finding.past);
  else if (finding.line) text.showLine(finding.line);
}

/**
 * Make certain mends, of the text that they were found in alone.
 * @param {Finding["edits"]} edits
 */
function mend(edits) {
  if (known?.text !== text.value) return;
  text.edit(edits);
  later();
}

/**
 * Select the block in a row of the path.
 * @param {number} row
 */
function goToBlock(row) {
  const path = known?.answer.path;
  if (!path) return;
  if (known?.text === text.value) text.select(path.first[row], path.past[row]);
  else text.showLine(path.line[row]);
}

/** Findings of the check and, where the text is as it was run, those of the run, in the order of their lines. */
function allFound() {
  const ofCheck = known?.answer.findings ?? [];
  return [...ofCheck, ...(run.result()?.findings ?? [])].sort((a, b) => a.line - b.line);
}

/** Show what is known, in the language of the page. */
function show() {
  files.offer(!text.value && !drawing.number());
  const found = allFound();
  const { mended } = editsOfAll(found);
  mendAll.hidden = mended < 2;
  mendAll.textContent = language.say("mend-all", { n: mended });
  element("#found-count", HTMLElement).textContent = found.length ? `(${found.length})` : "";
  text.mark(found);
  if (known) {
    const pages = { ...known.answer.pages, ...run.result()?.pages };
    showFound(list, found, known.text, { go, mend: ({ edits }) => mend(edits), pages });
    showSize(element("#size", HTMLElement), element("#figures", HTMLElement), known.answer);
    const ran = run.result()?.verdict ?? "pass";
    status.judge(known.answer, worse(known.answer.verdict, worse(ran, drawing.verdictOf(known.text))));
  } else {
    list.replaceChildren();
    element("#sizes", HTMLElement).hidden = true;
    status.judge(null, null);
  }
}

/** Show what the form gives. */
function showForm() {
  const { reachUm } = form.wire();
  picture.cutBy(reachUm);
  status.cutBy(reachUm);
  run.show();
}

/** The form says something else. */
function recheck() {
  versions.recheck();
  if (text.value) check(false);
}

/**
 * A run has ended well, or there is none any more of the text as it stands.
 * @param {number | null} number
 */
function onRun(number) {
  show();
  picture.mark(allFound());
  watching.take(number);
  if (number !== null) element(run.result()?.findings.length ? "#tab-findings" : "#tab-files", HTMLElement).click();
}

/**
 * Show what the check said of a text; null of none, with which nothing is wrong.
 * @param {Answer | null} answer
 * @param {string} now
 * @param {boolean} isNew whether it is another program
 */
function learn(answer, now, isNew) {
  known = answer && { answer, text: now };
  run.show();
  show();
  picture.show(answer && answer.path, answer ? answer.figures : [], isNew);
  picture.mark(allFound());
  versions.update();
  if (isNew || !answer) watching.play(true);
  else watching.later();
  if (file.why && !now) tell("not-opened", { why: language.pick(file.why) });
  else if (answer && answer.settings) tell("settings", { why: answer.settings });
  else tell("");
}

/**
 * Check the text as it stands.
 * @param {boolean} isNew whether it is another program
 */
async function check(isNew) {
  asking.abort();
  asking = new window.AbortController();
  const now = text.value;
  if (!now) {
    learn(null, now, isNew);
    return;
  }
  try {
    const answer = await asked.check({ name: file.name, text: now, number: file.number, ...ofForm() }, asking.signal);
    if (answer) learn(answer, now, isNew);
  } catch (error) {
    if (!(error instanceof Error && error.name === "AbortError")) tell("no-server");
  }
}

/** Check once nobody types any more. */
function later() {
  window.clearTimeout(waiting);
  waiting = window.setTimeout(() => check(false), PAUSE_MS);
}

/**
 * Another program; the one before it can be compared.
 * @param {FileText} read
 * @param {boolean} isOpened whether it comes from a file; else it is a version
 */
function begin(read, isOpened = true) {
  if (read.text === null) {
    tell("no-text", { name: read.name });
    return;
  }
  if (text.value && isOpened) versions.keep("before");
  file = read;
  title.textContent = read.name || language.say("untitled");
  document.title = `${read.name || language.say("untitled")} · drycut`;
  text.begin(read.text);
  if (isOpened) versions.keep("opened");
  check(true);
  drawing.look();
}

/** Name of the first block in the line of the caret; empty where none is known. */
function blockAtCaret() {
  const path = pathNow();
  return path?.name[path.line.indexOf(caret)] ?? "";
}

/** Of its file; one that has none yet is named for the language it is written in. */
function nameOf() {
  return file.name || (known?.answer.name ?? "program");
}

/**
 * Open what drycut was started with; who typed meanwhile, where that is nothing, has begun a program.
 * @param {FileText} read
 */
function start(read) {
  files.recent(read.recent ?? []);
  const isOther = read.drawing || read.machine || read.technologies;
  if (!isOther && (read.text !== "" || !text.value)) begin(read);
  else title.textContent = language.say("untitled");
  if (isOther) files.take(read);
}

language.onChange(show);
language.begin();
wireTabs(elements('[role="tab"]'));
element("#fit", HTMLElement).addEventListener("click", picture.fit);
element("#text", HTMLTextAreaElement).addEventListener("input", later);
mendAll.addEventListener("click", () => mend(editsOfAll(allFound()).edits));
showForm();
asked.first().then(start).then(listing.look).catch(() => tell("no-server"));
