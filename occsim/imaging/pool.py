"""Separate processes that decode files, so that no file can crash or block this one.

PDFium and the image libraries limit neither memory nor time: a PDF of 694 bytes can
take 7 GB and crash the process. So they run in a few separate processes, which are
started on first use, decode one file after another, and are replaced when they crash.
Memory is bounded by the system on Linux, by the process itself on macOS, and on Windows
only by the sizes in a file's header; time is bounded everywhere.

They are plain subprocesses that run one folder of this package: the caller's own script
is not imported again, as `multiprocessing` would, and needs no ``__main__`` guard.
"""

import atexit
import contextlib
import json
import os
import signal
import subprocess
import sys
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np

from occsim._types import ByteArray
from occsim.errors import DrawingError
from occsim.imaging.decode.limits import MAX_MEMORY_BYTES, MAX_SECONDS, MAX_WALL_SECONDS

MAX_PROCESSES = 4
"""Most decoders at a time; an idle one takes about 40 MB."""

MAX_WAIT_S = 30.0
"""Longest wait for a free decoder, s."""

DECODER = Path(__file__).with_name("decode") / "__main__.py"

OUT_OF_TIME = getattr(signal, "SIGXCPU", 0)

NOT_STARTED = "no process can be started to decode drawings in"

Reply = dict[str, Any]


class Decoder:
    """One process, and the pipes to it."""

    def __init__(self) -> None:
        # Packages are found on this process's path; `site` is skipped: it is slow.
        folders = os.pathsep.join(folder or os.getcwd() for folder in sys.path)
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-S", "-B", str(DECODER)],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            # One thread: more would reserve address space without being faster.
            env=os.environ | {"PYTHONPATH": folders, "OPENBLAS_NUM_THREADS": "1"},
            creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),
        )
        self._requests: Any = self._process.stdin
        self._replies: Any = self._process.stdout
        self._is_ready = self._is_late = self._is_spent = False

    @property
    def is_fit(self) -> bool:
        """Whether the process can take another file."""
        is_over = self._is_late or self._is_spent
        return not is_over and self._process.poll() is None

    def answer(self, data: bytes, request: Reply) -> tuple[Reply, ByteArray]:
        """Return the reply to a request, and the pixels that it announces.

        Parameters
        ----------
        data : bytes
            A file's content.
        request : dict
            What to do with it, as ``decode/__main__.py`` reads it.

        Returns
        -------
        reply : dict
        pixels : ndarray of uint8, shape (H, W, 3)
            Empty where the reply has none.

        Raises
        ------
        DrawingError
            Where the process does not start.
        EOFError
            Where the process crashes.
        TimeoutError
            Where the process does not finish in time.
        """
        timer = threading.Timer(MAX_WALL_SECONDS, self._be_late)
        timer.daemon = True
        timer.start()
        try:
            return self._exchange(data, request)
        except (OSError, EOFError):
            if self._is_late or self._ran_out_of_time():
                raise TimeoutError from None
            if not self._is_ready:
                raise DrawingError(NOT_STARTED) from None
            raise EOFError from None
        finally:
            timer.cancel()
            timer.join()  # else it might end a process that decodes the next file

    def _exchange(self, data: bytes, request: Reply) -> tuple[Reply, ByteArray]:
        line = json.dumps(request | {"n_bytes": len(data)})
        self._requests.write(line.encode("ascii") + b"\n")
        self._requests.write(data)
        self._requests.flush()
        if not self._is_ready:
            self._read_message()
            self._is_ready = True
        reply = self._read_message()
        self._is_spent = reply["is_spent"]
        shape = reply.get("height", 0), reply.get("width", 0), 3
        pixels = np.empty(shape, np.uint8)
        if self._replies.readinto(pixels) < pixels.size:
            raise EOFError
        return reply, pixels

    def _read_message(self) -> Reply:
        line = self._replies.readline()
        if not line.endswith(b"\n"):
            raise EOFError
        message: Reply = json.loads(line)
        return message

    def _ran_out_of_time(self) -> bool:
        """Return whether the system's limit of processor time ended the process."""
        with contextlib.suppress(subprocess.TimeoutExpired):
            return self._process.wait(timeout=1.0) == -OUT_OF_TIME
        return False

    def _be_late(self) -> None:
        self._is_late = True
        self._process.kill()

    def disown(self) -> None:
        """Leave the process to another owner."""
        self._requests.close()
        self._replies.close()
        self._process.returncode = 0  # not our child: it cannot be waited for

    def end(self) -> None:
        """End the process and wait for it, so that nothing of it is left."""
        self._process.kill()
        for pipe in (self._requests, self._replies):
            with contextlib.suppress(OSError):  # the unwritten rest of the request
                pipe.close()
        self._process.wait()


class Pool:
    """The decoders of this process."""

    def __init__(self) -> None:
        self._free = threading.BoundedSemaphore(MAX_PROCESSES)
        self._idle: list[Decoder] = []

    def answer(self, data: bytes, name: str, **request: Any) -> tuple[Reply, ByteArray]:
        """Return a decoder's reply for a file, as `Decoder.answer` does.

        Parameters
        ----------
        data : bytes
            The file's content.
        name : str
            What to call it.
        **request
            What to do with it.

        Returns
        -------
        reply : dict
        pixels : ndarray of uint8, shape (H, W, 3)
            Empty where the reply has none.

        Raises
        ------
        DrawingError
            Where the decoder refuses the file, crashes, takes too much memory or too
            long, or where no decoder is free.
        """
        try:
            with self._decoder() as decoder:
                reply, pixels = decoder.answer(data, request | {"name": name})
        except TimeoutError:
            raise DrawingError(
                f"{name} takes longer than {MAX_SECONDS} s to decode, more than a "
                "drawing may; export it again, as a PNG or a simpler PDF, or try again "
                "where the machine was busy"
            ) from None
        except EOFError:
            raise DrawingError(
                f"{name} breaks its decoder or takes more than "
                f"{MAX_MEMORY_BYTES / 1e6:.0f} MB of memory to decode, more than a "
                "drawing may; export it again, as a PNG or a simpler PDF"
            ) from None
        if "refused" in reply:
            raise DrawingError(reply["refused"])
        return reply, pixels

    @contextlib.contextmanager
    def _decoder(self) -> Iterator[Decoder]:
        """Lend a decoder; end it if it crashes or is interrupted."""
        if not self._free.acquire(timeout=MAX_WAIT_S):
            raise DrawingError(
                f"{MAX_PROCESSES} other files are being decoded, the most at a time; "
                "try again in a minute"
            )
        try:
            decoder = self._idle_or_new()
            try:
                yield decoder
            except BaseException:
                decoder.end()
                raise
            if decoder.is_fit:
                self._idle.append(decoder)
            else:
                decoder.end()
        finally:
            self._free.release()

    def _idle_or_new(self) -> Decoder:
        while self._idle:
            decoder = self._idle.pop()
            if decoder.is_fit:
                return decoder
            decoder.end()
        if getattr(sys, "frozen", False) or not sys.executable:
            raise DrawingError(NOT_STARTED)
        try:
            return Decoder()
        except OSError:
            raise DrawingError(NOT_STARTED) from None

    def end(self) -> None:
        """End idle decoders; the others end after their reply."""
        while self._idle:
            self._idle.pop().end()

    def forget(self) -> None:
        """Start with no decoders in a fork: the pipes belong to the parent process."""
        for decoder in self._idle:
            decoder.disown()
        self._free, self._idle = threading.BoundedSemaphore(MAX_PROCESSES), []


POOL = Pool()
atexit.register(POOL.end)
if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=POOL.forget)
