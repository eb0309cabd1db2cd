"""Processes that open uploaded files, so that sliders need not wait.

Python runs one thread at a time: half a second of wall detection and tour planning in
this process would stop everyone's sliders, and so would a robot's log.
`multiprocessing` would import the page of the student who asked into the new process,
so these are plain subprocesses. One is started on first use, works on one file after
another, and is replaced when it ends. A second one, of some 90 MB, is started where the
first is at work and there is a core for it.

Only this process talks to it, through pipes: what it unpickles is its own.
"""

import atexit
import contextlib
import os
import pickle
import queue
import subprocess
import sys
import threading
from collections.abc import Callable
from pathlib import Path
from typing import Any, TypeVar

from occsim import OccsimError
from occsim.building import Building, building_from_drawing
from occsim.imaging import Drawing
from pages._ui import memory

T = TypeVar("T")

ROOT = Path(__file__).resolve().parents[2]


class Worker:
    """One process, and the pipes to it; one caller at a time."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._lock = threading.Lock()

    def call(self, function: Callable[..., T], *args: object, **kwargs: object) -> T:
        """Return what a function of a module does, which must not import Streamlit.

        Raises
        ------
        OccsimError
            Where the function does.
        """
        with self._lock:
            try:
                made = self._exchange((function, args, kwargs))
            except (OSError, EOFError, pickle.UnpicklingError):
                self.end()
                made = None
        if made is None:  # no process can be started, or it was killed
            return function(*args, **kwargs)
        if isinstance(made, OccsimError):
            raise made
        return made

    def start_early(self) -> None:
        """Start the process, not waiting for it; its imports take a second."""
        if self._process is None and self._lock.acquire(blocking=False):
            try:
                with contextlib.suppress(
                    OSError
                ):  # said when a drawing is to be opened
                    self._running()
            finally:
                self._lock.release()

    def _running(self) -> Any:
        process = self._process
        if process is None or process.poll() is not None:
            self.end()
            process = self._process = self._started()
        return process

    def _exchange(self, request: object) -> Any:
        process = self._running()
        pickle.dump(request, process.stdin, pickle.HIGHEST_PROTOCOL)
        process.stdin.flush()
        return pickle.load(process.stdout)

    def _started(self) -> Any:
        folders = os.pathsep.join(folder or os.getcwd() for folder in sys.path)
        return subprocess.Popen(
            [sys.executable, "-m", "pages._ui.worker"],
            cwd=ROOT,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            env=os.environ | {"PYTHONPATH": folders, "OPENBLAS_NUM_THREADS": "1"},
        )

    def end(self) -> None:
        """End the process, if there is one."""
        process, self._process = self._process, None
        if process is not None:
            process.kill()
            for pipe in (process.stdin, process.stdout):
                with contextlib.suppress(OSError):  # the unwritten rest of a request
                    pipe.close()
            process.wait()


class Workers:
    """Some processes; a file goes to one that is free, or waits."""

    def __init__(self, count: int) -> None:
        self._all = [Worker() for _ in range(count)]
        # The last one used is taken first, so that none is started without need.
        self._free: queue.LifoQueue[Worker] = queue.LifoQueue()
        for worker in reversed(self._all):
            self._free.put(worker)

    def open_drawing(self, drawing: Drawing, working_px: int) -> Building:
        """Return what `building_from_drawing` does.

        Raises
        ------
        OccsimError
            Where the drawing is refused.
        """
        return self.call(building_from_drawing, drawing, working_px=working_px)

    def call(self, function: Callable[..., T], *args: object, **kwargs: object) -> T:
        """Return what a function of a module does; see `Worker.call`."""
        worker = self._free.get()
        try:
            return worker.call(function, *args, **kwargs)
        finally:
            self._free.put(worker)

    def start_early(self) -> None:
        """Start one process, not waiting for it; its imports take a second."""
        self._all[0].start_early()

    def end(self) -> None:
        """End the processes."""
        for worker in self._all:
            worker.end()


WORKERS = Workers(min(os.cpu_count() or 1, 2))
atexit.register(WORKERS.end)


def main() -> None:
    """Answer requests until the other process closes the pipe."""
    requests, replies = sys.stdin.buffer, sys.stdout.buffer
    while True:
        try:
            function, args, kwargs = pickle.load(requests)
        except EOFError:
            return
        try:
            made: object = function(*args, **kwargs)
        except OccsimError as error:
            made = error
        pickle.dump(made, replies, pickle.HIGHEST_PROTOCOL)
        replies.flush()
        del args, kwargs, made
        memory.return_freed()


if __name__ == "__main__":
    main()
