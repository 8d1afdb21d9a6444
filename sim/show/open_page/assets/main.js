// Puts the page together: a file comes in, its text is checked while it is edited, and what is found shows at once.
import * as asked from "./asked.js";
import { VERDICTS } from "./data.js";
import { showFound } from "./found.js";
import { wireDrawing } from "./drawing.js";
import { wireListing } from "./listing.js";
import { pictureOf } from "./picture.js";
import { wireRun } from "./running.js";
import { showSize } from "./size.js";
import { textOf } from "./text.js";
import { wireVersions } from "./versions.js";
import { element } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Answer, FileText, Finding } from "./data.js" */

const PAUSE_MS = 15; // between two keys of who types fast lies more; a check that is out of date is dropped
const ALIVE_MS = 20_000;

const list = element("#found", HTMLElement);
const counts = element("#counts", HTMLElement);
const title = element("#name", HTMLElement);
const status = element("#status", HTMLElement);
const picture = pictureOf(element("#picture", HTMLCanvasElement), goToBlock);
const text = textOf(element("#text", HTMLTextAreaElement), element("#lines", HTMLElement), (line) => {
  picture.markLine(line);
  caret = line;
  run.show();
});
const listing = wireListing(openOne);
const versions = wireVersions({
  now: () => ({ file, text: text.value, answer: known?.text === text.value ? known.answer : null }),
  under: picture.under,
  go: (version) => begin({ ...version.file, text: version.text }, false),
  goToLine: text.showLine,
  tell,
});
const run = wireRun(
  () => ({ name: nameOf(), text: text.value, number: file.number, drawing: drawing.number(), block: blockAtCaret() }),
  () => versions.keep("ran"), () => drawing.done(), tell,
);
const drawing = wireDrawing({
  current: () => ({ name: nameOf(), text: text.value }),
  values: run.values,
  follow: run.follow,
  begin: (read) => begin(read),
  beneath: picture.beneath,
  tell,
});
const pick = element("#pick", HTMLInputElement);

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
  status.textContent = key && language.say(key, values);
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
 * Make a certain mend, of the text that it was found in alone.
 * @param {Finding} finding
 */
function mend(finding) {
  if (known?.text !== text.value) return;
  text.edit(finding.edits);
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

/** Show what is known, in the language of the page. */
function show() {
  if (!known) return;
  const { answer } = known;
  showFound(list, answer.findings, known.text, { go, mend });
  showSize(element("#size", HTMLElement), element("#figures", HTMLElement), answer);
  const verdict = language.say(VERDICTS[answer.verdict]);
  counts.textContent = answer.dialect ? `${answer.dialect} · ${verdict}` : verdict;
  counts.className = answer.verdict;
}

/**
 * Check the text as it stands.
 * @param {boolean} isNew whether it is another program
 */
async function check(isNew) {
  asking.abort();
  asking = new window.AbortController();
  const now = text.value;
  try {
    const answer = await asked.check(file.name, now, file.number, asking.signal);
    if (!answer) return;
    known = { answer, text: now };
    text.mark(answer.findings);
    picture.show(answer.path, answer.figures, answer.findings, isNew);
    show();
    versions.update();
    run.show();
    if (file.why && !now) tell("not-opened", { why: language.pick(file.why) });
    else tell(answer.settings && "settings", { why: answer.settings });
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

/**
 * Open what was dropped or picked: one file, or the list of several.
 * @param {FileList | null | undefined} chosen
 */
async function take(chosen) {
  const files = [...(chosen ?? [])];
  if (files.length > 1) listing.take(files).catch(() => tell("no-server"));
  else if (files.length && await openOne(files[0])) listing.hide();
}

/**
 * Open a program by its number, or a file; whether it could be read.
 * @param {string | File} source
 */
async function openOne(source) {
  try {
    const read = typeof source === "string" ? await asked.program(source) : await asked.read(source.name, source);
    if (read.drawing) await drawing.take(read.drawing, read.name);
    else begin(read);
    return true;
  } catch {
    tell("not-read");
    return false;
  }
}

/** Name of the first block in the line of the caret; empty where none is known. */
function blockAtCaret() {
  const path = known?.text === text.value ? known.answer.path : null;
  return path?.name[path.line.indexOf(caret)] ?? "";
}

/** Of its file; one that has none yet is named for the language it is written in. */
function nameOf() {
  return file.name || (known?.answer.name ?? "program");
}

/** Save the text as its file was: encoding and line ends stay. */
async function save() {
  try {
    const blob = await asked.saved(file, text.value);
    const link = document.createElement("a");
    link.href = window.URL.createObjectURL(blob);
    link.download = nameOf();
    link.click();
    versions.keep("saved");
    window.setTimeout(() => window.URL.revokeObjectURL(link.href), ALIVE_MS);
  } catch {
    tell("no-server");
  }
}

/** Files come by dropping them anywhere, by the button, or as a text by pasting it. */
function wire() {
  window.addEventListener("dragover", (event) => event.preventDefault());
  window.addEventListener("drop", (event) => {
    event.preventDefault();
    take(event.dataTransfer?.files);
  });
  pick.addEventListener("change", () => {
    take(pick.files);
    pick.value = "";
  });
  element("#open", HTMLElement).addEventListener("click", () => pick.click());
  element("#save", HTMLElement).addEventListener("click", save);
  element("#fit", HTMLElement).addEventListener("click", picture.fit);
  element("#text", HTMLTextAreaElement).addEventListener("input", later);
  element("#close", HTMLElement).addEventListener("click", async () => {
    await asked.close();
    tell("closed");
  });
  window.setInterval(() => asked.alive().catch(() => tell("no-server")), ALIVE_MS);
}

language.onChange(show);
language.begin();
wire();

/**
 * Open what drycut was started with; who typed meanwhile, where that is nothing, has begun a program.
 * @param {FileText} read
 */
function start(read) {
  if (read.drawing) drawing.take(read.drawing, read.name);
  else if (read.text !== "" || !text.value) begin(read);
  else title.textContent = language.say("untitled");
}

asked.first().then(start).then(listing.look).catch(() => tell("no-server"));
