"""What the server takes of this machine, read from Linux's ``/proc``."""

from contextlib import suppress
from pathlib import Path


def memory_mb(pid: int) -> float:
    """Memory of a process and those that it started, MB; 0 where none is stated.

    Pages that several of them share, such as those of libraries, count once.
    """
    total_kb = 0
    for one in [pid, *children(pid)]:
        with suppress(OSError):
            lines = Path(f"/proc/{one}/smaps_rollup").read_text().splitlines()
            total_kb += sum(int(s.split()[1]) for s in lines if s.startswith("Pss:"))
    return 1024 * total_kb / 1e6


def children(pid: int) -> list[int]:
    """The processes that any thread of a process started."""
    found = []
    for task in Path(f"/proc/{pid}/task").glob("*/children"):
        with suppress(OSError):
            found += map(int, task.read_text().split())
    return found


def server_at(url: str) -> int:
    """The process that listens at an address on this machine."""
    port = url.rpartition(":")[2]
    for folder in Path("/proc").glob("[0-9]*"):
        with suppress(OSError):
            words = (folder / "cmdline").read_bytes().split(b"\0")
            if b"--server.port" in words and port.encode() in words:
                return int(folder.name)
    raise RuntimeError(f"no server at {url}")
