"""The clients of the load script reach the app as a browser does."""

import asyncio
from concurrent.futures import ThreadPoolExecutor

import pytest

from tests.browser.running import no_complaint, running_app
from tests.robust import load

pytestmark = pytest.mark.browser


def test_a_client_opens_a_page_moves_a_slider_and_uploads(tmp_path):
    log = tmp_path / "server.log"

    async def visit(url: str) -> None:
        async with load.client_at(url, seed=1) as client:
            await client.open()
            assert {"Range", "Drawing"} <= {
                name.partition(" (")[0] for name in client.widgets
            }
            await client.move_slider()
            await client.upload("plan.png", load.plan_png(1))
            assert client.refused == ""
            assert "Range (px)" in client.widgets  # the sample's scale is gone
            await client.upload("plan.pdf", b"%PDF-1.4 and no more")
            assert "plan.pdf" in client.refused.replace("\\", "")

    with running_app(log) as url, ThreadPoolExecutor(1) as pool:
        # In a thread of its own: another test's browser may have a loop running here.
        pool.submit(asyncio.run, visit(url)).result()
        pid = load.server_at(url)
        assert load.resident_mb(pid) > 100
        assert len(load.children(pid)) >= 1
    no_complaint(log)
