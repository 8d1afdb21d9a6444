// All parts of the page, and the frame that is drawn whenever something has changed.
import { element, elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { actionsOf, showPlayer, wireButtons, wireSpeed, wireTabs } from "./controls.js";
import { decodingIn } from "./decoding.js";
import { findingsIn } from "./findings.js";
import { wireKeys } from "./keys.js";
import { modelOf } from "./model.js";
import { wireMoment } from "./moment.js";
import { pageStateOf } from "./page_state.js";
import { passOfRows } from "./passes.js";
import { playerOf } from "./player.js";
import { wirePointer } from "./pointer.js";
import { programIn } from "./program.js";
import { quizIn } from "./quiz.js";
import { readoutsIn } from "./readouts.js";
import { stageOn } from "./stage.js";
import { timelineIn } from "./timeline.js";
import { tipIn } from "./tip.js";
import * as words from "./words.js";

/**
 * @import { Replay } from "./decode.js"
 * @import { Question, ReplayDocument, TimedFinding } from "./document.js"
 * @import { Moment, PlayerState } from "./player.js"
 */

/** @param {string} id */
const found = (id) => element(`#${id}`, HTMLElement);

/**
 * Say the block and its pass while the replay stands, for those who cannot see them.
 * @param {HTMLElement} box
 * @param {ReplayDocument} doc
 */
function announcer(box, doc) {
  const passes = passOfRows(doc);
  let said = "";
  return (/** @type {PlayerState} */ state) => {
    if (state.playing) return;
    const pass = passes[state.block];
    const text = words.block(doc.blocks, state.block) + (pass ? ` · ${language.pick(pass.name)}` : "");
    if (text !== said) box.textContent = text;
    said = text;
  };
}

/**
 * Build everything of a replay that is drawn or written, and draw it.
 * @param {Replay} replay
 */
export function buildPage(replay) {
  const { doc } = replay;
  const model = modelOf(replay);
  const player = playerOf(replay, model);
  const table = element("#table", HTMLCanvasElement);
  const bar = found("bar");
  let wanted = 0; // the frame that is asked for, if any
  /** @type {number | null} */
  let last = null;

  /** Ask for a frame. */
  function redraw() {
    if (!wanted) wanted = requestAnimationFrame(frame);
  }

  /**
   * Lead to a finding.
   * @param {TimedFinding} finding
   */
  function onFinding({ row, t_s: t }) {
    if (row !== null && t === doc.blocks.border_s[row]) player.seekBlock(row); // which may take no time at all
    else player.seek(t);
  }

  /**
   * Show nothing that would answer a question while it is open.
   * @param {Question | null} question
   */
  function onAsk(question) {
    text.hide(question?.row ?? null, question?.hidden ?? []);
    document.body.classList.toggle("asked", question !== null);
    found("quiz-on").setAttribute("aria-pressed", String(quiz.isOn));
    tip.hide();
    timeline.ask(quiz.rows);
    redraw();
  }

  const page = pageStateOf(redraw);
  const stage = stageOn(table, replay, model, redraw);
  const quiz = quizIn(
    {
      panel: found("quiz"), count: found("quiz-count"), ask: found("quiz-ask"), answers: found("quiz-answers"),
      said: found("quiz-said"), go: found("quiz-go"), save: found("quiz-save"), start: found("quiz-start"),
    },
    doc,
    player,
    onAsk,
  );
  const address = wireMoment(doc, player);
  const actions = { ...actionsOf({ player, stage, quiz, page, redraw }), link: address.link };
  const outs = readoutsIn(document.body, doc, model);
  const tip = tipIn(found("tip"));
  const timeline = timelineIn(
    { bar, marks: element("#marks", HTMLCanvasElement), cursor: found("cursor"), findings: found("finding-marks"), whole: found("whole-run") },
    doc,
    player,
    stage.colours,
    { onSeek: player.seek, onBlock: player.seekBlock, onFinding },
  );
  const list = findingsIn(found("findings"), doc, onFinding);
  const text = programIn(found("program"), doc, {
    onPick: player.seekBlock,
    onHover(row, event) {
      stage.outline(row);
      if (row === null || quiz.isAsking) tip.hide();
      else tip.show(words.block(doc.blocks, row), words.geometry(doc, row), event.clientX, event.clientY);
    },
  });
  const decoding = decodingIn(elements("#decoding"), doc);
  const announce = announcer(found("live"), doc);

  /**
   * Say where a time is on the bar.
   * @param {number} t
   */
  function showTime(t) {
    bar.setAttribute("aria-valuenow", t.toFixed(3));
    bar.setAttribute("aria-valuetext", words.clock(t));
    timeline.at(t);
  }

  /**
   * What a frame shows now.
   * @returns {Moment}
   */
  function moment() {
    const state = player.state();
    return { ...state, deviation: model.deviation(state.t), isAsked: quiz.isAsking };
  }

  /**
   * One frame: let time go by, and show the moment.
   * @param {number} now
   */
  function frame(now) {
    wanted = 0;
    const wasPlaying = player.playing;
    player.advance(last === null ? 0 : (now - last) / 1000);
    const shown = moment();
    if (page.isFollowing) stage.view.lookAt(...shown.wire);
    const falls = wasPlaying || (stage.isFalling && shown.t >= player.duration); // on after the end
    stage.draw(shown, page, falls, now);
    outs.show(shown);
    text.run(shown.block);
    decoding.run(shown.block);
    showTime(shown.t);
    if (!shown.isAsked) announce(shown);
    last = player.playing || stage.isFalling ? now : null;
    if (last !== null) redraw();
  }

  player.onChange(() => {
    showPlayer(player);
    timeline.loop(player.loop);
    redraw();
  });
  wirePointer(table, stage.view, (isPan) => {
    if (isPan) page.follow(false);
    redraw();
  });
  wireButtons(actions);
  wireTabs(elements('[role="tab"]'));
  wireSpeed(element("#speed", HTMLInputElement), found("speed-shown"), player);
  wireKeys(actions, quiz);
  language.onChange(() => {
    list.write();
    timeline.redo();
    redraw();
  });
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", timeline.redo);
  window.matchMedia("print").addEventListener("change", ({ matches }) => {
    stage.print(matches);
    stage.draw(moment(), page, false, 0); // paper does not wait for a frame
  });
  bar.setAttribute("aria-valuemax", String(player.duration));
  found("loading").hidden = true;
  showPlayer(player);
  if (quiz.isLinked) quiz.toggle();
  redraw();
  return { player, view: stage.view };
}
