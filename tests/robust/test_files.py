"""Damaged and hostile files: each is refused in a sentence, in bounded time and
memory."""

import io
import os
import subprocess
import sys
import textwrap
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from occsim import DrawingError, load_drawing
from occsim.imaging import pool
from tests.robust import files, hostile

ROOT = Path(__file__).resolve().parents[2]
GOOD = files.good_files()
N_DAMAGED = 60
"""Of each format; `python -m tests.robust.files` takes any number."""

HOSTILE = {
    "a form that draws itself": hostile.form_that_draws_itself,
    "tiles closer than any pixel": hostile.tiling_pattern,
    "forms nested 8^7 times": hostile.nested_forms,
    "triangles of the page's size": hostile.shading_of_triangles,
    "a path of 2 million segments": hostile.one_long_path,
    "a JPEG of 3,000 scans": hostile.jpeg_of_many_scans,
}
BOMBS = {
    "png": hostile.png_bomb,
    "tiff": hostile.tiff_of_a_claimed_size,
    "ppm": lambda: b"P6 29000 29000 255\n" + bytes(1000),
    "bmp": lambda: hostile.bmp_of_a_claimed_size(29_000),
    "gif": lambda: hostile.gif_of_a_claimed_size(29_000),
    "jpeg": lambda: hostile.jpeg_of_a_claimed_size(29_000),
    "webp": lambda: hostile.image_bomb("WEBP", 10_000, 10_000),
}


@pytest.mark.parametrize("kind", GOOD)
def test_undamaged_files_are_read(kind):
    for data in GOOD[kind]:
        files.opener(kind)(data)


@pytest.mark.parametrize("kind", GOOD)
def test_damaged_files_are_read_or_refused_in_a_sentence(kind):
    assert files.faults(kind, GOOD[kind], N_DAMAGED, seed=1) == []


def refused(data: bytes) -> tuple[str, float]:
    """The error message for a file, and the time it took, s."""
    start = time.perf_counter()
    with pytest.raises(DrawingError) as caught:
        load_drawing(data, name="plan", max_side_px=2000)
    return str(caught.value), time.perf_counter() - start


def test_hostile_files_are_refused_while_others_are_served():
    """Each is bounded to 9.5 s, and one decoder of four stays free for other files."""
    with ThreadPoolExecutor(pool.MAX_PROCESSES - 1) as threads:
        waiting = {
            name: threads.submit(refused, make()) for name, make in HOSTILE.items()
        }
        n_served = 0
        while not all(one.done() for one in waiting.values()):
            assert load_drawing(GOOD["jpeg"][0]).shape == (60, 80)
            n_served += 1
            time.sleep(0.2)
    assert n_served > 3
    for name, one in waiting.items():
        said, seconds = one.result()
        assert "decode" in said, name
        assert seconds < 12, name


@pytest.mark.parametrize("kind", BOMBS)
def test_decompression_bombs_are_refused_by_their_header(kind):
    said, seconds = refused(BOMBS[kind]())
    assert "MB are allowed" in said or "megapixels" in said or "decode" in said
    assert seconds < 5


def test_cad_sheet_of_300_000_lines_is_read(monkeypatch):
    """It takes 1.5 s of the processor; of a busy machine's clock it may take more."""
    monkeypatch.setattr(pool, "MAX_WALL_SECONDS", 60.0)
    drawing = load_drawing(hostile.cad_sheet(), max_side_px=1500)
    assert drawing.shape == (1000, 1500)
    assert drawing.gray.mean() < 128


def script(tmp_path: Path, text: str) -> str:
    """The output of a script that uses the library without a ``__main__`` guard."""
    path = tmp_path / "own.py"
    path.write_text(textwrap.dedent(text))
    done = subprocess.run(
        [sys.executable, "-W", "error", str(path)],
        env=os.environ | {"PYTHONPATH": str(ROOT)},
        cwd=tmp_path,
        capture_output=True,
        text=True,
        timeout=60,
    )
    assert done.stderr == ""
    assert done.returncode == 0
    return done.stdout


@pytest.fixture
def jpeg(tmp_path: Path) -> Path:
    path = tmp_path / "plan.jpg"
    path.write_bytes(GOOD["jpeg"][0])
    return path


@pytest.mark.skipif(not hasattr(os, "fork"), reason="Windows has other processes")
def test_script_needs_no_guard_and_leaves_no_process(tmp_path, jpeg):
    printed = script(
        tmp_path,
        """
        from occsim import load_drawing
        from occsim.imaging.pool import POOL
        print(*load_drawing("plan.jpg").shape)
        print(POOL._idle[0]._process.pid)
        """,
    )
    shape, pid = printed.splitlines()
    assert shape == "60 80"
    with pytest.raises(ProcessLookupError):
        os.kill(int(pid), 0)


@pytest.mark.skipif(not hasattr(os, "fork"), reason="Windows does not fork")
def test_fork_has_decoders_of_its_own(tmp_path, jpeg):
    printed = script(
        tmp_path,
        """
        import os
        from occsim import load_drawing
        load_drawing("plan.jpg")
        pid = os.fork()
        print(*load_drawing("plan.jpg").shape, flush=True)
        if pid:
            assert os.waitpid(pid, 0)[1] == 0
        """,
    )
    assert printed == "60 80\n60 80\n"


@pytest.mark.skipif(sys.platform != "linux", reason="the system's limit of memory")
def test_memory_of_a_decoder_is_bounded_and_that_of_its_owner_too(tmp_path):
    """In kB: 500 MB for the decoder, 20 MB for its owner.

    An image of 1.9 GB in a page is read: PDFium unpacks it row by row.
    """
    printed = script(
        tmp_path,
        """
        import resource
        from occsim import DrawingError, load_drawing
        from occsim.imaging import pool
        from tests.robust import hostile
        pool.MAX_WALL_SECONDS = 60.0  # the machine may be busy
        bombs = [hostile.form_that_draws_itself(), hostile.nested_forms()]
        def peak(who): return resource.getrusage(who).ru_maxrss
        before = peak(resource.RUSAGE_SELF)
        for data in bombs:
            try:
                load_drawing(data)
            except DrawingError as error:
                assert "memory" in str(error)
        assert load_drawing(hostile.image_in_pdf()).shape == (1334, 2000)
        print(peak(resource.RUSAGE_CHILDREN), peak(resource.RUSAGE_SELF) - before)
        """,
    )
    decoder, owner = map(int, printed.split())
    assert 200_000 < decoder < 510_000
    assert owner < 20_000


def test_decoder_serves_one_file_after_another_but_not_after_a_large_one(jpeg):
    """Whatever the size of the process that started it: this one takes 300 MB."""
    ballast = np.ones(300_000_000, np.uint8)
    pool.POOL.end()
    load_drawing(jpeg)
    (decoder,) = pool.POOL._idle
    load_drawing(jpeg)
    assert pool.POOL._idle == [decoder]
    load_drawing(files.encoded("TIFF"), max_side_px=20)
    assert pool.POOL._idle == [decoder]
    out = io.BytesIO()
    Image.new("RGB", (7000, 7000)).save(out, "JPEG")
    load_drawing(out.getvalue(), max_side_px=500)
    assert pool.POOL._idle == []
    assert decoder._process.returncode is not None
    del ballast


def test_decoder_that_broke_is_replaced(jpeg):
    load_drawing(jpeg)
    for decoder in pool.POOL._idle:
        decoder._process.kill()
        decoder._process.wait()
    assert load_drawing(jpeg).shape == (60, 80)


@pytest.mark.parametrize("python", ["", "/none", "no program", "breaks at once"])
def test_no_decoder_is_a_sentence(python, jpeg, monkeypatch, tmp_path):
    if python == "no program":
        python = str(jpeg)
    if python == "breaks at once":
        monkeypatch.setattr(pool, "DECODER", tmp_path / "none.py")
        python = sys.executable
    monkeypatch.setattr(pool.POOL, "_idle", [])
    monkeypatch.setattr(sys, "executable", python)
    with pytest.raises(DrawingError, match="no process can be started to decode"):
        load_drawing(jpeg)


def test_plain_png_needs_no_decoder(monkeypatch):
    monkeypatch.setattr(pool.POOL, "answer", None)
    assert load_drawing(GOOD["png"][0]).shape == (60, 80)
    with_text = GOOD["png"][0].replace(b"IEND", b"iTXt")  # damaged, and not plain
    with pytest.raises(TypeError):
        load_drawing(with_text)
