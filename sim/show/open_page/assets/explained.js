// The page of a code in place: why it is found, and how it is mended, from the Markdown of the catalogue.
import { make } from "../../html/assets/elements.js";
import * as language from "../../html/assets/language.js";

/** @import { Explained } from "./data.js" */

/**
 * A paragraph, its `code` and **strong** words as such: nothing in it is markup of the page.
 * @param {string} text
 */
function paragraph(text) {
  const parts = text.split(/(`[^`]+`|\*\*[^*]+\*\*)/).map((part) => {
    if (part.startsWith("`")) return make("code", {}, part.slice(1, -1));
    return part.startsWith("**") ? make("strong", {}, part.slice(2, -2)) : part;
  });
  return make("p", {}, ...parts);
}

/**
 * Paragraphs of a text; lines of one are joined, in Chinese without a blank.
 * @param {string} markdown
 */
function paragraphs(markdown) {
  const joint = language.isChinese() ? "" : " ";
  return markdown.trim().split(/\n{2,}/).map((text) => paragraph(text.split("\n").map((line) => line.trim()).join(joint)));
}

/**
 * The page of a code, folded up.
 * @param {Explained} page
 */
export function pageOf({ why, mend }) {
  return make(
    "details", {},
    make("summary", {}, language.say("why")),
    ...paragraphs(language.pick(why)),
    make("p", {}, make("strong", {}, language.say("how-to-mend"))),
    ...paragraphs(language.pick(mend)),
  );
}
