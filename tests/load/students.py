"""What a class does: all the same for a while, then each with a drawing of its own."""

import asyncio
import io
import random
from collections import defaultdict
from collections.abc import Awaitable
from dataclasses import dataclass, field

import numpy as np
from PIL import Image

from tests.load.client import Client, seconds_of

SHAPE_PX = (600, 900)
SLIDERS = ("Range", "Field of view", "Cell size")
MAP, HOME, LENS, TWO_MAPS = "Build_a_map", "", "What_the_sensor_says", "Two_maps"

OPEN_HOME, OPEN_LENS, OPEN_TWO = "home", "lens", "two maps"
OPEN_MAP, CHOOSE, UPLOAD = "build a map", "choose a drawing", "upload"
SAME, OWN = "slider, all the same", "slider, all different"
ACTIONS = (OPEN_HOME, OPEN_LENS, OPEN_TWO, OPEN_MAP, CHOOSE, SAME, UPLOAD, OWN)


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
class Round:
    """One round of all students: what each action took, s, and how long they think."""

    number: int
    think_s: tuple[float, float]
    seconds: dict[str, list[float]] = field(default_factory=lambda: defaultdict(list))

    async def time(self, client: Client, what: str, action: Awaitable[None]) -> None:
        """Wait as a student thinks, then do something and note what it took."""
        await asyncio.sleep(client.rng.uniform(*self.think_s))
        self.seconds[what].append(await seconds_of(action))
        if client.refused:
            raise AssertionError(f"{what}: {client.refused}")

    async def student(self, client: Client, place: int) -> None:
        """All that one student does in a round."""
        told = random.Random(self.number)  # by the teacher: the same for all
        await self.time(client, OPEN_HOME, client.open(HOME))
        await self.time(client, OPEN_LENS, client.open(LENS))
        await self.time(client, OPEN_TWO, client.open(TWO_MAPS))
        await self.time(client, OPEN_MAP, client.open(MAP))
        await self.time(client, CHOOSE, choose(client, told.choice("abcde")))
        for _ in range(2):
            await self.time(client, SAME, slide(client, told))
        plan = plan_png(1000 * self.number + place)
        await self.time(client, UPLOAD, client.upload("plan.png", plan))
        for _ in range(2):
            await self.time(client, OWN, slide(client, client.rng))


async def choose(client: Client, sample: str) -> None:
    """Choose a reference drawing; a class that is told to choose finds it chosen."""
    await client.choose("Drawing", f"{sample}:")


async def slide(client: Client, rng: random.Random) -> None:
    """Move one of the map's sliders, not beyond what is simulated within a second."""
    await client.slide(rng.choice(SLIDERS), rng.uniform(0.05, 0.3))
