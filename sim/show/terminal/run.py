"""The summary table of a run on the terminal."""

from pathlib import Path

from rich.console import Console
from rich.markup import escape
from rich.table import Table
from rich.text import Text

from parser.findings.catalogue import texts
from parser.findings.codes import Severity
from parser.findings.findings import Finding
from parser.text.encoding import printable
from parser.text.excerpt import place, with_caret
from sim.run.dryrun import DryRun, verdict
from sim.show.terminal.run_rows import summary_rows

_COLOURS = {Severity.ERROR: "red", Severity.WARNING: "yellow", Severity.NOTE: "cyan"}
_MOST_FINDINGS = 20


def print_summary(run: DryRun, output: Path | None) -> None:
    """Print the figures of a run, its findings and its verdict to stdout."""
    console = Console(highlight=False)
    console.soft_wrap = not console.is_terminal  # a line a finding for those that read lines
    table = Table(title=escape(run.scenario.title), title_justify="left", show_header=False, title_style="bold")
    table.add_column(style="dim")
    table.add_column()
    for name, value in summary_rows(run):
        table.add_row(name, escape(value))
    console.print(table)
    _print_findings(console, run, output)
    passed = verdict(run.findings) == "pass"
    console.print(Text(f"verdict: {'pass' if passed else 'fail'}", style="bold green" if passed else "bold red"))


def _print_findings(console: Console, run: DryRun, output: Path | None) -> None:
    for finding in run.findings[:_MOST_FINDINGS]:
        console.print(_line(printable(str(run.scenario.program)), finding))
        if finding.column:
            width = finding.span[1] - finding.span[0]
            excerpt = with_caret(run.program.excerpt(finding.line), finding.column, width)
            console.print(Text(excerpt, style="dim"))
    if len(run.findings) > _MOST_FINDINGS:
        there = "in report.json" if output else "in the report; -o DIR or --json shows them"
        console.print(f"… and {len(run.findings) - _MOST_FINDINGS} findings more, {there}")


def _line(name: str, finding: Finding) -> Text:
    at = place(name, finding.line, finding.column)
    block = f" block {finding.block}:" if finding.block else ""
    text = Text(f"{at}: ")
    text.append(f"{finding.severity}[{finding.code}]", style=_COLOURS[finding.severity])
    return text.append(f":{block} {texts(finding).message}")
