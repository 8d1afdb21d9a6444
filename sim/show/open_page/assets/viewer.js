// A file of a run, shown over the page: a picture, a film, or a page of its own in a frame that may ask nobody.
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/**
 * Whether a file is a film that needs a player.
 * @param {string} name
 */
export const isVideo = (name) => name.endsWith(".mp4");

/**
 * Whether a file is a page.
 * @param {string} name
 */
export const isPage = (name) => name.endsWith(".html");

/**
 * What shows a file.
 * @param {string} href
 * @param {string} name
 * @param {string} title
 */
function shown(href, name, title) {
  if (isVideo(name)) return make("video", { src: href, controls: true, autoplay: true, loop: true, muted: true, ariaLabel: title });
  if (!isPage(name)) return make("img", { src: href, alt: title });
  const frame = make("iframe", { title });
  frame.setAttribute("sandbox", "allow-scripts allow-downloads allow-forms");
  frame.src = `${href}#lang=${language.current()}`;
  return frame;
}

/** Let the page show files; the answer shows one. */
export function wireViewer() {
  const dialog = element("#viewer", HTMLDialogElement);
  const place = element("#viewed", HTMLElement);
  const beside = element("#beside", HTMLAnchorElement);
  dialog.addEventListener("close", () => place.replaceChildren());
  element("#unview", HTMLElement).addEventListener("click", () => dialog.close());
  /**
   * @param {string} href
   * @param {string} name
   * @param {string} title
   */
  return (href, name, title) => {
    element("#viewing", HTMLElement).textContent = title;
    beside.href = href;
    place.replaceChildren(shown(href, name, title));
    dialog.showModal();
  };
}
