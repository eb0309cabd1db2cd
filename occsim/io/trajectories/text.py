"""Poses from CSV, plain text and TUM files."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from occsim._types import FloatArray
from occsim.errors import TrajectoryError
from occsim.io.trajectories.table import (
    TrajectoryTable,
    check_count,
    find_columns,
    table_from,
)

COMMENT_MARKS = ("#", "%", "//")
TUM_COLUMNS = ("timestamp", "tx", "ty", "tz", "qx", "qy", "qz", "qw")
_BOMS = {
    b"\xef\xbb\xbf": "utf-8-sig",
    b"\xff\xfe": "utf-16",
    b"\xfe\xff": "utf-16",
}
# A quotation longer than this, from hostile bytes, is cut.
_QUOTE_LENGTH = 20


@dataclass(frozen=True, eq=False, kw_only=True)
class _Layout:
    """How the lines of a file are to be read."""

    delimiter: str | None  # None: white space
    decimal_comma: bool

    def split(self, line: str) -> list[str]:
        if self.delimiter is None:
            return line.split()
        row = next(csv.reader([line], delimiter=self.delimiter, skipinitialspace=True))
        fields = [field.strip() for field in row]
        # A delimiter at the end of a line opens no further column.
        return fields[:-1] if len(fields) > 1 and not fields[-1] else fields

    def number(self, text: str) -> str:
        return text.replace(",", ".") if self.decimal_comma else text


def parse_text(data: bytes, name: str) -> TrajectoryTable:
    """Return the poses in a text file.

    Columns are separated by commas, semicolons, tabs or spaces. A header line (or a
    comment that names the columns) may give them in any order, among others; without
    one there are three, x, y, theta, or the eight of the TUM format.

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
    lines, comments = _lines(decode(data, name))
    if not lines:
        check_count(0, name)
    layout = _layout(lines)
    titles = _titles(lines, comments, layout)
    if titles and titles[0] is lines[0]:
        lines = lines[1:]
        if not lines:
            _header_columns(titles[1], name)  # a wrong header is the better message
    check_count(len(lines), name)
    try:
        rows = [layout.split(text) for _, text in lines]
    except csv.Error as error:
        raise TrajectoryError(f"{name} is not a table of numbers ({error})") from None
    numbers = [number for number, _ in lines]
    header = titles[1] if titles else []
    if _is_tum(rows[0], header, name):
        values = _numbers(rows, range(8), TUM_COLUMNS, numbers, layout, name)
        return table_from(_planar(values, numbers, name), {"theta": "rad"}, name)
    indices, units = _columns(rows[0], header, numbers[0], name)
    values = _numbers(rows, indices, ("x", "y", "theta"), numbers, layout, name)
    return table_from(values, units, name)


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
        Where the bytes are no text.
    """
    encoding = next((code for mark, code in _BOMS.items() if data.startswith(mark)), "")
    try:
        text = data.decode(encoding or "utf-8")
    except UnicodeDecodeError:
        text = "" if encoding else data.decode("latin-1")
    if not text or "\0" in text or text.startswith(("PK\3\4", "\x80")):
        raise TrajectoryError(
            f"{name} is not a text file; allowed are CSV or plain text (UTF-8), "
            f"NPY, MAT, JSON and TUM"
        )
    return text


def _lines(text: str) -> tuple[list[tuple[int, str]], list[tuple[int, str]]]:
    """Return the lines with content, and the comments, each with its number."""
    lines, comments = [], []
    for number, line in enumerate(text.splitlines(), start=1):
        line = line.strip(" \r\n\f\v\ufeff")
        if line.startswith(COMMENT_MARKS):
            comments.append((number, line.lstrip("#%/ ")))
        elif line.strip():
            lines.append((number, line))
    return lines, comments


def _layout(lines: list[tuple[int, str]]) -> _Layout:
    """Tell the delimiter by the first line of numbers, else by the first line."""
    line = next((text for _, text in lines if text[0] in "+-.0123456789"), lines[0][1])
    words = line.split()
    if ";" in line:
        return _Layout(delimiter=";", decimal_comma=True)
    if line.count("\t") >= 2:
        return _Layout(delimiter="\t", decimal_comma=True)
    lone_commas = any(word.startswith(",") or word.endswith(",") for word in words)
    if "," in line and (len(words) < 3 or lone_commas):
        return _Layout(delimiter=",", decimal_comma=False)
    return _Layout(delimiter=None, decimal_comma=True)


def _titles(
    lines: list[tuple[int, str]], comments: list[tuple[int, str]], layout: _Layout
) -> tuple[tuple[int, str], list[str]] | None:
    """Return the line that names the columns, and its titles; None without one."""
    fields = layout.split(lines[0][1])
    if not any(_is_number(layout.number(field)) for field in fields):
        return lines[0], fields
    for comment in comments:
        titles = layout.split(comment[1])
        if find_columns(titles) or {"qx", "qy", "qz", "qw"} <= set(titles):
            return comment, titles
    return None


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def _is_tum(row: list[str], header: list[str], name: str) -> bool:
    if len(row) != len(TUM_COLUMNS):
        return False
    if header and "qw" not in (title.lower() for title in header):
        return name.lower().endswith(".tum")
    return True


def _columns(
    row: list[str], header: list[str], line: int, name: str
) -> tuple[list[int], dict[str, str]]:
    """Return where x, y and theta stand in a row, and their units."""
    if header:
        return _header_columns(header, name)
    if len(row) != 3:
        raise TrajectoryError(
            f"{name}, line {line}: three columns x, y, theta are needed, or a header "
            f"that names them; got {len(row)} column{'s' * (len(row) != 1)}: "
            f"{_quoted(row)}"
        )
    return [0, 1, 2], {}


def _header_columns(header: list[str], name: str) -> tuple[list[int], dict[str, str]]:
    found = find_columns(header)
    if found is None:
        raise TrajectoryError(
            f"the header of {name} must name the columns x, y and theta "
            f"(or x_px, y_px, theta_deg or theta_rad); got {_quoted(header)}"
        )
    return found


def _numbers(
    rows: list[list[str]],
    indices: Sequence[int],
    titles: Sequence[str],
    line_numbers: list[int],
    layout: _Layout,
    name: str,
) -> FloatArray:
    """Return the chosen columns as float64, shape (S, len(indices))."""
    needed = max(indices) + 1
    for row, line in zip(rows, line_numbers, strict=True):
        if len(row) < needed:
            raise TrajectoryError(
                f"{name}, line {line}: {needed} columns are needed; "
                f"got {len(row)}: {_quoted(row)}"
            )
    texts = [[layout.number(row[i]) for i in indices] for row in rows]
    try:
        values = np.array(texts, dtype=np.float64)
    except ValueError:
        values = np.full((len(texts), len(indices)), np.nan)
    bad = np.flatnonzero(~np.isfinite(values).all(axis=1))
    for k in bad:
        for text, title in zip(texts[k], titles, strict=True):
            if not _is_number(text) or not np.isfinite(float(text)):
                raise TrajectoryError(
                    f"{name}, line {line_numbers[k]}: {title} must be a finite "
                    f"number; got {_quoted([text])}"
                )
    return values


def _planar(tum: FloatArray, line_numbers: list[int], name: str) -> FloatArray:
    """Return x, y and yaw of TUM rows of shape (S, 8); height and tilt are dropped."""
    _, x, y, _, qx, qy, qz, qw = tum.T
    zero = np.flatnonzero(np.hypot(np.hypot(qx, qy), np.hypot(qz, qw)) < 1e-6)
    if zero.size:
        raise TrajectoryError(
            f"{name}, line {line_numbers[zero[0]]}: the quaternion qx qy qz qw must "
            "not be zero; got 0 0 0 0"
        )
    yaw = np.arctan2(2.0 * (qw * qz + qx * qy), qw**2 + qx**2 - qy**2 - qz**2)
    return np.stack([x, y, yaw], axis=1)


def _quoted(fields: Sequence[str]) -> str:
    shown = [
        f"'{field[:_QUOTE_LENGTH]}{'...' * (len(field) > _QUOTE_LENGTH)}'"
        for field in fields[:8]
    ]
    return ", ".join(shown) + (", ..." if len(fields) > 8 else "")
