// Puts the page together: one task after the other, and the score at the end.
import { element, elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { readDrills } from "./data.js";
import { saveScore } from "./score.js";
import { taskIn } from "./task.js";

const data = readDrills();
const start = element("#start", HTMLElement);
const end = element("#end", HTMLElement);
const places = element("details.places", HTMLElement);
const save = element("#save", HTMLButtonElement);
const who = element("#who", HTMLInputElement);
const tasks = data.drills.map((drill, at) =>
  taskIn(element(`[data-drill="${at}"]`, HTMLElement), drill, () => show(at + 1)));

/**
 * Show a task by its index; the score behind the last.
 * @param {number} at
 */
function show(at) {
  start.hidden = true;
  tasks.forEach((task, index) => task.show(index === at));
  end.hidden = at < tasks.length;
  places.hidden = at >= tasks.length;
  if (at < tasks.length) return;
  write();
  element("h2", HTMLElement, end).focus();
}

/** Write the score, in the language of the page. */
function write() {
  const right = tasks.map((task) => task.points).reduce((sum, points) => sum + points, 0);
  element(".score", HTMLElement, end).textContent = language.say("score", { right, all: 2 * tasks.length });
}

for (const task of tasks) task.show(false);
for (const form of elements("form")) form.addEventListener("submit", (event) => event.preventDefault());
places.hidden = true;
start.addEventListener("submit", () => show(0));
save.addEventListener("click", () => saveScore(data, tasks, who.value.trim()));
window.addEventListener("beforeprint", () => {
  places.hidden = false;
  places.setAttribute("open", "");
});
language.onChange(write);
language.begin();
