"""The list of kept mutations: the change, why it matters, the tests that must fail."""

from tests.mutate.arithmetic import ARITHMETIC
from tests.mutate.buildings import BUILDINGS
from tests.mutate.mutation import Mutation
from tests.mutate.proper import PROPER
from tests.mutate.scans import SCANS
from tests.mutate.scripts import SCRIPTS
from tests.mutate.walls import WALLS

MUTATIONS: tuple[Mutation, ...] = (
    *ARITHMETIC,
    *BUILDINGS,
    *PROPER,
    *SCANS,
    *SCRIPTS,
    *WALLS,
)
