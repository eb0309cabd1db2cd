"""One student's connection, in the protocol that the browser speaks.

A browser takes hundreds of megabytes; thirty of these fit on the machine that is
measured. A wait ends where the browser would show the page as finished.
"""

import asyncio
import random
import time
from collections.abc import AsyncIterator, Awaitable, Callable, Mapping
from contextlib import asynccontextmanager
from dataclasses import dataclass, field
from typing import Any
from urllib.request import Request, urlopen

import websockets
from streamlit.proto.Alert_pb2 import Alert
from streamlit.proto.BackMsg_pb2 import BackMsg
from streamlit.proto.Common_pb2 import FileURLs, UploadedFileInfo
from streamlit.proto.ForwardMsg_pb2 import ForwardMsg
from streamlit.proto.WidgetStates_pb2 import WidgetState

PATIENCE_S = 60.0

# A token of the client's own choice: cookie and header only have to agree.
TOKEN = "6c6f6164"
COOKIE = f"_streamlit_xsrf={TOKEN}"

FRAMES = ("slider", "selectbox", "file_uploader")


@dataclass
class Client:
    """An open connection and the widgets last seen on it."""

    url: str
    socket: websockets.ClientConnection
    rng: random.Random
    widgets: dict[str, Any] = field(default_factory=dict)
    components: set[str] = field(default_factory=set)
    pages: Mapping[str, str] = field(default_factory=dict)
    uploaded: FileURLs | None = None
    page_hash: str = ""
    refused: str = ""
    n_bytes: int = 0
    """Received by the last action."""

    async def open(self, page: str) -> None:
        """Open a page: by its address at first, then by its link on the page."""
        message = BackMsg()
        if self.pages:
            message.rerun_script.page_script_hash = self.pages[page]
        else:
            message.rerun_script.page_name = page
        await self._run(message)
        if self.pages[page] != self.page_hash:
            raise AssertionError(f"asked for {page or 'home'}, got another page")

    async def slide(self, label: str, share: float) -> None:
        """Put a slider at a share of its way."""
        slider = self.widget(label, "slider")
        n_steps = round((slider.max - slider.min) / slider.step)
        place = slider.min + slider.step * round(share * n_steps)
        await self._set(slider.id, lambda to: to.double_array_value.data.append(place))

    async def choose(self, label: str, start: str) -> None:
        """Choose the option of a list that begins with some letters."""
        box = self.widget(label, "selectbox")
        [option] = [one for one in box.options if one.startswith(start)]
        await self._set(box.id, lambda to: setattr(to, "string_value", option))

    async def upload(self, name: str, data: bytes) -> None:
        """Put a file into the page's uploader of drawings."""
        urls = await self._ask_urls(name)
        await asyncio.to_thread(self._http, "PUT", urls.upload_url, name, data)
        if self.uploaded is not None:
            old = self.uploaded.delete_url
            await asyncio.to_thread(self._http, "DELETE", old, name)
        self.uploaded = urls
        file = UploadedFileInfo(
            file_id=urls.file_id, name=name, size=len(data), file_urls=urls
        )
        await self._set(
            self.widget("Drawing", "file_uploader").id,
            lambda to: to.file_uploader_state_value.uploaded_file_info.append(file),
        )

    def widget(self, label: str, kind: str) -> Any:
        """The widget of a kind whose label begins so."""
        for (one_kind, text), widget in self.widgets.items():
            if one_kind == kind and text.startswith(label):
                return widget
        raise AssertionError(f"no {kind} {label} on this page")

    async def _set(self, widget_id: str, fill: Callable[[WidgetState], None]) -> None:
        message = BackMsg()
        message.rerun_script.page_script_hash = self.page_hash
        fill(message.rerun_script.widget_states.widgets.add(id=widget_id))
        await self._run(message)

    async def _run(self, message: BackMsg) -> None:
        """Send an event and wait until the script that it starts has ended."""
        self.refused, self.n_bytes = "", 0
        await self.socket.send(message.SerializeToString())
        started = False
        while True:
            answer = await self._next()
            match answer.WhichOneof("type"):
                case "new_session":
                    started = True
                    self.widgets, self.components = {}, set()
                case "navigation":
                    self.page_hash = answer.navigation.page_script_hash
                    self.pages = {
                        page.url_pathname: page.page_script_hash
                        for page in answer.navigation.app_pages
                    }
                case "delta":
                    self._see(answer)
                case "script_finished" if started:
                    return

    async def _next(self) -> ForwardMsg:
        data = await asyncio.wait_for(self.socket.recv(), PATIENCE_S)
        self.n_bytes += len(data)
        return ForwardMsg.FromString(data)

    def _see(self, message: ForwardMsg) -> None:
        element = message.delta.new_element
        kind = element.WhichOneof("type")
        if kind in FRAMES:
            widget = getattr(element, kind)
            self.widgets[kind, widget.label] = widget
        if kind == "bidi_component":
            self.components.add(element.bidi_component.component_name)
        if kind == "exception":
            raise AssertionError(element.exception.message)
        if kind == "alert" and element.alert.format == Alert.ERROR:
            self.refused = element.alert.body

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
    """How long an action takes, s."""
    start = time.perf_counter()
    await action
    return time.perf_counter() - start
