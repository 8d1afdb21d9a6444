// Files that come to the page and go from it: dropped, picked, of the folder, or an example; saved as they came.
import * as asked from "./asked.js";
import { element, elements, make } from "../../html/assets/elements.js";

/** @import { FileText, Recent } from "./data.js" */

const ALIVE_MS = 20_000;

/**
 * Let files come and go.
 * @param {object} page
 * @param {(read: FileText) => void} page.begin opens a program
 * @param {(number: string, name: string) => Promise<void>} page.draw takes a drawing
 * @param {(files: File[]) => Promise<void>} page.list shows several files
 * @param {(read: FileText) => void} page.machine takes a machine, or says why it is none
 * @param {() => void} page.unlist shows the program
 * @param {() => { file: FileText, text: string, name: string }} page.current the program as it stands
 * @param {() => void} page.onSaved
 * @param {(key: string) => void} page.tell says what went wrong
 */
export function wireFiles({ begin, draw, list, machine, unlist, current, onSaved, tell }) {
  const pick = element("#pick", HTMLInputElement);

  /**
   * Take what was read: a program, or a drawing.
   * @param {FileText} read
   */
  async function take(read) {
    if (read.drawing) await draw(read.drawing, read.name);
    else if (read.machine || read.technologies || read.why) machine(read);
    else begin(read);
  }

  /**
   * Open a program by its number, or a file; whether it could be read.
   * @param {string | File} source
   */
  async function open(source) {
    try {
      await take(typeof source === "string" ? await asked.program(source) : await asked.read(source.name, source));
      return true;
    } catch {
      tell("not-read");
      return false;
    }
  }

  /**
   * Open what was dropped or picked: one file, or the list of several.
   * @param {FileList | null | undefined} chosen
   */
  async function come(chosen) {
    const files = [...(chosen ?? [])];
    if (files.length > 1) list(files).catch(() => tell("no-server"));
    else if (files.length && await open(files[0])) unlist();
  }

  /** Save the text as its file was: encoding and line ends stay. */
  async function save() {
    try {
      const { file, text, name } = current();
      const link = document.createElement("a");
      link.href = window.URL.createObjectURL(await asked.saved(file, text));
      link.download = name;
      link.click();
      onSaved();
      window.setTimeout(() => window.URL.revokeObjectURL(link.href), ALIVE_MS);
    } catch {
      tell("no-server");
    }
  }

  const offer = element("#begin", HTMLElement);
  for (const button of elements("[data-open]", offer)) button.addEventListener("click", () => pick.click());
  for (const button of elements("[data-start]", offer)) {
    button.addEventListener("click", () => asked.example(button.dataset.start ?? "").then(take, () => tell("no-server")));
  }
  window.addEventListener("dragover", (event) => event.preventDefault());
  window.addEventListener("drop", (event) => {
    event.preventDefault();
    come(event.dataTransfer?.files);
  });
  pick.addEventListener("change", () => {
    come(pick.files);
    pick.value = "";
  });
  element("#open", HTMLElement).addEventListener("click", () => pick.click());
  element("#save", HTMLElement).addEventListener("click", save);
  element("#close", HTMLElement).addEventListener("click", async () => {
    await asked.close();
    tell("closed");
  });
  window.setInterval(() => asked.alive().catch(() => tell("no-server")), ALIVE_MS);
  return {
    open,
    take,
    /**
     * Offer files that were opened before.
     * @param {Recent[]} recent
     */
    recent(recent) {
      const offered = element("#recent", HTMLElement);
      offered.hidden = !recent.length;
      element(".choices", HTMLElement, offered).replaceChildren(...recent.map(({ name, folder, number }) => {
        const button = make("button", { type: "button", title: folder }, name);
        button.addEventListener("click", () => open(number));
        return button;
      }));
    },
    /**
     * Offer a file or an example to begin with, over the empty picture.
     * @param {boolean} isShown
     */
    offer(isShown) { offer.hidden = !isShown; },
  };
}
