// The score as a file to take along: a line for each task, in the language of the page.
import { cellOf, fileOf, save } from "../../html/assets/csv.js";
import { say } from "../../html/assets/language.js";

/**
 * @import { Drill } from "./data.js"
 * @import { Task } from "./task.js"
 */

/**
 * Save what was answered.
 * @param {Drill[]} drills
 * @param {Task[]} tasks
 * @param {{ who: string, set: number }} about who answered, and which set
 */
export function saveScore(drills, tasks, { who, set }) {
  const heads = [
    say("csv_who"), say("csv_set"), say("csv_drill"), say("csv_level"), say("csv_line"), say("csv_right_lines"),
    say("csv_fault"), say("csv_right_fault"), say("csv_points"),
  ];
  const rows = tasks.map(({ line, group, points }, at) => {
    const { lines, group: right, level } = drills[at];
    return [who, set, at + 1, level, line, lines.join(" / "), group, right, points].map((value) => cellOf(String(value)));
  });
  save("drill.csv", fileOf([heads.map(cellOf), ...rows]));
}
