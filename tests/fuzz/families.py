"""The families of inputs: how each is made, what is done with one, and its share of a run."""

from dataclasses import dataclass
from typing import Any

from fuzz import commands, imports, logs, protocols
from hypothesis import HealthCheck, Phase, given, seed, settings
from hypothesis.strategies import SearchStrategy


@dataclass(frozen=True)
class Family:
    """Inputs of one kind; the weight is their share of a run."""

    inputs: SearchStrategy[Any]
    checked: Any
    weight: int


FAMILIES = {
    "logs, changed": Family(logs.wrong, logs.checked, 20),
    "logs, the same": Family(logs.same(), lambda files: logs.checked(files, same=True), 6),
    "protocols, changed": Family(protocols.wrong, protocols.checked, 28),
    "protocols, the same": Family(protocols.same, lambda data: protocols.checked(data, same=True), 1),
    "lab files, changed": Family(imports.lab_files, imports.checked_file, 16),
    "lab files, misnamed": Family(imports.renamed, imports.checked_file, 1),
    "lab files, the same": Family(
        imports.same,
        lambda csv: imports.checked_mapping(imports.MAPPING.encode(), csv=csv, same=True),
        1,
    ),
    "mappings, changed": Family(imports.mappings, imports.checked_mapping, 14),
    "answers, changed": Family(commands.answers, commands.checked_answers, 10),
    "arguments": Family(commands.arguments, commands.checked_command, 8),
}


def each_input(family, act, *, most, random_seed=None):
    """Do something with so many inputs of a family; without a seed with the same ones every time."""
    every = settings(
        max_examples=most,
        derandomize=random_seed is None,
        database=None,
        deadline=None,
        phases=[Phase.generate],
        suppress_health_check=list(HealthCheck),
    )

    @every
    @given(family.inputs)
    def one(value):
        act(value)

    (one if random_seed is None else seed(random_seed)(one))()
