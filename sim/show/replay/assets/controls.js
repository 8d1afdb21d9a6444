// Buttons, sliders and tabs: what they do, and how they show what is set.
import { element, elements } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { FASTEST, SLOWEST } from "./player.js";
import * as words from "./words.js";

/**
 * @import { PageState } from "./page_state.js"
 * @import { Player } from "./player.js"
 * @import { Quiz } from "./quiz.js"
 * @import { Stage } from "./stage.js"
 */

/** @typedef {Record<string, () => void>} Actions */

const TIMES = [0, 1, 10, 100, 1000];
const PAN = 80; // px of a key press
const ZOOM = 1.5;
const HUNDRED = 100;

/**
 * Actions of a player by name.
 * @param {Player} player
 * @returns {Actions}
 */
export function playerActions(player) {
  return {
    toggle: player.toggle,
    stepBack: () => player.stepBy(-1),
    stepOn: () => player.stepBy(1),
    hundredBack: () => player.stepBy(-HUNDRED),
    hundredOn: () => player.stepBy(HUNDRED),
    blockBack: () => player.blockBy(-1),
    blockOn: () => player.blockBy(1),
    toStart: () => player.seek(0),
    toEnd: () => player.seek(player.duration),
    slower: () => player.faster(-1),
    faster: () => player.faster(1),
    loopFrom: () => player.setLoop("from"),
    loopTo: () => player.setLoop("to"),
    loop: player.toggleLoop,
    clearLoop: player.clearLoop,
  };
}

/**
 * Actions by name, for buttons with `data-do` and for keys.
 * @param {{ player: Player, stage: Stage, quiz: Quiz, page: PageState, redraw: () => void }} parts
 * @returns {Actions}
 */
export function actionsOf({ player, stage, quiz, page, redraw }) {
  const { view } = stage;
  /** @param {() => void} change */
  const moved = (change) => () => {
    change();
    redraw();
  };
  /** @param {number} factor */
  const zoom = (factor) => moved(() => view.zoomAt(view.width / 2, view.height / 2, factor));
  /** @param {() => void} change */
  const looked = (change) => moved(() => {
    page.follow(false);
    change();
  });
  return {
    ...playerActions(player),
    zoomIn: zoom(ZOOM),
    zoomOut: zoom(1 / ZOOM),
    fit: looked(stage.fit),
    fitTable: looked(stage.fitTable),
    toSteps: moved(() => {
      const { x, y } = player.state();
      stage.toSteps(x, y);
      page.follow(true);
    }),
    follow: moved(() => page.follow(!page.isFollowing)),
    magnify: moved(() => page.magnify(TIMES[(TIMES.indexOf(page.times) + 1) % TIMES.length])),
    quiz: quiz.toggle,
    language: language.change,
    help: () => page.help(true),
    close: () => page.help(false),
    panLeft: looked(() => view.panBy(PAN, 0)),
    panRight: looked(() => view.panBy(-PAN, 0)),
    panUp: looked(() => view.panBy(0, PAN)),
    panDown: looked(() => view.panBy(0, -PAN)),
  };
}

/**
 * Have the buttons call actions; a button that was clicked leaves the keyboard to the page.
 * @param {Actions} actions
 * @param {HTMLElement[]} buttons
 */
export function wireButtons(actions, buttons = elements("[data-do]")) {
  for (const button of buttons) {
    button.addEventListener("click", (event) => {
      actions[button.dataset.do ?? ""]();
      if (event.detail > 0) button.blur();
    });
  }
}

/**
 * Tabs: one shows at a time; arrow keys change between them.
 * @param {HTMLElement[]} tabs
 */
export function wireTabs(tabs) {
  /** @param {HTMLElement} tab */
  const open = (tab) => {
    for (const other of tabs) {
      other.setAttribute("aria-selected", String(other === tab));
      other.tabIndex = other === tab ? 0 : -1;
      element(`#${other.getAttribute("aria-controls")}`, HTMLElement).hidden = other !== tab;
    }
  };
  tabs.forEach((tab, at) => {
    tab.addEventListener("click", () => open(tab));
    tab.addEventListener("keydown", (event) => {
      if (event.key !== "ArrowLeft" && event.key !== "ArrowRight") return;
      event.stopPropagation();
      const next = tabs[(at + 1) % tabs.length];
      open(next);
      next.focus();
    });
  });
}

/**
 * Slider of the speed: the logarithm of how many times as fast; its arrow keys go 1, 2, 5, 10 … as `[` and `]` do.
 * @param {HTMLInputElement} slider
 * @param {HTMLElement} shown
 * @param {Player} player
 */
export function wireSpeed(slider, shown, player) {
  slider.min = String(Math.log10(SLOWEST));
  slider.max = String(Math.log10(FASTEST));
  slider.addEventListener("keydown", (event) => {
    const ways = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 };
    const way = ways[/** @type {keyof typeof ways} */ (event.key)];
    if (!way || event.shiftKey || event.ctrlKey || event.altKey || event.metaKey) return;
    event.preventDefault(); // its own step is rounded back to the speed that it leaves
    event.stopPropagation();
    player.faster(way);
  });
  slider.addEventListener("input", () => player.setSpeed(Number((10 ** Number(slider.value)).toPrecision(2))));
  const show = () => {
    slider.value = String(Math.log10(player.speed));
    shown.textContent = words.speed(player.speed);
    slider.setAttribute("aria-valuetext", shown.textContent);
  };
  player.onChange(show);
  show();
}

/**
 * Show in the buttons what the player does.
 * @param {Player} player
 */
export function showPlayer(player) {
  /** @param {string} name */
  const byName = (name) => element(`[data-do="${name}"]`, HTMLElement);
  const { loop } = player;
  byName("toggle").classList.toggle("playing", player.playing);
  byName("toggle").setAttribute("aria-pressed", String(player.playing));
  byName("loop").setAttribute("aria-pressed", String(loop.isOn));
  byName("loopFrom").classList.toggle("set", loop.from !== null);
  byName("loopTo").classList.toggle("set", loop.to !== null);
}
