// The findings of the run as a list; one that is about a block leads there.
(function (root) {
  "use strict";
  const Drycut = (root.Drycut = root.Drycut || {});

  /** Where a finding is. */
  function where(finding) {
    const { say } = Drycut.language;
    const places = [];
    if (finding.block) places.push(say("in_block", { block: finding.block }));
    if (finding.line) places.push(say("in_line", { line: finding.line }));
    return places.join(", ");
  }

  /** One finding: a button where it leads to a block. */
  function entry(finding, onPick) {
    const texts = Drycut.words.finding(finding);
    const made = Drycut.element(finding.t_s === null ? "div" : "button", `finding ${finding.severity}`);
    if (finding.t_s !== null) {
      made.type = "button";
      made.addEventListener("click", () => onPick(finding));
    }
    made.append(
      Drycut.element("strong", "", `${finding.code} ${texts.title}`),
      Drycut.element("span", "where", where(finding)),
      Drycut.element("span", "message", texts.message),
      Drycut.element("span", "hint", texts.hint),
    );
    return made;
  }

  /** List of the findings in `box`. */
  function findings(box, doc, onPick) {
    /** Write the list in the language of the page. */
    function write() {
      const none = Drycut.element("p", "none", Drycut.language.say("nothing_found"));
      const items = doc.findings.map((finding) => {
        const item = Drycut.element("li", "");
        item.append(entry(finding, onPick));
        return item;
      });
      const list = Drycut.element("ul", "");
      list.append(...items);
      box.replaceChildren(items.length ? list : none);
    }
    write();
    return { write };
  }

  Drycut.findings = findings;
})(globalThis);
