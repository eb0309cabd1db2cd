"""The grammar of checks: parsed into a tree, never evaluated as a program.

::

    check   = clause { "and" clause }
    clause  = [ "not" ] sum [ relation sum ]
    sum     = product { ( "+" | "-" ) product }
    product = atom { ( "*" | "/" ) atom }
    atom    = number | name | text | "abs" "(" sum ")" | "(" sum ")" | "-" atom

A relation is one of ``== != <= >= < >``. A name without a fact of that name is a word,
such as ``unseen``; a text in double quotes is one too. Words can only be compared for
equality.
"""

import math
import operator
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from typing import TypeAlias

from occsim.errors import ParameterError, shown

Value: TypeAlias = float | bool | str
Tree: TypeAlias = "Number | Name | Text | Apply"
Lookup: TypeAlias = Callable[[str], Value]

MAX_CHARACTERS = 400
MAX_DEPTH = 12
"""Bounds of a check: far more than any that a teacher writes."""

_TOKEN = re.compile(
    r"\s*(?:\d+(?:\.\d+)?|[A-Za-z_][\w.]*|\"[^\"]*\"|==|!=|<=|>=|[<>+\-*/()])"
)
_RELATIONS: Mapping[str, Callable[[float, float], bool]] = {
    "<=": operator.le,
    ">=": operator.ge,
    "<": operator.lt,
    ">": operator.gt,
}
_RELATION_NAMES = ("==", "!=", *_RELATIONS)


@dataclass(frozen=True, slots=True)
class Number:
    """A number as written."""

    value: float


@dataclass(frozen=True, slots=True)
class Name:
    """A fact, or a word."""

    text: str


@dataclass(frozen=True, slots=True)
class Text:
    """A word in quotes."""

    value: str


@dataclass(frozen=True, slots=True)
class Apply:
    """An operation on one or two parts."""

    operation: str
    parts: tuple[Tree, ...]


def parse(text: str) -> Tree:
    """Return the tree of a check.

    Parameters
    ----------
    text : str
        Up to 400 characters of the grammar above.

    Returns
    -------
    Number, Name or Apply

    Raises
    ------
    ParameterError
        Where the text is not of the grammar.

    Examples
    --------
    >>> parse("recall >= 0.9").operation
    '>='
    """
    reader = _Reader(text)
    tree = reader.check()
    reader.end()
    return tree


def parse_sum(text: str) -> Tree:
    """Return the tree of a quantity, such as ``blank.f2 + 0.05``; see `parse`."""
    reader = _Reader(text)
    tree = reader.sum()
    reader.end()
    return tree


class _Reader:
    """Tokens of a text, read one after another."""

    def __init__(self, text: str) -> None:
        if len(text) > MAX_CHARACTERS:
            raise ParameterError(
                f"a check has at most {MAX_CHARACTERS} characters; got {len(text)}"
            )
        self._text, self._depth = text, 0
        self._tokens = list(self._split())

    def _split(self) -> Iterator[str]:
        at = 0
        while self._text[at:].strip():
            found = _TOKEN.match(self._text, at)
            if found is None:
                raise ParameterError(
                    f"a check has names, numbers and comparisons; {shown(self._text)} "
                    f"has {self._text[at:].strip()[:1]!r}"
                )
            yield found.group().strip()
            at = found.end()

    def _next(self) -> str:
        return self._tokens[0] if self._tokens else ""

    def _take(self, *wanted: str) -> str:
        """Return the next token if it is one of these, else nothing."""
        return self._tokens.pop(0) if self._next() in wanted else ""

    def _fail(self) -> ParameterError:
        got = repr(self._next()) if self._tokens else "its end"
        return ParameterError(f"the check {shown(self._text)} cannot be read at {got}")

    def end(self) -> None:
        if self._tokens:
            raise self._fail()

    def check(self) -> Tree:
        tree = self._clause()
        while self._take("and"):
            tree = Apply("and", (tree, self._clause()))
        return tree

    def _clause(self) -> Tree:
        if self._take("not"):
            return Apply("not", (self._comparison(),))
        return self._comparison()

    def _comparison(self) -> Tree:
        left = self.sum()
        relation = self._take(*_RELATION_NAMES)
        return Apply(relation, (left, self.sum())) if relation else left

    def sum(self) -> Tree:
        tree = self._product()
        while sign := self._take("+", "-"):
            tree = Apply(sign, (tree, self._product()))
        return tree

    def _product(self) -> Tree:
        tree = self._atom()
        while sign := self._take("*", "/"):
            tree = Apply(sign, (tree, self._atom()))
        return tree

    def _atom(self) -> Tree:
        self._depth += 1
        if self._depth > MAX_DEPTH * 8 or not self._tokens:
            raise self._fail()
        if self._take("-"):
            return Apply("negative", (self._atom(),))
        if self._take("("):
            return self._closed(self.sum())
        token = self._next()
        if token[0].isdigit():
            return Number(float(self._tokens.pop(0)))
        if token[0] == '"':
            return Text(self._tokens.pop(0)[1:-1])
        if not re.match(r"[A-Za-z_]", token) or token in ("and", "not"):
            raise self._fail()
        self._tokens.pop(0)
        if token == "abs":
            if not self._take("("):
                raise self._fail()
            return Apply("abs", (self._closed(self.sum()),))
        return Name(token)

    def _closed(self, tree: Tree) -> Tree:
        if not self._take(")"):
            raise self._fail()
        return tree


def names_of(tree: Tree) -> Iterator[str]:
    """Yield every name in a tree, facts and words."""
    if isinstance(tree, Name):
        yield tree.text
    elif isinstance(tree, Apply):
        for part in tree.parts:
            yield from names_of(part)


def holds(tree: Tree, lookup: Lookup) -> bool:
    """Return whether a check holds.

    Parameters
    ----------
    tree : Number, Name or Apply
        From `parse`.
    lookup : callable
        Value of a name; a word is its own value.

    Returns
    -------
    bool
        NaN, an undefined score, makes a comparison false.

    Raises
    ------
    ParameterError
        Where words are compared by size.
    """
    if isinstance(tree, Apply):
        if tree.operation == "and":
            return holds(tree.parts[0], lookup) and holds(tree.parts[1], lookup)
        if tree.operation == "not":
            return _is_known(tree.parts[0], lookup) and not holds(tree.parts[0], lookup)
        if tree.operation in _RELATION_NAMES:
            left, right = (value(part, lookup) for part in tree.parts)
            return _compare(tree.operation, left, right)
    result = value(tree, lookup)
    return bool(result) and result == result


def _is_known(tree: Tree, lookup: Lookup) -> bool:
    """Whether every name has a value: nothing is said of what is undefined."""
    values = [lookup(name) for name in names_of(tree)]
    return not any(isinstance(one, float) and math.isnan(one) for one in values)


def _compare(relation: str, left: Value, right: Value) -> bool:
    if any(isinstance(one, float) and math.isnan(one) for one in (left, right)):
        return False
    if relation in ("==", "!="):
        return (left == right) == (relation == "==")
    return _RELATIONS[relation](_number(left), _number(right))


def value(tree: Tree, lookup: Lookup) -> Value:
    """Return the value of a quantity; see `holds`."""
    if isinstance(tree, (Number, Text)):
        return tree.value
    if isinstance(tree, Name):
        return lookup(tree.text)
    parts = [_number(value(part, lookup)) for part in tree.parts]
    if tree.operation == "negative":
        return -parts[0]
    if tree.operation == "abs":
        return abs(parts[0])
    if tree.operation == "/":
        return parts[0] / parts[1] if parts[1] else math.nan
    arithmetic = {"+": operator.add, "-": operator.sub, "*": operator.mul}
    return float(arithmetic[tree.operation](*parts))


def _number(given: Value) -> float:
    if isinstance(given, str):
        raise ParameterError(f"a number is needed in a check; got {given!r}")
    return float(given)
