// What the page asks of its server: paths beside its own address, and nothing else.

/** @import { Answer, FileText, RunState } from "./data.js" */

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
 * The bytes of a text as its file has them.
 * @param {FileText} file
 */
export async function saved(file) {
  return (await ask("save", JSON.stringify(file))).blob();
}

/**
 * What is found in a text; null where a later one was asked for meanwhile.
 * @param {string} name
 * @param {string} text
 * @param {boolean} isFirst whether it is of the file that was open at the start: settings near that count
 * @param {AbortSignal} signal
 * @returns {Promise<Answer | null>}
 */
export async function check(name, text, isFirst, signal) {
  const answer = await ask("check", JSON.stringify({ name, text, is_first: isFirst ? "yes" : "no" }), signal);
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
