// What the page asks of its server: paths beside its own address, and nothing else.

/**
 * A text to be checked: its name, the number of its program, near whose file settings count, empty where it came to the
 * page, and the machine and the thickness that the form says.
 * @typedef {{ name: string, text: string, number: string, machine: string, thickness_mm: string }} Checked
 */
/** @import { Answer, Changes, Drafted, FileText, Looked, Planned, Row, Rows, RunState } from "./data.js" */

/**
 * The answer to a request.
 * @param {string} name
 * @param {BodyInit} body
 * @param {AbortSignal | null} signal
 */
async function ask(name, body, signal = null) {
  const answer = await window.fetch(name, { method: "POST", body, signal, redirect: "error" });
  if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
  return answer;
}

/**
 * The program that is open at the start.
 * @returns {Promise<FileText>}
 */
export async function first() {
  return (await ask("first", "")).json();
}

/**
 * The text of a file.
 * @param {string} name
 * @param {Blob} file
 * @returns {Promise<FileText>}
 */
export async function read(name, file) {
  return (await ask(`read?name=${encodeURIComponent(name)}`, file)).json();
}

/**
 * The program of a number.
 * @param {string} number
 * @returns {Promise<FileText>}
 */
export async function program(number) {
  return (await ask("program", JSON.stringify({ number }))).json();
}

/**
 * A file to begin with.
 * @param {string} name
 * @returns {Promise<FileText>}
 */
export async function example(name) {
  return (await ask("example", JSON.stringify({ example: name }))).json();
}

/**
 * A page of a run, as its text.
 * @param {number} number
 * @param {string} name
 */
export async function pageOfRun(number, name) {
  const answer = await window.fetch(`run/${number}/${name}`, { redirect: "error" });
  if (!answer.ok) throw new Error(`${name}: ${answer.status}`);
  return answer.text();
}

/**
 * The rows of the folder's programs behind those that are known.
 * @param {number} known
 * @param {number} list that they are of
 * @returns {Promise<Rows>}
 */
export async function rows(known, list) {
  return (await ask("rows", JSON.stringify({ known: String(known), list: String(list) }))).json();
}

/**
 * Look through the folder again.
 * @returns {Promise<Rows>}
 */
export async function again() {
  return (await ask("again", "")).json();
}

/**
 * What a list shows of a file.
 * @param {string} name
 * @param {Blob} file
 * @returns {Promise<Row>}
 */
export async function row(name, file) {
  return (await ask(`row?name=${encodeURIComponent(name)}`, file)).json();
}

/**
 * The bytes of a text as its file would have them.
 * @param {FileText} file as it was opened
 * @param {string} text
 */
export async function saved(file, text) {
  const { text: opened, encoding, newline } = file;
  return (await ask("save", JSON.stringify({ text, opened, encoding, newline }))).blob();
}

/**
 * What is found in a text; null where a later one was asked for meanwhile.
 * @param {Checked} asked
 * @param {AbortSignal} signal
 * @returns {Promise<Answer | null>}
 */
export async function check(asked, signal) {
  const answer = await ask("check", JSON.stringify(asked), signal);
  return answer.status === 204 ? null : answer.json();
}

/**
 * What is found in a text that stays as it is.
 * @param {Checked} asked
 * @returns {Promise<Answer>}
 */
export async function version(asked) {
  return (await ask("version", JSON.stringify(asked))).json();
}

/**
 * Which lines are others; null where a later text was asked for meanwhile.
 * @param {string} before
 * @param {string} after
 * @returns {Promise<Changes | null>}
 */
export async function lines(before, after) {
  const answer = await ask("lines", JSON.stringify({ before, after }));
  return answer.status === 204 ? null : answer.json();
}

/**
 * Run a text; how far it is then.
 * @param {Record<string, string>} asked
 * @returns {Promise<RunState>}
 */
export async function run(asked) {
  return (await ask("run", JSON.stringify(asked))).json();
}

/**
 * Make a film or pictures of the run; how far it is then.
 * @param {Record<string, string>} wanted
 * @returns {Promise<RunState>}
 */
export async function more(wanted) {
  return (await ask("more", JSON.stringify(wanted))).json();
}

/**
 * How far the run is.
 * @returns {Promise<RunState>}
 */
export async function progress() {
  return (await ask("progress", "")).json();
}

/**
 * End the run.
 * @returns {Promise<RunState>}
 */
export async function cancel() {
  return (await ask("cancel", "")).json();
}

/** Say that the page is still open. */
export async function alive() {
  await ask("alive", "");
}

/** End the server. */
export async function close() {
  await ask("close", "");
}

/**
 * A drawing, as it lies beneath a program.
 * @param {Record<string, string>} told
 * @returns {Promise<Looked>}
 */
export async function look(told) {
  return (await ask("look", JSON.stringify(told))).json();
}

/**
 * What would be cut of a drawing.
 * @param {Record<string, string>} told
 * @returns {Promise<Planned>}
 */
export async function plan(told) {
  return (await ask("plan", JSON.stringify(told))).json();
}

/**
 * Make a program of a drawing.
 * @param {Record<string, string>} told
 * @returns {Promise<RunState>}
 */
export async function draft(told) {
  return (await ask("draft", JSON.stringify(told))).json();
}

/**
 * The program that was made of a drawing.
 * @param {string} drawing its number
 * @returns {Promise<Drafted>}
 */
export async function drafted(drawing) {
  return (await ask("drafted", JSON.stringify({ drawing }))).json();
}
