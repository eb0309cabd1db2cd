"""A class of students on one server: ``python -m tests.robust.load``.

Each client speaks the browser's own protocol, so that thirty fit on the machine that is
measured. It opens a page, moves sliders and thinks in between, and uploads a drawing
that nobody else has. A wait ends where the browser would show the page as finished.
"""

import argparse
import asyncio
import io
import os
import random
import tempfile
import time
from collections.abc import AsyncIterator, Awaitable
from contextlib import AsyncExitStack, asynccontextmanager, suppress
from dataclasses import dataclass, field
from pathlib import Path
from urllib.request import Request, urlopen

import numpy as np
import websockets
from PIL import Image
from streamlit.proto.Alert_pb2 import Alert
from streamlit.proto.BackMsg_pb2 import BackMsg
from streamlit.proto.Common_pb2 import FileURLs, UploadedFileInfo
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg

from tests.browser.running import running_app
from tests.robust import hostile

PAGE, TITLE = "Build_a_map", "Build a map"
THINK_S = (5.0, 15.0)
"""Shortest and longest time between two moves of one student."""

MOVES_A_ROUND = 4
SHAPE_PX = (600, 900)
PATIENCE_S = 60.0

HOSTILE = {
    "form-that-draws-itself.pdf": hostile.form_that_draws_itself,
    "tiles.pdf": hostile.tiling_pattern,
    "nested-forms.pdf": hostile.nested_forms,
    "segments.pdf": hostile.one_long_path,
    "scans.jpg": hostile.jpeg_of_many_scans,
}


def plan_png(seed: int) -> bytes:
    """A drawing of rooms, different for every seed."""
    rng = np.random.default_rng(seed)
    height, width = SHAPE_PX
    pixels = np.full(SHAPE_PX, 255, np.uint8)
    pixels[20 : height - 20, 20 : width - 20] = 0
    pixels[26 : height - 26, 26 : width - 26] = 255
    for _ in range(6):
        col, row = rng.integers(60, width - 60), rng.integers(60, height - 60)
        door = rng.integers(40, min(SHAPE_PX) - 100)
        pixels[26 : height - 26, col : col + 6] = 0
        pixels[row : row + 6, 26 : width - 26] = 0
        pixels[door : door + 40, col : col + 6] = 255
        pixels[row : row + 6, door : door + 40] = 255
    out = io.BytesIO()
    Image.fromarray(pixels).save(out, "PNG")
    return out.getvalue()


@dataclass
class Client:
    """One student: an open connection and the widgets last seen on it."""

    url: str
    socket: websockets.ClientConnection
    rng: random.Random
    widgets: dict[str, tuple[str, object]] = field(default_factory=dict)
    uploaded: FileURLs | None = None
    page_hash: str = ""
    refused: str = ""

    async def _run(self, message: BackMsg) -> None:
        """Send an event and wait until the script that it starts has ended."""
        self.refused = ""
        await self.socket.send(message.SerializeToString())
        started = False
        while True:
            answer = await self._next()
            match answer.WhichOneof("type"):
                case "new_session":
                    started = True
                    self.widgets = {}
                case "navigation":
                    self.page_hash = answer.navigation.page_script_hash
                case "delta":
                    self._see(answer)
                case "script_finished" if started:
                    return

    async def _next(self) -> ForwardMsg:
        data = await asyncio.wait_for(self.socket.recv(), PATIENCE_S)
        return ForwardMsg.FromString(data)

    def _see(self, message: ForwardMsg) -> None:
        element = message.delta.new_element
        kind = element.WhichOneof("type")
        if kind in ("slider", "file_uploader"):
            widget = getattr(element, kind)
            self.widgets[widget.label] = kind, widget
        if kind == "heading" and element.heading.body != TITLE:
            raise AssertionError(f"the page is {element.heading.body}")
        if kind == "exception":
            raise AssertionError(element.exception.message)
        if kind == "alert" and element.alert.format == Alert.ERROR:
            self.refused = element.alert.body

    def _event(self) -> BackMsg:
        message = BackMsg()
        message.rerun_script.page_script_hash = self.page_hash
        return message

    async def open(self) -> None:
        """Open the page as a deep link does."""
        message = BackMsg()
        message.rerun_script.page_name = PAGE
        await self._run(message)

    async def move_slider(self) -> None:
        """Put one of the map's sliders somewhere else."""
        sliders = [one for kind, one in self.widgets.values() if kind == "slider"]
        slider = self.rng.choice(sliders)
        steps = round((slider.max - slider.min) / slider.step)
        message = self._event()
        state = message.rerun_script.widget_states.widgets.add(id=slider.id)
        place = slider.min + slider.step * self.rng.randint(0, min(steps, 20))
        state.double_array_value.data.append(place)
        await self._run(message)

    async def upload(self, name: str, data: bytes) -> None:
        """Put a file into the page's uploader of drawings."""
        urls = await self._ask_urls(name)
        await asyncio.to_thread(self._http, "PUT", urls.upload_url, name, data)
        if self.uploaded is not None:
            old = self.uploaded.delete_url
            await asyncio.to_thread(self._http, "DELETE", old, name)
        self.uploaded = urls
        message = self._event()
        state = message.rerun_script.widget_states.widgets.add(
            id=self.widgets["Drawing"][1].id
        )
        file = UploadedFileInfo(
            file_id=urls.file_id, name=name, size=len(data), file_urls=urls
        )
        state.file_uploader_state_value.uploaded_file_info.append(file)
        await self._run(message)

    async def _ask_urls(self, name: str) -> FileURLs:
        message = BackMsg()
        message.file_urls_request.request_id = name
        message.file_urls_request.file_names.append(name)
        await self.socket.send(message.SerializeToString())
        while True:
            answer = await self._next()
            if answer.WhichOneof("type") == "file_urls_response":
                return answer.file_urls_response.file_urls[0]

    def _http(self, method: str, path: str, name: str, data: bytes = b"") -> None:
        edge, headers = "load", {"Cookie": COOKIE, "X-Xsrftoken": TOKEN}
        body = None
        if data:
            part = f'Content-Disposition: form-data; name="file"; filename="{name}"'
            body = f"--{edge}\r\n{part}\r\n\r\n".encode() + data
            body += f"\r\n--{edge}--\r\n".encode()
            headers["Content-Type"] = f"multipart/form-data; boundary={edge}"
        request = Request(self.url + path, body, headers, method=method)
        with urlopen(request, timeout=PATIENCE_S):
            pass


# A token of the client's own choice: cookie and header only have to agree.
TOKEN = "6c6f6164"
COOKIE = f"_streamlit_xsrf={TOKEN}"


@asynccontextmanager
async def client_at(url: str, seed: int) -> AsyncIterator[Client]:
    """A connected client."""
    async with websockets.connect(
        url.replace("http", "ws") + "/_stcore/stream",
        subprotocols=["streamlit", TOKEN],
        origin=url,
        additional_headers={"Cookie": COOKIE},
        max_size=None,
    ) as socket:
        yield Client(url, socket, random.Random(seed))


async def seconds_of(action: Awaitable[None]) -> float:
    start = time.perf_counter()
    await action
    return time.perf_counter() - start


@dataclass
class Times:
    """Waits of one round, s."""

    slider: list[float] = field(default_factory=list)
    upload: list[float] = field(default_factory=list)


def share_below(times: list[float], percent: int) -> float:
    """A percentile; nan of nothing."""
    return float(np.percentile(times, percent)) if times else float("nan")


def resident_mb(pid: int) -> float:
    """Memory of a process and those that it started, MB; 0 where none is stated."""
    total = 0
    for one in [pid, *children(pid)]:
        with suppress(OSError):
            total += int(Path(f"/proc/{one}/statm").read_text().split()[1])
    return total * os.sysconf("SC_PAGE_SIZE") / 1e6


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


async def student(client: Client, number: int, times: Times) -> None:
    """One round of one student."""
    for move in range(MOVES_A_ROUND):
        await asyncio.sleep(client.rng.uniform(*THINK_S))
        times.slider.append(await seconds_of(client.move_slider()))
        if move == MOVES_A_ROUND // 2:
            await asyncio.sleep(client.rng.uniform(*THINK_S))
            data = plan_png(number)
            times.upload.append(await seconds_of(client.upload("plan.png", data)))
            if client.refused:
                raise AssertionError(client.refused)


async def attack(client: Client, sliders: list[Client]) -> None:
    """Give the server one hostile file after another while others move sliders."""
    for name, make in HOSTILE.items():
        data, times, done = make(), Times(), asyncio.Event()

        async def move(one: Client, times=times, done=done) -> None:
            while not done.is_set():
                await asyncio.sleep(one.rng.uniform(0.2, 1.0))
                times.slider.append(await seconds_of(one.move_slider()))

        moving = [asyncio.create_task(move(one)) for one in sliders]
        seconds = await seconds_of(client.upload(name, data))
        done.set()
        await asyncio.gather(*moving)
        assert client.refused
        print(
            f"{name}: refused in {seconds:.1f} s; sliders of {len(sliders)} others "
            f"p95 {share_below(times.slider, 95):.2f} s ({len(times.slider)} moves)",
            flush=True,
        )


async def measure(url: str, n_clients: int, n_rounds: int, n_watching: int) -> None:
    """Run all rounds and print a line for each."""
    pid = server_at(url)
    async with AsyncExitStack() as stack:
        clients = [
            await stack.enter_async_context(client_at(url, seed))
            for seed in range(n_clients)
        ]
        opened = await asyncio.gather(*(seconds_of(one.open()) for one in clients))
        print(f"open: p95 {share_below(opened, 95):.2f} s", flush=True)
        for turn in range(n_rounds):
            times = Times()
            await asyncio.gather(
                *(
                    student(one, turn * n_clients + place, times)
                    for place, one in enumerate(clients)
                )
            )
            print(
                f"round {turn + 1}: slider p50 {share_below(times.slider, 50):.2f} s, "
                f"p95 {share_below(times.slider, 95):.2f} s; upload p50 "
                f"{share_below(times.upload, 50):.2f} s, p95 "
                f"{share_below(times.upload, 95):.2f} s; server {resident_mb(pid):.0f} "
                f"MB; machine {os.getloadavg()[0]:.1f} busy",
                flush=True,
            )
        if n_watching:
            await attack(clients[0], clients[1 : 1 + n_watching])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--clients", type=int, default=30)
    parser.add_argument("--rounds", type=int, default=10)
    parser.add_argument(
        "--hostile",
        type=int,
        default=0,
        metavar="N",
        help="afterwards upload hostile files while N clients move sliders",
    )
    parser.add_argument("--url", help="a server on this machine; one is started else")
    args = parser.parse_args()
    what = args.clients, args.rounds, args.hostile
    if args.url:
        asyncio.run(measure(args.url, *what))
        return
    with tempfile.TemporaryDirectory() as folder:
        log = Path(folder) / "server.log"
        with running_app(log) as url:
            asyncio.run(measure(url, *what))
        print(log.read_text()[-3000:] if "Traceback" in log.read_text() else "", end="")


if __name__ == "__main__":
    main()
