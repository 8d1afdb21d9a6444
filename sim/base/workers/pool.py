"""What a pool of workers is: where jobs are done, how many may be handed over at once, and how a death is told."""

from concurrent.futures import Executor
from contextlib import AbstractContextManager
from typing import Protocol


class Pool(Protocol):
    """Workers that do jobs.

    Attributes
    ----------
    died
        Errors of a future whose worker died. Of the jobs that were under way then nobody knows which one killed it.
    is_here
        Whether the workers run on this machine: then they see its files, and are made of the same.
    """

    died: tuple[type[BaseException], ...]
    is_here: bool

    def ahead(self) -> int:
        """How many jobs may be under way at once, so that no worker waits and few results are held."""

    def open(self, *, alone: bool = False) -> AbstractContextManager[Executor]:
        """The workers, for as long as the context lasts; with `alone` one of them, or as good as one.

        Where the context ends by an error, what is under way is dropped.
        """
