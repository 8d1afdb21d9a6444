// The score as a file to take along: a line for each task, in the language of the page.
import { cellOf, fileOf, save } from "../../html/assets/csv.js";
import { pick, say } from "../../html/assets/language.js";

/**
 * @import { Drills } from "./data.js"
 * @import { Task } from "./task.js"
 */

/**
 * Save what was answered.
 * @param {Drills} data
 * @param {Task[]} tasks
 * @param {string} who who answered
 */
export function saveScore({ set, drills, groups, levels }, tasks, who) {
  const heads = [
    say("csv_who"), say("csv_set"), say("csv_drill"), say("csv_level"), say("csv_line"), say("csv_right_lines"),
    say("csv_fault"), say("csv_right_fault"), say("csv_points"),
  ];
  const rows = tasks.map(({ line, group, points }, at) => {
    const { lines, group: right, level } = drills[at];
    const fault = group && pick(groups[group]);
    const texts = [who, set, at + 1, pick(levels[level]), line, lines.join(" / "), fault, pick(groups[right]), points];
    return texts.map((value) => cellOf(String(value)));
  });
  save("drill.csv", fileOf([heads.map(cellOf), ...rows]));
}
