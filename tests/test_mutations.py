"""The kept mutations still fit the code that they change."""

import pytest

from tests.mutate.__main__ import ROOT, applied
from tests.mutate.kept import MUTATIONS


@pytest.mark.parametrize("mutation", MUTATIONS, ids=lambda one: one.why)
def test_every_kept_mutation_changes_one_place_and_names_tests_that_exist(mutation):
    text = (ROOT / mutation.file).read_text("utf-8")
    assert applied(text, mutation) != text
    for test in mutation.tests:
        path, _, name = test.partition("::")
        assert f"def {name}" in (ROOT / path).read_text("utf-8") if name else True
        assert (ROOT / path).exists()
