// The grammars, by the engine that the editor itself colours with; and the page of a path.
const assert = require("node:assert");
const fs = require("node:fs");
const path = require("node:path");
const { test, before } = require("node:test");
const oniguruma = require("vscode-oniguruma");
const { INITIAL, Registry, parseRawGrammar } = require("vscode-textmate");
const { pathHtml } = require("../src/path_view");

const FOLDER = path.join(__dirname, "..", "syntaxes");
const FILES = { "source.wirecut.3b": "wirecut-3b.tmLanguage.json", "source.wirecut.iso": "wirecut-iso.tmLanguage.json" };
let registry;

before(async () => {
  await oniguruma.loadWASM(fs.readFileSync(require.resolve("vscode-oniguruma/release/onig.wasm")).buffer);
  registry = new Registry({
    onigLib: Promise.resolve({
      createOnigScanner: (patterns) => new oniguruma.OnigScanner(patterns),
      createOnigString: (text) => new oniguruma.OnigString(text),
    }),
    loadGrammar: async (scope) => {
      const file = path.join(FOLDER, FILES[scope]);
      return parseRawGrammar(fs.readFileSync(file, "utf-8"), file);
    },
  });
});

/**
 * Pieces of a line with the last scope of each, blanks and those without one left out.
 * @param {string} scope
 * @param {string} line
 */
async function painted(scope, line) {
  const grammar = await registry.loadGrammar(scope);
  const { tokens } = grammar.tokenizeLine(line, INITIAL);
  return tokens
    .map(({ startIndex, endIndex, scopes }) => [line.slice(startIndex, endIndex), scopes[scopes.length - 1]])
    .filter(([text, last]) => text.trim() && last !== scope && last !== "meta.block.wirecut")
    .map(([text, last]) => [text.trim(), last.replace(/\.wirecut$/, "")]);
}

test("a block of 3B", async () => {
  const found = await painted("source.wirecut.3b", "N1: B 9900 B0 B39600 GX NR1 ;-9.9,0.0 // x");
  assert.deepStrictEqual(found, [
    ["N1:", "entity.name.label"], ["B", "punctuation.separator"], ["9900", "constant.numeric.x"],
    ["B", "punctuation.separator"], ["0", "constant.numeric.y"], ["B", "punctuation.separator"],
    ["39600", "constant.numeric.count"], ["GX", "variable.other.property.axis"], ["NR1", "entity.name.function.arc"],
    [";-9.9,0.0", "string.unquoted.printed-end"], ["// x", "comment.line"],
  ]);
});

test("glued blocks, lines, 4B and marks", async () => {
  const glued = await painted("source.wirecut.3b", "b1b2b2gyL1B3B0B6B3GYDNR1 DD");
  assert.deepStrictEqual(glued.filter(([text]) => !/^[Bb]$/.test(text)).map(([text, last]) => `${text} ${last.split(".").pop()}`), [
    "1 x", "2 y", "2 count", "gy axis", "L1 line", "3 x", "0 y", "6 count", "3 radius", "GY axis", "D curve", "NR1 arc", "DD mark",
  ]);
  assert.deepStrictEqual(await painted("source.wirecut.3b", "CAXAWEDM -Version 2.0 , Name : PADD"), [
    ["CAXAWEDM -Version 2.0 , Name : PADD", "comment.line.header"],
  ]);
});

test("a line of ISO", async () => {
  const found = await painted("source.wirecut.iso", "N10 G41 D1 G03 X-1.5 Y.2 I0 J3. (arc)");
  assert.deepStrictEqual(found.map(([text, last]) => `${text} ${last}`), [
    "N10 entity.name.label", "G41 keyword.control", "D1 variable.parameter.register", "G03 entity.name.function.arc",
    "X variable.other.property.axis", "-1.5 constant.numeric", "Y variable.other.property.axis", ".2 constant.numeric",
    "I variable.other.property.axis", "0 constant.numeric", "J variable.other.property.axis", "3. constant.numeric",
    "(arc) comment.block",
  ]);
});

test("a picture cannot run anything", () => {
  const html = pathHtml("<svg onload=\"alert(1)\"><script>alert(2)</script></svg>", true);
  assert.ok(!html.includes("alert"));
  assert.ok(html.includes("default-src 'none'"));
  assert.ok(!pathHtml("", false).includes("<img"));
});
