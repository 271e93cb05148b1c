"""The kind and the effects of every log: fixed shares in blocks, shuffled by the seed.

Log i depends only on the seed and on i, not on how many logs are made.
"""

from collections.abc import Sequence

import numpy as np

from validation.logs.roughness.recording import PAIRS
from validation.logs.roughness.wrong import FAULTS
from validation.rig.modelled import MODELLED, WRONG_CONSTANTS
from validation.rig.unmodelled.library import UNLISTED, UNMODELLED

BLOCK = 33
SHARES = {"none": 0.12, "single": 0.45, "pair": 0.18, "off_nominal": 0.13, "outside": 0.12}
KINDS = tuple(SHARES)
"""Drawn by default."""
ROUGH_SHARES = {"rough_none": 0.2, "rough_single": 0.8}
WRONG_SHARES = {"wrong_constant": 0.75, "wrong_outside": 0.25}
TRIPLE_SHARES = {"triple": 0.18}
SHARES_OF_ALL = SHARES | ROUGH_SHARES | WRONG_SHARES | TRIPLE_SHARES
PLAIN_KINDS = (*ROUGH_SHARES, *WRONG_SHARES)
"""Their sensors have no defect beside what they are named after."""
ALL_KINDS = tuple(SHARES_OF_ALL)
"""All, the others of which are drawn if they are asked for; shares are relative."""
PARAMETER_ERRORS = ("stiffness_error", "damping_error")

LOCATIONS = {
    "coulomb_friction": "interface",
    "stiction": "interface",
    "speed_dependent_friction": "interface",
    "shear_thinning": "interface",
    "tissue_viscoelasticity": "tissue",
    "layered_tissue": "tissue",
    "entry_friction": "interface",
    "sheath_friction": "drive",
    "load_dependent_friction": "needle",
    "chuck_backlash": "drive",
    "base_compliance": "drive",
    "tip_drag": "needle",
    "needle_curvature": "needle",
    "stiffness_error": "parameters",
    "damping_error": "parameters",
    "tip_angle_bias": "sensor",
    "tip_angle_scale": "sensor",
    "tip_sensor_delay": "sensor",
    "torque_bias": "sensor",
    "torque_scale": "sensor",
    "torque_sensor_delay": "sensor",
    "base_angle_scale": "sensor",
    "drive_friction": "drive",
    "inserted_offset": "parameters",
}
MUTUALLY_EXCLUSIVE = ({"coulomb_friction", "stiction", "speed_dependent_friction"},)
"""Effects that explain the same data: two of a set never act together."""
SAME_LOCATION = 0.15
EFFECTS_OF_KIND = {"pair": 2, "triple": 3}
"""One in all other kinds that have any."""
_STREAMS_OF_PARTNERS = (3, 5)


def kind_of(seed: int, case: int, kinds: Sequence[str] = KINDS) -> tuple[str, int]:
    """The kind of a log (counted from 0), and how many of that kind come before it."""
    before = [_block(seed, block, kinds) for block in range(case // BLOCK)]
    this = _block(seed, case // BLOCK, kinds)
    kind = this[case % BLOCK]
    earlier = sum(block.count(kind) for block in before) + this[: case % BLOCK].count(kind)
    return kind, earlier


def _block(seed: int, block: int, kinds: Sequence[str]) -> list[str]:
    """Kinds of one block: numbers by largest remainder, shuffled."""
    total = sum(SHARES_OF_ALL[kind] for kind in kinds)
    ideal = {kind: BLOCK * SHARES_OF_ALL[kind] / total for kind in kinds}
    counts = {kind: int(value) for kind, value in ideal.items()}
    for kind in sorted(kinds, key=lambda k: counts[k] - ideal[k])[: BLOCK - sum(counts.values())]:
        counts[kind] += 1
    ordered = [kind for kind in kinds for _ in range(counts[kind])]
    shuffled = np.random.default_rng([seed, block, 1]).permutation(len(ordered))
    return [ordered[i] for i in shuffled]


def name_in_turn(seed: int, earlier: int, names: Sequence[str]) -> str:
    """Each name in turn, in an order that the seed shuffles anew each round."""
    order = np.random.default_rng([seed, earlier // len(names), 2]).permutation(len(names))
    return str(names[order[earlier % len(names)]])


def effects_of(seed: int, kind: str, earlier: int, allowed: Sequence[str] | None) -> tuple[str, ...]:
    """Names of the effects of a log; for kind `outside`, of an unmodelled effect."""
    if kind in ("none", "rough_none"):
        return ()
    if kind == "wrong_outside":
        return tuple(name for name in (_cause(seed, earlier),) if name in UNLISTED)
    known = {"outside": UNMODELLED, "wrong_constant": WRONG_CONSTANTS}.get(kind, MODELLED)
    names = [name for name in known if allowed is None or name in allowed]
    if allowed and kind not in ("outside", "wrong_constant"):
        names += [name for name in WRONG_CONSTANTS if name in allowed]
    names = names or list(known)
    if kind == "off_nominal":
        names = [n for n in names if n not in PARAMETER_ERRORS] or ["coulomb_friction"]
    first = name_in_turn(seed, earlier, names)
    chosen = [first]
    for stream in _STREAMS_OF_PARTNERS[: EFFECTS_OF_KIND.get(kind, 1) - 1]:
        chosen.append(_partner(np.random.default_rng([seed, earlier, stream]), chosen))
    return tuple(chosen)


def _partner(rng: np.random.Generator, chosen: Sequence[str]) -> str:
    """One more effect, mostly in another part of the machine than the chosen ones."""
    elsewhere = rng.random() >= SAME_LOCATION
    taken = {LOCATIONS[name] for name in chosen}
    fit = [
        name
        for name in MODELLED
        if name not in chosen
        and (LOCATIONS[name] not in taken) == elsewhere
        and not any(names & {name} and names & {*chosen} for names in MUTUALLY_EXCLUSIVE)
    ]
    fit = fit or [name for name in MODELLED if LOCATIONS[name] not in taken]
    return fit[int(rng.integers(len(fit)))]


def _cause(seed: int, earlier: int) -> str:
    """The fault in a log of kind `wrong_outside`: a wrong constant, or one of the recording."""
    return name_in_turn(seed, earlier, (*UNLISTED, *FAULTS))


def roughness_of(
    seed: int, kind: str, earlier: int, case: int, asked: Sequence[str] | None
) -> tuple[str, ...]:
    """Names of the roughnesses of a log: each pair in turn, or each of those in `asked` alone."""
    if kind == "wrong_outside":
        return tuple(name for name in (_cause(seed, earlier),) if name in FAULTS)
    if kind not in ROUGH_SHARES:
        return ()
    if asked:
        return (asked[case % len(asked)],)
    order = np.random.default_rng([seed, case // len(PAIRS), 4]).permutation(len(PAIRS))
    return PAIRS[int(order[case % len(PAIRS)])]
