// Elements of the page: those that it has, and new ones.

/** @import { Said } from "./language.js" */

/**
 * The first element that a selector finds; an error where there is none of this kind.
 * @template {HTMLElement} T
 * @param {string} selector
 * @param {new () => T} kind
 * @param {ParentNode} within
 */
export function element(selector, kind, within = document) {
  const found = within.querySelector(selector);
  if (found instanceof kind) return found;
  throw new Error(`the page lacks ${selector}`);
}

/**
 * All elements that a selector finds.
 * @param {string} selector
 * @param {ParentNode} within
 */
export function elements(selector, within = document) {
  return [...within.querySelectorAll(selector)].filter((found) => found instanceof HTMLElement);
}

/**
 * A new element with properties and children.
 * @template {keyof HTMLElementTagNameMap} T
 * @param {T} tag
 * @param {Partial<HTMLElementTagNameMap[T]>} properties
 * @param {...(Node | string)} children
 */
export function make(tag, properties, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/**
 * The texts of both languages, of which the page shows one.
 * @param {Said} text
 */
export function both(text) {
  return [make("span", { lang: "en" }, text.en), make("span", { lang: "zh-CN" }, text.zh)];
}
