// drycut in VS Code: the language server of `drycut lsp`, and the path of a program beside its text.
const vscode = require("vscode");
const { LanguageClient } = require("vscode-languageclient/node");
const { pathHtml } = require("./path_view");

const LANGUAGES = ["wirecut-3b", "wirecut-iso"];
const WAIT_MS = 250; // after a key, until the path is drawn anew

/** @type {LanguageClient | undefined} */
let client;
/** @type {vscode.WebviewPanel | undefined} */
let panel;
/** @type {vscode.Uri | undefined} */
let shownUri;

/** The command line of the server, by the settings. */
function serverOptions() {
  const settings = vscode.workspace.getConfiguration("drycut");
  const language = settings.get("language", "editor");
  const args = ["lsp", ...(language === "editor" ? [] : ["--lang", language])];
  return { command: settings.get("command", "drycut"), args };
}

/** Draw the path of the text that is shown. */
async function drawPath() {
  if (!client || !panel || !shownUri) return;
  const isDark = [vscode.ColorThemeKind.Dark, vscode.ColorThemeKind.HighContrast].includes(vscode.window.activeColorTheme.kind);
  const asked = { uri: client.code2ProtocolConverter.asUri(shownUri), theme: isDark ? "dark" : "light" };
  try {
    const { svg } = await client.sendRequest("drycut/path", asked);
    panel.webview.html = pathHtml(svg, isDark);
  } catch (error) {
    client.warn("drycut/path", error);
  }
}

/** Show the path of the text in the active editor beside it. */
function showPath() {
  const editor = vscode.window.activeTextEditor;
  if (!editor || !LANGUAGES.includes(editor.document.languageId)) return;
  shownUri = editor.document.uri;
  panel ??= vscode.window.createWebviewPanel("drycut.path", "drycut", vscode.ViewColumn.Beside, { enableScripts: false });
  panel.onDidDispose(() => { panel = undefined; });
  drawPath();
}

/**
 * Start the server when a program is opened.
 * @param {vscode.ExtensionContext} context
 */
async function activate(context) {
  const documentSelector = LANGUAGES.map((language) => ({ language }));
  client = new LanguageClient("drycut", "drycut", serverOptions(), { documentSelector });
  let waiting;
  context.subscriptions.push(
    client,
    vscode.commands.registerCommand("drycut.showPath", showPath),
    vscode.window.onDidChangeActiveColorTheme(drawPath),
    vscode.window.onDidChangeActiveTextEditor((editor) => {
      if (!panel || !editor || !LANGUAGES.includes(editor.document.languageId)) return;
      shownUri = editor.document.uri;
      drawPath();
    }),
    vscode.workspace.onDidChangeTextDocument(({ document }) => {
      if (document.uri.toString() !== shownUri?.toString()) return;
      clearTimeout(waiting);
      waiting = setTimeout(drawPath, WAIT_MS);
    }),
  );
  try {
    await client.start();
  } catch (error) {
    const { command } = serverOptions();
    vscode.window.showErrorMessage(`drycut: ${command}: ${error instanceof Error ? error.message : error}`);
  }
}

/** End the server with the editor. */
function deactivate() {
  return client?.stop();
}

module.exports = { activate, deactivate };
