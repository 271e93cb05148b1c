"""Identifiability: what a log cannot determine, whatever its readings are, and why."""

from collections.abc import Iterator

from diagnosis.criteria.assessment import SAME_DEPTH_MM
from diagnosis.criteria.fitting import SLIDING_MM_S
from diagnosis.effects import FITTED, LIBRARY
from diagnosis.log.rig_log import RigLog


def testable_effects(log: RigLog) -> tuple[str, ...]:
    """Names of the effects and imperfections that the columns of a log can show at all."""
    return tuple(
        name
        for name, effect in FITTED.items()
        if not effect.needs or any(trial.has(effect.needs) for trial in log.trials)
    )


def unidentifiable(log: RigLog) -> tuple[str, ...]:
    """Sentences on what the log cannot determine."""
    return (*_not_testable(log), *_alike(log))


def _not_testable(log: RigLog) -> Iterator[str]:
    testable = testable_effects(log)
    by_column: dict[str, list[str]] = {}
    for name, effect in LIBRARY.items():
        if name not in testable:
            by_column.setdefault(effect.needs, []).append(name)
    for column, names in by_column.items():
        yield f"Not testable: {', '.join(names)}; needs the column {column}"


def _alike(log: RigLog) -> Iterator[str]:
    if not any(trial.has("base_torque_n_mm") for trial in log.trials):
        yield (
            "Without base_torque_n_mm stiffness and resistance show only as their ratio: "
            "stiffness_error and damping_error cannot be told apart, and torques have no scale"
        )
    if not any(trial.has("tip_angle_deg") for trial in log.trials):
        yield (
            "Without tip_angle_deg the base feels only the nearest part of the shaft: "
            "what happens deep in the tissue or at the tip appears late and weakly"
        )
    if not any(abs(trial["speed_mm_s"]).max() > SLIDING_MM_S for trial in log.trials):
        yield "The needle never slides: speed_dependent_friction and coulomb_friction are the same here"
    lengths = [trial["inserted_mm"] for trial in log.trials]
    if max(x.max() for x in lengths) - min(x.min() for x in lengths) < SAME_DEPTH_MM:
        yield "All trials are equally deep: friction per mm and friction in one place look alike"
    if len(log.trials) < 2:
        yield "There is one trial: nothing is checked on a trial that the fit has not seen"
