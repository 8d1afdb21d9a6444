// What a run gave: its pages and pictures to look at, its film, and every file to be saved.
import { element, make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";
import { isPage, isVideo, wireViewer } from "./viewer.js";

/** @import { Said } from "../../html/assets/language.js" */
/** @import { MadeFile, RunState } from "./data.js" */

const FILM = "film.";
const KB = 1000;

/** @type {Record<string, string>} */
const PAGES = {
  "replay.html": "file-replay", "report.html": "file-report", "drill.html": "file-drill", "answers.html": "file-answers",
};
/** @type {Record<string, Said>} */
const PICTURES = JSON.parse(element("#pictures", HTMLElement).textContent);

/** @param {string} name */
const isPicture = (name) => /\.(png|apng|gif|webp|mp4)$/.test(name);

/**
 * What a file is, for people.
 * @param {string} name
 */
function titleOf(name) {
  if (name in PAGES) return language.say(PAGES[name]);
  if (name.startsWith(FILM)) return language.say("file-film");
  const said = PICTURES[name.slice(0, name.lastIndexOf("."))];
  return said ? language.pick(said) : name;
}

/** @param {number} bytes */
const sizeOf = (bytes) => (bytes < KB * KB ? `${Math.ceil(bytes / KB)} kB` : `${(bytes / KB / KB).toFixed(1)} MB`);

/**
 * Let the files of a run be seen and saved.
 * @param {(asked: Record<string, string>) => void} ask for a film, for pictures or for fault drills
 */
export function wireMade(ask) {
  const box = element("#made", HTMLElement);
  const looks = element("#looks", HTMLElement);
  const thumbs = element("#thumbs", HTMLElement);
  const rows = element("#files", HTMLElement);
  const all = element("#all", HTMLAnchorElement);
  const form = element("#form", HTMLSelectElement);
  const seconds = element("#seconds", HTMLInputElement);
  const set = element("#set", HTMLInputElement);
  const buttons = [element("#film", HTMLButtonElement), element("#draw", HTMLButtonElement), element("#drill", HTMLButtonElement)];
  const view = wireViewer();
  let drawn = "";

  /**
   * A picture or a film, small; a click shows it large.
   * @param {string} href
   * @param {string} name
   */
  function thumbOf(href, name) {
    const title = titleOf(name);
    const small = isVideo(name)
      ? make("video", { src: href, autoplay: true, loop: true, muted: true })
      : make("img", { src: href, alt: "", loading: "lazy" });
    const button = make("button", { type: "button", className: "thumb" }, small, make("span", {}, title));
    button.addEventListener("click", () => view(href, name, title));
    return button;
  }

  /**
   * A page of the run; a click shows it.
   * @param {string} href
   * @param {string} name
   */
  function pageOf(href, name) {
    const button = make("button", { type: "button" }, titleOf(name));
    button.addEventListener("click", () => view(href, name, titleOf(name)));
    return button;
  }

  /**
   * Show the files of a run, once for each change of them.
   * @param {number} run
   * @param {MadeFile[]} files
   */
  function list(run, files) {
    const now = JSON.stringify([run, files, language.current()]);
    if (now === drawn) return;
    drawn = now;
    /** @param {MadeFile} file which is another address where it was made anew */
    const hrefOf = ({ name, bytes }) => `run/${run}/${name}?${bytes}`;
    looks.replaceChildren(...files.filter(({ name }) => isPage(name)).map((file) => pageOf(hrefOf(file), file.name)));
    thumbs.replaceChildren(...files.filter(({ name }) => isPicture(name)).map((file) => thumbOf(hrefOf(file), file.name)));
    rows.replaceChildren(...files.map((file) => {
      const { name, bytes } = file;
      const link = make("a", { href: hrefOf(file), download: name }, name);
      return make("li", {}, link, ` ${sizeOf(bytes)}`);
    }));
    all.href = `zip/${run}`;
  }

  const words = () => ({
    form: form.value, seconds: seconds.value.trim(), set: set.value.trim(), language: language.isChinese() ? "zh" : "en",
  });
  buttons[0].addEventListener("click", () => ask({ job: "film", ...words() }));
  buttons[1].addEventListener("click", () => ask({ job: "pictures", ...words() }));
  buttons[2].addEventListener("click", () => ask({ job: "drills", ...words() }));

  return {
    /**
     * Show what there is.
     * @param {RunState} state
     * @param {string} name of the program
     */
    show({ state, run, files }, name) {
      box.hidden = !files;
      element("#no-files", HTMLElement).hidden = Boolean(files);
      for (const button of buttons) button.disabled = state === "running";
      all.download = `${name}.zip`;
      if (files && run !== undefined) list(run, files);
    },
  };
}
