// What the page itself remembers: whether it follows the wire, and how much deviations are magnified.
import { element } from "../../html/assets/elements.js";

/** @typedef {ReturnType<typeof pageStateOf>} PageState */

/**
 * State of the page, as its buttons show it; `redraw` is called where a reader changes it.
 * @param {() => void} redraw
 */
export function pageStateOf(redraw) {
  const select = element("#magnify", HTMLSelectElement);
  const button = element('[data-do="follow"]', HTMLElement);
  const help = element("#help", HTMLDialogElement);
  const page = {
    isFollowing: false,
    times: 0,
    /** @param {boolean} isOn */
    follow(isOn) {
      page.isFollowing = isOn;
      button.setAttribute("aria-pressed", String(isOn));
    },
    /** @param {number} times */
    magnify(times) {
      page.times = times;
      select.value = String(times);
    },
    /** @param {boolean} isOpen */
    help(isOpen) {
      if (isOpen) help.showModal();
      else help.close();
    },
  };
  select.addEventListener("change", () => {
    page.magnify(Number(select.value));
    redraw();
  });
  return page;
}
