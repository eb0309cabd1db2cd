"""The proof of an exercise: it can be solved, is not solved yet, and can be missed."""

from collections.abc import Mapping, Sequence
from typing import Any

from occsim.errors import ParameterError, shown
from occsim.exercises.exercise import Exercise, judge, with_draw
from occsim.exercises.facts import Readings
from occsim.exercises.grammar import Value
from occsim.exercises.state import FLAWS, SETTINGS, changed

POINTED = ("cell", "lens_cell", "lens_pose")
"""Settings without a control of their own: one points at the map."""


def moved_by_witness(proof: Mapping[str, Any]) -> list[str]:
    """Return the controls that a proof's witnesses move, of whatever is drawn."""
    each = [proof, *(one for one in proof.values() if isinstance(one, dict))]
    witnesses = [one for table in each for one in _states(table, "witness")]
    return [control for one in witnesses for control in _controls_of(one)]


def _controls_of(witness: Mapping[str, Any]) -> list[str]:
    """Return the controls by which one reaches a witness."""
    moved = [name for name in witness if name in (*SETTINGS, *FLAWS)]
    return [
        "transport" if name == "step" else name for name in moved if name not in POINTED
    ]


def run_proof(made: Exercise, proof: Mapping[str, Any], readings: Readings) -> None:
    """Prove an exercise; one that draws a setting, for each of its values."""
    if made.draw is None:
        _prove_one(made, proof, readings)
        return
    for value in made.draw.values:
        _prove_one(with_draw(made, value), _proof_of(proof, value), readings)


def _prove_one(made: Exercise, proof: Mapping[str, Any], readings: Readings) -> None:
    witnesses, wrong = _states(proof, "witness"), _states(proof, "wrong")
    if len(witnesses) != len(made.checks):
        raise ParameterError(
            f"the proof needs a witness for each of {len(made.checks)} checks; got "
            f"{len(witnesses)}"
        )
    if not wrong:
        raise ParameterError("the proof needs a wrong answer")
    for witness in witnesses:
        _require_reachable(made, witness)
    if _solves(made, {}, 0, readings):
        raise ParameterError("the check holds already at the set-up")
    for stage, witness in enumerate(witnesses):
        if not _solves(made, witness, stage, readings):
            verdict = judge(made, changed(made.setup, witness), stage, readings)
            raise ParameterError(
                f"the check does not hold at the witness {witness}: {verdict.distance}"
            )
    for answer in wrong:
        if _solves(made, answer, len(made.checks) - 1, readings):
            raise ParameterError(f"the check holds at the wrong answer {answer}")


def _proof_of(proof: Mapping[str, Any], value: Value) -> Mapping[str, Any]:
    """Return the proof for one value of what is drawn: ``[proof.value]``."""
    given = proof.get(str(value))
    if not isinstance(given, dict):
        raise ParameterError(f"the proof needs a table for {shown(value)}, if drawn")
    return given


def _states(proof: Mapping[str, Any], key: str) -> list[dict[str, Any]]:
    value = proof.get(key, [])
    rows: Sequence[Any] = [value] if isinstance(value, dict) else value
    if not all(isinstance(row, dict) for row in rows):
        raise ParameterError(f"{key} must be a table, or several; got {shown(value)}")
    return list(rows)


def _solves(
    made: Exercise, changes: Mapping[str, Any], stage: int, readings: Readings
) -> bool:
    return judge(made, changed(made.setup, changes), stage, readings).is_solved


def _require_reachable(made: Exercise, witness: Mapping[str, Any]) -> None:
    """Check that every control that the witness moves is shown and not locked."""
    for control in _controls_of(witness):
        if control in made.lock:
            raise ParameterError(f"the witness moves {control}, which is locked")
        is_hidden = made.show and control not in made.show
        if is_hidden or control in made.hide:
            raise ParameterError(f"the witness moves {control}, which is hidden")
    moved = [witness.get(name, made.settings.get(name)) for name in made.together]
    if any(value != moved[0] for value in moved):
        raise ParameterError(f"the witness moves {' and '.join(made.together)} apart")
