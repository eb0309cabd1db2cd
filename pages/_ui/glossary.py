"""The terms of the app, one sentence each: shown where a term is pointed at."""

from collections.abc import Mapping

TERMS: Mapping[str, str] = {
    "reading": "What the sensor says from one pose: which pixels of its field of view "
    "it found free, and which occupied.",
    "cell": "A square of the map; the robot decides for each whether a wall is in it.",
    "map": "For each cell, how probable it is that the cell is free.",
    "drawing": "The architect's plan; the walls found in it are the map's start.",
    "prior": "What is believed of a cell before the first reading.",
    "blank map": "A map that starts from no drawing: one half for every cell.",
    "ground truth": "The walls that are really there, which the robot does not know.",
    "p_free": "The probability that a cell is free.",
    "p_wall": "The prior for cells in which the drawing has a wall.",
    "p_space": "The prior for cells in which the drawing has no wall.",
    "log-odds": "The natural logarithm of the probability for free over that for "
    "occupied; readings add up in it.",
    "looked at": "Cells of which at least one reading has said something.",
    "not looked at": "Cells of which no reading has said anything yet; they still "
    "show what the map started from.",
    "walls found": "Wall cells that the map declares occupied.",
    "false walls": "Free cells that the map declares occupied.",
    "missed wall": "A wall cell that the map does not declare occupied.",
    "precision": "Of the cells declared occupied, the share that are walls.",
    "recall": "Of the wall cells, the share that are declared occupied.",
    "F2": "One number from precision and recall, in which recall weighs twice as much.",
    "bits per cell": "The mean of −log₂ of the probability that the map gives to the "
    "truth: less is better, and a map that says one half everywhere has 1.",
    "update rule": "How a reading enters the map: with the drawing counted once, or "
    "taken off again at every reading.",
    "front": "The prior pairs of which no other has both more precision and more "
    "recall.",
}
"""Each term as it stands in a sentence, and what it means."""


def meaning(label: str) -> str:
    """What a term means, however its first letter is written.

    Raises
    ------
    KeyError
        Where the glossary has no such term.
    """
    return TERMS[label if label in TERMS else label[:1].lower() + label[1:]]
