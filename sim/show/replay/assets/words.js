// What the page says of numbers and blocks, in the language of the page.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});
  const { say } = Drycut.language;
  const MINUS = "−";

  /** A number with so many decimals and a true minus; no −0. */
  function number(value, digits = 0) {
    const text = Math.abs(value).toLocaleString("en-US", { minimumFractionDigits: digits, maximumFractionDigits: digits });
    return value < 0 && /[1-9]/.test(text) ? MINUS + text : text;
  }

  /** µm as mm. */
  const mm = (um) => number(um / 1000, 3);

  /** A time in hours, minutes and seconds, with hundredths under an hour. */
  function clock(seconds) {
    const whole = Math.floor(seconds + 1e-9);
    const [hours, minutes, rest] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
    const two = (value) => String(value).padStart(2, "0");
    if (hours) return `${hours}:${two(minutes)}:${two(rest)}`;
    return `${two(minutes)}:${two(rest)}.${two(Math.min(99, Math.floor((seconds - whole) * 100 + 1e-6)))}`;
  }

  /** A speed of the replay. */
  const speed = (times) => `${Number(times.toPrecision(2)).toLocaleString("en-US", { maximumFractionDigits: 3 })}×`;

  /** A place as X, Y in mm. */
  const place = (x, y) => `X ${mm(x)}, Y ${mm(y)} mm`;

  /** What kind a block is. */
  function kind(blocks, row) {
    if (blocks.kind[row] === "jump") return say("jump");
    if (blocks.kind[row] === "line") return say("line");
    return blocks.sweep_rad[row] > 0 ? say("arc_left") : say("arc_right");
  }

  /** Z of a block as 3B writes it. */
  const code = (blocks, row) => ({ 1: "NR", "-1": "SR", 0: "L" })[blocks.turn[row]] + blocks.quadrant[row];

  /** Pairs of name and value that describe a block. */
  function geometry(blocks, row) {
    const rows = [
      [say("from"), place(blocks.place_x_um[row], blocks.place_y_um[row])],
      [say("to"), place(blocks.place_x_um[row + 1], blocks.place_y_um[row + 1])],
    ];
    if (blocks.kind[row] === "arc") {
      rows.push(
        [say("center"), place(blocks.center_x_um[row], blocks.center_y_um[row])],
        [say("radius"), `${mm(blocks.radius_um[row])} mm`],
        [say("sweep"), `${number((Math.abs(blocks.sweep_rad[row]) * 180) / Math.PI, 3)}°`],
      );
    }
    rows.push([say("length"), `${mm(blocks.length_um[row])} mm`]);
    if (blocks.kind[row] !== "jump") {
      rows.push(
        [say("count"), number(blocks.count_um[row])],
        [say("axis"), `G${blocks.count_axis[row]}`],
        ["Z", code(blocks, row)],
      );
    }
    return rows;
  }

  /** Title of a block, such as “Block 3 of 6 · N3 · line”. */
  function block(blocks, row) {
    const count = blocks.kind.length;
    const name = say("block", { number: number(row + 1), count: number(count) });
    return [name, blocks.label[row], kind(blocks, row)].filter(Boolean).join(" · ");
  }

  /** F and its sign. */
  const weighed = (f) => `F = ${number(Number(f))} ${f >= 0 ? "≥" : "<"} 0`;

  /** Axis and sense of a step. */
  const way = ({ axis, sign }) => (sign > 0 ? "+" : MINUS) + axis;

  /** A decision in short, as it stands beside its step. */
  const decision = (made) => `${weighed(made.f)} → ${way(made)}`;

  /** What became free. */
  function piece({ kind: what, mass_g: grams, row }) {
    const mass = grams >= 1000 ? `${number(grams / 1000, 2)} kg` : `${number(grams, grams < 10 ? 2 : 0)} g`;
    const name = say(what === "slug" ? "slug" : "part");
    return say("freed", { piece: name, mass, block: row + 1 });
  }

  /** Texts of a finding. */
  const finding = ({ texts }) => Drycut.language.pick(texts);

  Drycut.words = { number, mm, clock, speed, place, kind, code, geometry, block, weighed, way, decision, piece, finding };
})(globalThis);
