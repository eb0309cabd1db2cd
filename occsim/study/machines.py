"""Work spread over processes of this machine, or over a Dask cluster.

Jobs are taken from an iterator only as fast as they are worked on, so that thousands of
them never stand in memory together. A job that fails, or that ends its process, gives a
`Failure`, and the others go on.
"""

import signal
import warnings
from collections import deque
from collections.abc import Callable, Generator, Iterable, Iterator
from concurrent.futures import FIRST_COMPLETED, Future, ProcessPoolExecutor, wait
from concurrent.futures.process import BrokenProcessPool
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from itertools import islice
from multiprocessing import get_context
from typing import TYPE_CHECKING, Any, TypeVar

import cv2

from occsim._extras import needs_extra
from occsim._version import __version__
from occsim.errors import OccsimError, ParameterError, whole_number

if TYPE_CHECKING:
    from distributed import Client

MOST_PROCESSES = 1024

AHEAD = 2
"""Jobs handed out for each worker: one that it works on and the next one."""

NEW_WORKERS_S = 5.0
"""How often a cluster is asked for its size, s: workers come and go."""

CONNECT_S = 20
"""Longest wait for a cluster's scheduler, s."""

J = TypeVar("J")
R = TypeVar("R")


@dataclass(frozen=True, slots=True)
class Failure:
    """Why a job gave no result, in one sentence."""

    reason: str


@dataclass(frozen=True, kw_only=True, slots=True)
class Machines:
    """What works on the jobs.

    Parameters
    ----------
    processes : int, default 1
        Processes on this machine, 1 or more; 1 is this process itself.
    dask : str, optional
        Address of a Dask scheduler, ``"tcp://host:8786"``; then its workers work. They
        need the same release of occsim. A worker that is lost costs only the jobs that
        it held: others do them.

    Raises
    ------
    ParameterError
        Where the number lies outside its domain.

    Examples
    --------
    >>> from occsim.study import Machines
    >>> Machines(processes=2).processes
    2
    """

    processes: int = 1
    dask: str | None = None

    def __post_init__(self) -> None:
        n = whole_number("processes", self.processes, 1, MOST_PROCESSES)
        object.__setattr__(self, "processes", n)


def spread(
    work: Callable[[J], R], jobs: Iterable[J], machines: Machines
) -> Iterator[tuple[J, R | Failure]]:
    """Yield every job with its result, in the order in which they are done.

    Parameters
    ----------
    work : callable
        A function of a module: it is named, not sent, to other processes.
    jobs : iterable
        Values that can be pickled; asked for as late as possible.
    machines : Machines
        What works on them.

    Yields
    ------
    job, result
        Or a `Failure` in place of the result.

    Raises
    ------
    ParameterError
        Where the cluster cannot be reached, or is lost.
    ImportError
        Where the extra ``cluster`` is needed and not installed.

    Notes
    -----
    With several processes, the script that calls this must be importable: its own
    code stands under ``if __name__ == "__main__":``.

    Examples
    --------
    >>> from occsim.study.machines import Machines, spread
    >>> list(spread(len, ["a", "bcd"], Machines()))
    [('a', 1), ('bcd', 3)]
    """
    if machines.dask is not None:
        return _on_cluster(work, iter(jobs), machines.dask)
    if machines.processes == 1:
        return ((job, _attempt(work, job)) for job in jobs)
    return _in_processes(work, iter(jobs), machines.processes)


def _attempt(work: Callable[[J], R], job: J) -> R | Failure:
    try:
        return work(job)
    except OccsimError as error:
        return Failure(str(error))
    except Exception as error:  # one drawing must not end the study of thousands
        return Failure(f"it could not be computed ({type(error).__name__}: {error})")


# --- Processes ------------------------------------------------------------------------

LOST_PROCESS = "the process that worked on it ended; it may have run out of memory"


@contextmanager
def _pool(processes: int) -> Iterator[ProcessPoolExecutor]:
    # Not forked: a copy of a process with threads may hang.
    pool = ProcessPoolExecutor(processes, get_context("spawn"), _set_up_process)
    try:
        yield pool
    finally:
        pool.shutdown(wait=False, cancel_futures=True)


def _set_up_process() -> None:
    # Every process has one core. Ctrl-C is for the one that started them.
    cv2.setNumThreads(1)
    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _in_processes(
    work: Callable[[J], R], jobs: Iterator[J], processes: int
) -> Generator[tuple[J, R | Failure], None, None]:
    lost: deque[J] = deque()
    while True:
        lost.clear()
        with _pool(processes) as pool:
            is_done = yield from _until_broken(pool, processes, work, jobs, lost)
        # Which of them ended its process is not known: alone, each shows it.
        for job in lost:
            with _pool(1) as pool:
                yield job, _alone(pool, work, job)
        if is_done:
            return


def _until_broken(
    pool: ProcessPoolExecutor,
    processes: int,
    work: Callable[[J], R],
    jobs: Iterator[J],
    lost: deque[J],
) -> Generator[tuple[J, R | Failure], None, bool]:
    """Yield outcomes until no job is left or the pool is broken; put what it held away.

    Returns whether no job is left.
    """
    held: dict[Future[R | Failure], J] = {}
    while True:
        try:
            for job in islice(jobs, AHEAD * processes - len(held)):
                lost.append(job)
                held[pool.submit(_attempt, work, job)] = lost.pop()
            if not held:
                return True
            done, _ = wait(held, return_when=FIRST_COMPLETED)
            for future in done:
                outcome = future.result()
                yield held.pop(future), outcome
        except BrokenProcessPool:
            lost.extend(held.values())
            return False


def _alone(pool: ProcessPoolExecutor, work: Callable[[J], R], job: J) -> R | Failure:
    try:
        return pool.submit(_attempt, work, job).result()
    except BrokenProcessPool:
        return Failure(LOST_PROCESS)


# --- A Dask cluster -------------------------------------------------------------------

LOST_WORKER = "the workers that worked on it ended; they may have run out of memory"


def _on_cluster(
    work: Callable[[J], R], jobs: Iterator[J], address: str
) -> Generator[tuple[J, R | Failure], None, None]:
    with needs_extra("cluster", "a Dask cluster"):
        from distributed import wait as wait_for
    with _client(address) as client:
        held: dict[Any, J] = {}
        while True:
            ahead = AHEAD * max(sum(client.nthreads().values()), 1)
            for job in islice(jobs, max(ahead - len(held), 0)):
                args = (__version__, work, job)
                held[client.submit(_attempt_of, *args, pure=False)] = job
            if not held:
                return
            # In time for workers that have joined meanwhile.
            with suppress(TimeoutError):
                wait_for(list(held), NEW_WORKERS_S, "FIRST_COMPLETED")
            for future in [one for one in held if one.done()]:
                yield held.pop(future), _result_of(future, address)


@contextmanager
def _client(address: str) -> Iterator["Client"]:
    from distributed import Client

    try:
        client = Client(address, timeout=CONNECT_S, set_as_default=False)
    except (OSError, ValueError, TypeError) as error:
        raise ParameterError(
            f"no Dask scheduler answers at {address!r} ({type(error).__name__})"
        ) from None
    with client, client.as_current(), warnings.catch_warnings():
        # The files of a drawing go with its job: nothing is lost with a worker.
        warnings.filterwarnings("ignore", "Sending large graph")
        try:
            client.wait_for_workers(1, timeout=CONNECT_S)
        except TimeoutError:
            raise ParameterError(
                f"the Dask cluster at {address!r} has no worker"
            ) from None
        yield client


def _result_of(future: Any, address: str) -> Any:
    from distributed import CancelledError, KilledWorker

    try:
        return future.result()
    except KilledWorker:
        return Failure(LOST_WORKER)
    except CancelledError:
        raise ParameterError(
            f"the connection to the Dask scheduler at {address!r} was lost; run the "
            "same command again to continue"
        ) from None
    except Exception as error:  # of the worker's own, before it comes to the job
        return Failure(f"a worker could not start ({type(error).__name__}: {error})")


def _attempt_of(version: str, work: Callable[[J], R], job: J) -> R | Failure:
    if __version__ != version:
        return Failure(f"a worker has occsim {__version__}; {version} is needed")
    return _attempt(work, job)
