// Puts the lesson together: who answers, one task after the other, and the points at the end.
import { both, element, elements, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { readLesson } from "./data.js";
import { saveHandIn, sendHandIn } from "./hand_in.js";
import { short } from "./places.js";
import { newPlatform } from "./scorm.js";
import { newSitting } from "./sitting.js";
import { stepIn } from "./step.js";

/** @import { Sitting } from "./sitting.js" */

const lesson = readLesson();
const start = element("#start", HTMLElement);
const end = element("#end", HTMLElement);
const name = element("#name", HTMLInputElement);
const group = element("#class", HTMLInputElement);
const incomplete = element("#incomplete", HTMLElement);
const forms = elements("form.step");
const all = lesson.exercises.reduce((sum, exercise) => sum + exercise.points, 0);
/** @type {ReturnType<typeof stepIn>[]} */
let steps = [];
/** @type {Sitting | null} */
let sitting = null;
const platform = newPlatform();
let current = -1;
let since = 0;

/** Add the time since the last task to its exercise. */
function clock() {
  const now = performance.now();
  if (sitting && steps[current]) sitting.seconds[steps[current].exercise] += (now - since) / 1000;
  since = now;
}

/**
 * Show a task by its number; the points behind the last.
 * @param {number} at
 */
function show(at) {
  clock();
  current = at;
  start.hidden = true;
  steps.forEach((step, number) => step.show(number === at));
  end.hidden = at < steps.length;
  if (at < steps.length) return;
  write();
  platform?.score(rightOf() / all);
  element("h2", HTMLElement, end).focus();
}

/** Points of all exercises that were earned. */
function rightOf() {
  return lesson.exercises.reduce((sum, _, at) => sum + (sitting?.points(at) ?? 0), 0);
}

/** Write who answers, and at the end the points. */
function write() {
  if (!sitting) return;
  const { points } = sitting;
  element("#who", HTMLElement).textContent = `${sitting.name} · ${sitting.group}`;
  element(".score", HTMLElement, end).textContent = language.say("score", { right: short(rightOf()), all: short(all) });
  element(".marks tbody", HTMLElement, end).replaceChildren(...lesson.exercises.map((exercise, at) => make(
    "tr", {},
    make("th", { scope: "row" }, ...both(exercise.title)),
    make("td", {}, `${short(points(at))} / ${short(exercise.points)}`),
  )));
}

/**
 * Begin a sitting: its numbers go by who answers.
 * @param {string} who
 * @param {string} of the class
 */
function begin(who, of) {
  sitting = newSitting(lesson, who, of);
  const own = sitting;
  steps = forms.map((form, at) => stepIn(form, lesson.exercises[Number(form.dataset.exercise)], own, () => show(at + 1)));
  since = performance.now();
  write();
}

for (const form of elements("form")) form.addEventListener("submit", (event) => event.preventDefault());
for (const form of forms) form.classList.add("aside-now");
start.addEventListener("submit", () => {
  const [who, of] = [name.value.trim(), group.value.trim()];
  incomplete.hidden = Boolean(who && of);
  if (!who || !of) {
    (who ? group : name).focus();
    return;
  }
  begin(who, of);
  show(0);
});
element("#save", HTMLButtonElement).addEventListener("click", () => sitting && saveHandIn(sitting.handIn()));
const send = document.querySelector("#send");
if (send instanceof HTMLButtonElement) {
  const sent = element("#sent", HTMLElement);
  send.addEventListener("click", async () => {
    if (!sitting) return;
    send.disabled = true;
    const isThere = await sendHandIn(sitting.handIn());
    send.disabled = false;
    sent.className = `said ${isThere ? "right" : "wrong"}`;
    sent.replaceChildren(...both(language.said(isThere ? "sent" : "not_sent")));
  });
}
window.addEventListener("beforeunload", (event) => {
  if (sitting && current < steps.length) event.preventDefault();
});
window.addEventListener("beforeprint", () => {
  if (!sitting) begin("", "");
});
window.setInterval(() => {
  if (!sitting || current >= steps.length) return;
  const seconds = Math.floor(sitting.seconds.reduce((sum, each) => sum + each, (performance.now() - since) / 1000));
  element("#clock", HTMLElement).textContent = language.say("clock", {
    minutes: Math.floor(seconds / 60), seconds: String(seconds % 60).padStart(2, "0"),
  });
}, 1000);
name.value = platform?.name ?? "";
language.onChange(write);
language.begin();
