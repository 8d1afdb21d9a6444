// Puts the drills together: one after the other, and the score at the end.
import { cellOf, fileOf, save } from "../../html/assets/csv.js";
import { element, elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { readDrills } from "./data.js";
import { taskIn } from "./task.js";

const data = readDrills();
const start = element("#start", HTMLElement);
const end = element("#end", HTMLElement);
const who = element("#who", HTMLInputElement);
const tasks = data.drills.map((_, at) => taskIn(element(`[data-drill="${at}"]`, HTMLElement), data, at, () => show(at + 1)));

/** Points of all drills. */
const points = () => tasks.reduce((sum, { task }) => sum + task.what + task.done, 0);

/** Write the score. */
function write() {
  element(".score", HTMLElement, end).textContent = language.say("score", { right: points(), all: 2 * tasks.length });
}

/**
 * Show a drill by its index; the score behind the last.
 * @param {number} at
 */
function show(at) {
  start.hidden = true;
  tasks.forEach((task, index) => task.show(index === at));
  end.hidden = at < tasks.length;
  if (at < tasks.length) return;
  write();
  element("h2", HTMLElement, end).focus();
}

/** The score as a file: a line for each drill. */
function saveScore() {
  const heads = ["csv_who", "csv_set", "csv_drill", "csv_happened", "csv_said", "csv_did", "csv_points"].map((key) => language.say(key));
  const rows = tasks.map(({ task }, at) => {
    const did = task.actions.map((action) => language.say(`do_${data.actions[action]}`)).join(" > ");
    const said = task.kind && language.say(`kind_${task.kind}`);
    return [who.value.trim(), data.set, at + 1, language.say(`kind_${data.drills[at].kind}`), said, did, task.what + task.done];
  });
  save("operation.csv", fileOf([heads, ...rows].map((row) => row.map((value) => cellOf(String(value))))));
}

for (const form of elements("form")) form.addEventListener("submit", (event) => event.preventDefault());
for (const { show: showIt } of tasks) showIt(false);
start.addEventListener("submit", () => show(0));
element("#save", HTMLButtonElement).addEventListener("click", saveScore);
language.onChange(write);
language.begin();
