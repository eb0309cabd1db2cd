"""The list of kept mutations: what is changed, why it matters, who must notice."""

from tests.mutate.arithmetic import ARITHMETIC
from tests.mutate.buildings import BUILDINGS
from tests.mutate.mutation import Mutation
from tests.mutate.scripts import SCRIPTS

MUTATIONS: tuple[Mutation, ...] = (*ARITHMETIC, *BUILDINGS, *SCRIPTS)
