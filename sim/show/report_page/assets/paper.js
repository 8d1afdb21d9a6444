// What goes on paper: the job sheet and the tables; with a tick all of the page, what is folded up included.

/**
 * Let a tick decide.
 * @param {HTMLInputElement} tick
 */
export function printBy(tick) {
  tick.addEventListener("change", () => document.documentElement.classList.toggle("everything", tick.checked));
  /** @type {HTMLDetailsElement[]} */
  let opened = [];
  window.addEventListener("beforeprint", () => {
    if (!tick.checked) return;
    opened = [...document.querySelectorAll("details")].filter((one) => !one.open);
    for (const one of opened) one.open = true;
  });
  window.addEventListener("afterprint", () => {
    for (const one of opened) one.open = false;
    opened = [];
  });
}
