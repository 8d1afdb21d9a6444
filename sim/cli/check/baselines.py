"""What a check does with known findings: it tells which no longer occur, or writes the baseline."""

from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping, Sequence
from pathlib import Path

from parser.findings.catalogue import Language
from parser.text.encoding import printable
from sim.check.file_check import Job
from sim.check.result import CheckResult
from sim.check.silence.baseline import Baseline, baseline_text, known_of
from sim.check.silence.directives import without_known
from sim.show.texts import Words


class Ledger(ABC):
    """Keeps account of known findings while the results of a check pass by."""

    @abstractmethod
    def watched(self, jobs: Sequence[Job], results: Iterable[CheckResult]) -> Iterator[CheckResult]:
        """The results of the jobs, as they are to be shown."""

    @abstractmethod
    def closed(self, language: Language) -> str:
        """What there is to say at the end, for people; FileUnreadableError where something cannot be written."""


class AgainstBaseline(Ledger):
    """Results held against a baseline: what is known and does not occur any more is counted."""

    def __init__(self) -> None:
        self._stale = 0

    def watched(self, jobs: Sequence[Job], results: Iterable[CheckResult]) -> Iterator[CheckResult]:
        """The results as they are. What a check could not look for may occur still."""
        for job, result in zip(jobs, results, strict=True):
            if result.coverage.is_complete:
                self._stale += len(job.known) - result.silenced.baseline
            yield result

    def closed(self, language: Language) -> str:
        """How many known findings are to go."""
        return Words(language)("findings.stale", n=self._stale) + "\n" if self._stale else ""


class Written(Ledger):
    """A baseline of all findings that there are: they are known from then on."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._baseline = Baseline(_placed(path))
        self._known: dict[str, Mapping[str, str]] = {}

    def watched(self, jobs: Sequence[Job], results: Iterable[CheckResult]) -> Iterator[CheckResult]:
        """The results without their findings, as the next check will show them."""
        for job, result in zip(jobs, results, strict=True):
            known = known_of(result)
            self._known[self._baseline.key(_placed(Path(job.name)))] = known
            yield without_known(result, frozenset(known))

    def closed(self, language: Language) -> str:
        """Write the baseline, whole or not at all; what was written."""
        from sim.base.files import staged

        path = self._baseline.path
        with staged(path.parent, (path.name,)) as folder:
            (folder / path.name).write_text(baseline_text(self._known), "ascii", newline="\n")
        n = sum(map(len, self._known.values()))
        return Words(language)("findings.baseline-written", path=printable(str(self._path)), n=n) + "\n"


def _placed(path: Path) -> Path:
    """A path without links but for its last part."""
    return path.parent.resolve() / path.name
