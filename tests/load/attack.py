"""Files that try to take the server down, while others move their sliders."""

import asyncio

import numpy as np

from tests.load.client import Client, seconds_of
from tests.load.students import MAP, slide
from tests.robust import hostile

HOSTILE = {
    "form-that-draws-itself.pdf": hostile.form_that_draws_itself,
    "tiles.pdf": hostile.tiling_pattern,
    "nested-forms.pdf": hostile.nested_forms,
    "segments.pdf": hostile.one_long_path,
    "scans.jpg": hostile.jpeg_of_many_scans,
}


async def attack(client: Client, others: list[Client]) -> None:
    """Give the server one hostile file after another, and print what it took."""
    for one in (client, *others):
        await one.open(MAP)
    for name, make in HOSTILE.items():
        data, times, done = make(), [], asyncio.Event()

        async def move(one: Client, times=times, done=done) -> None:
            while not done.is_set():
                await asyncio.sleep(one.rng.uniform(0.2, 1.0))
                times.append(await seconds_of(slide(one, one.rng)))

        moving = [asyncio.create_task(move(one)) for one in others]
        seconds = await seconds_of(client.upload(name, data))
        done.set()
        await asyncio.gather(*moving)
        assert client.refused
        p95 = np.percentile(times, 95) if times else np.nan
        print(
            f"{name}: refused in {seconds:.1f} s; sliders of {len(others)} others "
            f"p95 {p95:.2f} s ({len(times)} moves)",
            flush=True,
        )
