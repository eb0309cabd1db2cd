"""Poses from CSV and plain text, TUM, EuRoC and KITTI files among them."""

import csv
import re
from array import array
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from occsim._files import printable
from occsim._types import FloatArray
from occsim.errors import TrajectoryError
from occsim.io.trajectories.bare import bare_columns, bare_poses
from occsim.io.trajectories.columns import PoseColumns, column_axis, find_columns
from occsim.io.trajectories.table import (
    MAX_POSES,
    TrajectoryTable,
    check_count,
    table_from,
)

MAX_LINES = 4 * MAX_POSES
"""Most lines in a text file, including comments and empty ones."""

MAX_LINE_BYTES = 10_000
"""Longest line, bytes."""

COMMENT_MARKS = (b"#", b"%", b"//")
_MAX_COMMENTS = 100
_BOM_8, _BOMS_16 = b"\xef\xbb\xbf", (b"\xff\xfe", b"\xfe\xff")
# Longer quotations in messages are cut.
_QUOTE_LENGTH = 20
# 1,234 may be 1.234 or 1234.
_THOUSANDS = re.compile(r"[+-]?[1-9]\d{0,2},\d{3}")

Line = tuple[int, str]


@dataclass(frozen=True, eq=False, kw_only=True)
class _Layout:
    """How the lines of a file are read."""

    delimiter: str | None  # None: white space
    decimal_comma: bool

    def split(self, line: str) -> list[str]:
        if self.delimiter is None:
            return line.split()
        if '"' in line:
            reader = csv.reader([line], delimiter=self.delimiter, skipinitialspace=True)
            row = next(reader)
        else:
            row = line.split(self.delimiter)
        fields = [field.strip() for field in row]
        # A delimiter at the end of a line opens no further column.
        return fields[:-1] if len(fields) > 1 and not fields[-1] else fields

    def number(self, text: str) -> str:
        return text.replace(",", ".") if self.decimal_comma else text


@dataclass(eq=False)
class _Commas:
    """Whether the commas of a file are decimal commas, if that can be decided."""

    doubtful: tuple[int, str] | None = None
    are_decimal: bool = False
    has_point: bool = False

    def look(self, text: str, line: int) -> None:
        self.has_point |= "." in text
        if "," not in text:
            return
        if not _THOUSANDS.fullmatch(text):
            self.are_decimal = True
        elif self.doubtful is None:
            self.doubtful = line, text

    def check(self, name: str) -> None:
        if self.doubtful and (self.has_point or not self.are_decimal):
            line, text = self.doubtful
            raise TrajectoryError(
                f"{name}, line {line}: '{text}' may be {text.replace(',', '.')} or "
                f"{text.replace(',', '')}; write numbers with a decimal point"
            )


@dataclass(eq=False, kw_only=True)
class _Reader:
    """The lines of a file, read one after another."""

    name: str
    layout: _Layout
    columns: PoseColumns
    n_fields: int | None  # None: as many as the columns need
    commas: _Commas = field(default_factory=_Commas)

    def values(self, lines: Sequence[tuple[int, bytes]]) -> FloatArray:
        """Return the chosen columns as float64, shape (S, len(indices))."""
        values = array("d")
        for number, raw in lines:
            values.extend(self._row(number, self._fields(number, _text(raw))))
        self.commas.check(self.name)
        return np.array(values).reshape(-1, len(self.columns.indices))

    def _fields(self, line: int, text: str) -> list[str]:
        try:
            fields = self.layout.split(text)
        except csv.Error as error:
            raise TrajectoryError(
                f"{self.name}, line {line} is not a row of a table ({error})"
            ) from None
        needed = self.n_fields or max(self.columns.indices) + 1
        if len(fields) < needed or (self.n_fields and len(fields) > needed):
            raise TrajectoryError(
                f"{self.name}, line {line}: {needed} columns are needed; "
                f"got {len(fields)}: {_quoted(fields)}"
            )
        return fields

    def _row(self, line: int, fields: list[str]) -> Iterator[float]:
        for index, title in zip(self.columns.indices, self.columns.titles, strict=True):
            text = fields[index]
            if self.layout.decimal_comma:
                self.commas.look(text, line)
            value = _number(self.layout.number(text))
            if value is None or not np.isfinite(value):
                raise TrajectoryError(
                    f"{self.name}, line {line}: {title} must be a finite number; "
                    f"got {_quoted([text])}"
                )
            yield value


def parse_text(data: bytes, name: str) -> TrajectoryTable:
    """Return the poses in a text file.

    Columns are separated by commas, semicolons, tabs or spaces. A header line (or a
    comment that names the columns) may give them in any order, among others; without
    one there are three, x, y, theta, the eight of the TUM format or the twelve of
    KITTI's.

    Parameters
    ----------
    data : bytes
        UTF-8, UTF-16 with its mark, or Latin-1.
    name : str
        What to call the file.

    Returns
    -------
    TrajectoryTable

    Raises
    ------
    TrajectoryError
        Where a line cannot be read; the message gives its number.
    """
    lines, comments = _lines(data, name)
    if not lines:
        check_count(0, name)
    layout = _layout([_text(raw) for _, raw in lines[:2]])
    first = layout.split(_text(lines[0][1]))
    header, is_line = _header(first, comments, layout, len(first))
    lines = lines[is_line:]
    if header:
        columns = _named(header, name)
        check_count(len(lines), name)
        reader = _Reader(name=name, layout=layout, columns=columns, n_fields=None)
        return table_from(columns.poses(reader.values(lines)), columns.units, name)
    check_count(len(lines), name)
    columns = bare_columns(len(first), f"{name}, line {lines[0][0]}", _quoted(first))
    reader = _Reader(name=name, layout=layout, columns=columns, n_fields=len(first))
    poses, units = bare_poses(reader.values(lines), [n for n, _ in lines], name)
    return table_from(poses, units, name)


def decode(data: bytes, name: str) -> str:
    """Return the text in some bytes.

    Parameters
    ----------
    data : bytes
        UTF-8, UTF-16 with its mark, or Latin-1.
    name : str
        What to call the file.

    Returns
    -------
    str

    Raises
    ------
    TrajectoryError
        Where the bytes are not text.
    """
    return _text(_as_utf8(data, name))


def _as_utf8(data: bytes, name: str) -> bytes:
    """Return a text file's bytes without mark, in UTF-8 or Latin-1."""
    try:
        if data.startswith(_BOMS_16):
            data = data.decode("utf-16").encode("utf-8")
    except ValueError:
        data = b""
    data = data.removeprefix(_BOM_8)
    if not data or b"\0" in data or data.startswith(b"\x80"):
        raise TrajectoryError(
            f"{name} is not a text file; allowed are CSV or plain text (UTF-8), "
            "NPY, MAT, JSON and TUM"
        )
    return data


def _text(raw: bytes) -> str:
    try:
        return raw.decode("utf-8")
    except UnicodeDecodeError:
        return raw.decode("latin-1")


def _lines(data: bytes, name: str) -> tuple[list[tuple[int, bytes]], list[Line]]:
    """Return the lines with content, and the first comments, each with its number."""
    data = _as_utf8(data, name)
    n_lines = data.count(b"\n") + data.count(b"\r")
    if n_lines > 2 * MAX_LINES:  # each may end in both
        raise TrajectoryError(
            f"{name} has about {n_lines:,} lines; at most {MAX_LINES:,} are allowed"
        )
    lines: list[tuple[int, bytes]] = []
    comments: list[Line] = []
    for number, raw in enumerate(data.splitlines(), start=1):
        if len(raw) > MAX_LINE_BYTES:
            raise TrajectoryError(
                f"{name}, line {number} has {len(raw):,} bytes; at most "
                f"{MAX_LINE_BYTES:,} are allowed"
            )
        line = raw.strip(b" \f\v")
        if line.startswith(COMMENT_MARKS):
            if len(comments) < _MAX_COMMENTS:
                comments.append((number, _text(line.lstrip(b"#%/ "))))
        elif line.strip():
            lines.append((number, line))
    return lines, comments


def _layout(lines: list[str]) -> _Layout:
    """Find the delimiter in the first line of numbers, else in the first line."""
    line = next((text for text in lines if text[0] in "+-.0123456789"), lines[0])
    words = line.split()
    if ";" in line:
        return _Layout(delimiter=";", decimal_comma=True)
    if line.count("\t") >= 2:
        return _Layout(delimiter="\t", decimal_comma=True)
    lone_commas = any(word.startswith(",") or word.endswith(",") for word in words)
    if "," in line and (len(words) < 3 or lone_commas):
        return _Layout(delimiter=",", decimal_comma=False)
    return _Layout(delimiter=None, decimal_comma=True)


def _header(
    first: list[str], comments: list[Line], layout: _Layout, n_fields: int
) -> tuple[list[str], bool]:
    """Return the titles of the columns, and whether the first line gives them.

    A comment counts as the header where it names the columns, or where it has as many
    fields as the table and is not a sentence.
    """
    if not any(_number(layout.number(text)) is not None for text in first):
        return first, True
    for _, comment in comments:
        titles = layout.split(comment)
        axes = {column_axis(title)[0] for title in titles}
        is_row = len(titles) == n_fields > 1
        is_table = layout.delimiter is not None or {"x", "y"} <= axes
        if find_columns(titles) or (is_row and is_table):
            return titles, False
    return [], False


def _named(header: list[str], name: str) -> PoseColumns:
    columns = find_columns(header)
    if columns is None:
        raise TrajectoryError(
            f"the header of {name} must name the columns x, y and theta (or x_px, "
            "y_px, theta_deg or theta_rad), or x, y, qx, qy, qz and qw; "
            f"got {_quoted(header)}"
        )
    return columns


def _number(text: str) -> float | None:
    try:
        return None if "_" in text else float(text)
    except ValueError:
        return None


def _quoted(fields: Sequence[str]) -> str:
    shown = [
        f"'{printable(field[:_QUOTE_LENGTH])}{'...' * (len(field) > _QUOTE_LENGTH)}'"
        for field in fields[:8]
    ]
    return ", ".join(shown) + (", ..." if len(fields) > 8 else "")
