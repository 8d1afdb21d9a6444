// The page of a path: an SVG that the server drew, and nothing that could run.

const POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'";

/**
 * The page of a picture; empty where there is none.
 * @param {string} svg
 * @param {boolean} isDark
 */
function pathHtml(svg, isDark) {
  const picture = svg ? `<img alt="" src="data:image/svg+xml;base64,${Buffer.from(svg, "utf-8").toString("base64")}">` : "";
  const style = `body{margin:0;background:${isDark ? "#15181c" : "#ffffff"}}img{width:100%;height:auto;display:block}`;
  const policy = `<meta http-equiv="Content-Security-Policy" content="${POLICY}">`;
  return `<!doctype html><html><head><meta charset="utf-8">${policy}<style>${style}</style></head><body>${picture}</body></html>`;
}

module.exports = { pathHtml };
