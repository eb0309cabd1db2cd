"""The loop of a decoder's process: a request in, a picture or a sentence out.

Started by path, ``python .../occsim/imaging/decode``, and not by name: the packages
around it would import numpy, OpenCV and SciPy first, and take ten times as long.

A message is a line of JSON and the bytes that it announces.
"""

import json
import os
import sys
from pathlib import Path
from types import ModuleType
from typing import Any, BinaryIO

FOLDER = Path(__file__).resolve().parent


def _leave_packages_out() -> None:
    """Put empty packages in place of those that lead to this folder."""
    folders = FOLDER.parents[1], FOLDER.parent, FOLDER
    names = "occsim", "occsim.imaging", "occsim.imaging.decode"
    for name, folder in zip(names, folders, strict=True):
        package = ModuleType(name)
        package.__path__ = [str(folder)]
        sys.modules[name] = package


def _own_pipes() -> tuple[BinaryIO, BinaryIO]:
    """Redirect standard input and output, so that no library prints to the pipe."""
    requests, replies = os.fdopen(os.dup(0), "rb"), os.fdopen(os.dup(1), "wb")
    nowhere = os.open(os.devnull, os.O_RDWR)
    os.dup2(nowhere, 0)
    os.dup2(nowhere, 1)
    return requests, replies


def serve(requests: BinaryIO, replies: BinaryIO) -> None:
    """Answer requests until there are no more.

    Parameters
    ----------
    requests, replies : binary file
        Where requests come from and replies go.
    """
    from occsim.imaging.decode.limits import Refused
    from occsim.imaging.decode.process import limit_time

    while line := requests.readline():
        request = json.loads(line)
        data = requests.read(request.pop("n_bytes"))
        limit_time()
        try:
            _answer(replies, data, **request)
        except Refused as error:
            _send(replies, {"refused": str(error)})
        del data
        replies.flush()


def _answer(replies: BinaryIO, data: bytes, task: str, **options: Any) -> None:
    from occsim.imaging.decode import images, pages

    if task == "count":
        _send(replies, {"n_pages": pages.count_pages(data, **options)})
        return
    make = images.decode_image if task == "image" else pages.render_page
    picture = make(data, **options)
    size = {"width": picture.width, "height": picture.height}
    _send(replies, size | {"orientation": picture.orientation})
    for strip in picture.strips:
        replies.write(strip.tobytes())


def _send(replies: BinaryIO, message: dict[str, Any]) -> None:
    from occsim.imaging.decode.process import is_spent

    message["is_spent"] = is_spent()
    replies.write(json.dumps(message).encode("ascii") + b"\n")


def main() -> None:
    """Limit this process and answer requests; an unexpected error ends it."""
    from occsim.imaging.decode.images import take_over_pillow
    from occsim.imaging.decode.process import limit_process

    pipes = _own_pipes()
    limit_process()
    take_over_pillow()
    try:
        _send(pipes[1], {"is_ready": True})
        pipes[1].flush()
        serve(*pipes)
    except (MemoryError, BrokenPipeError, KeyboardInterrupt):
        os._exit(1)


if __name__ == "__main__":
    _leave_packages_out()
    main()
