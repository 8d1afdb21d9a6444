"""Workers of other machines: those of a Dask scheduler (https://distributed.dask.org), the extra ``cluster``.

Dask does a job again on another worker where one dies, and gives it up as `KilledWorker` when four died at it
(``distributed.scheduler.allowed-failures``). A worker dies as well where it cannot read what it is handed; so it gets
bytes, and a function that makes a job of them and is sent as it stands: one without drycut then says so.
"""

import logging
import pickle
import re
from collections.abc import Callable, Iterator
from concurrent.futures import CancelledError, Executor, Future
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, Final

from parser.findings.errors import ClusterError

if TYPE_CHECKING:
    from sim.base.workers.rounds import Pool

MOST_WAIT_S: Final = 15
_AHEAD_EACH: Final = 2  # one that a thread does, and one that is there when it is done
_ADDRESS: Final = re.compile(r"(tcp|tls|ws|wss)://[^/]+:\d+")


@contextmanager
def cluster(address: str) -> Iterator["Pool"]:
    """The workers of a scheduler, as long as the context lasts.

    ClusterError where there is no scheduler, where it has no workers, where it is lost on the way, and where one of
    them has no drycut.
    """
    client = _client(address)
    try:
        try:
            client.wait_for_workers(1, timeout=MOST_WAIT_S)
        except TimeoutError:
            raise ClusterError("scheduler-without-workers", address=address, seconds=MOST_WAIT_S) from None
        yield _Cluster(client)
    except ImportError as error:
        raise ClusterError("worker-without-drycut", address=address, why=str(error)) from None
    except CancelledError:
        raise ClusterError("scheduler-lost", address=address) from None
    finally:
        client.close()


def _client(address: str) -> Any:
    if not _ADDRESS.fullmatch(address):
        raise ClusterError("no-scheduler-address", address=address)
    try:
        from distributed import Client  # noqa: PLC0415 - an extra, which takes half a second to load
    except ImportError:
        raise ClusterError("no-cluster-extra") from None
    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # what is lost is told here
    try:
        return Client(address, timeout=MOST_WAIT_S, set_as_default=False)
    except (OSError, ValueError) as error:
        raise ClusterError("scheduler-silent", address=address, why=str(error)) from None


class _Cluster:
    """A `Pool` of the workers that a scheduler has at any moment; they may come and go."""

    is_here = False

    def __init__(self, client: Any) -> None:
        from distributed.scheduler import KilledWorker  # noqa: PLC0415 - as above

        self._client = client
        self.died: tuple[type[BaseException], ...] = (KilledWorker,)

    def ahead(self) -> int:
        """Jobs under way at once: some for each thread that there is now."""
        threads: dict[str, int] = self._client.nthreads()
        return _AHEAD_EACH * max(1, sum(threads.values()))

    @contextmanager
    def open(self, *, alone: bool = False) -> Iterator[Executor]:
        """The workers; which of them does a job is the scheduler's to say, also where one job is handed over alone."""
        executor: Executor = self._client.get_executor(pure=False)
        try:
            yield _AsBytes(executor)
        except BaseException:
            executor.shutdown(wait=False)
            raise


class _AsBytes(Executor):
    """Hands jobs to another executor as bytes."""

    def __init__(self, executor: Executor) -> None:
        self._executor = executor

    def submit(self, fn: Callable[..., Any], /, *args: Any, **kwargs: Any) -> Future[Any]:
        """Hand over a call of a function of a module. ImportError where the worker does not have it."""
        return self._executor.submit(_caller(), pickle.dumps((fn, args, kwargs)))


def _caller() -> Callable[[bytes], Any]:
    """What makes a call of bytes: a function within one, which is sent by its code and not by its name."""

    def called(data: bytes) -> Any:
        import pickle  # noqa: PLC0415 - nothing of this module is there
        import platform  # noqa: PLC0415

        try:
            function, args, kwargs = pickle.loads(data)  # noqa: S301 - Dask itself sends nothing else
        except Exception as error:
            found = f"{platform.node()} has another drycut, or none: install the one that runs here ({error})"
            raise ImportError(found) from None
        return function(*args, **kwargs)

    return called
