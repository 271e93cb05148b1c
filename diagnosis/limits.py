"""What a log cannot tell: effects that it would not show, and why."""

from collections.abc import Iterator

from diagnosis.effects import LIBRARY
from diagnosis.rig_log import RigLog

NEEDS = {
    "load_dependent_friction": "tip_torque_n_mm",
    "tip_angle_bias": "tip_angle_deg",
    "tip_angle_scale": "tip_angle_deg",
    "tip_sensor_delay": "tip_angle_deg",
    "torque_bias": "base_torque_n_mm",
}
_SLIDING_MM_S = 0.05
_SAME_DEPTH_MM = 1.0


def possible_effects(log: RigLog) -> tuple[str, ...]:
    """Effects that the signals of a log can show at all."""
    return tuple(
        name
        for name in LIBRARY
        if name not in NEEDS or any(trial.has(NEEDS[name]) for trial in log.trials)
    )


def cannot_tell(log: RigLog) -> tuple[str, ...]:
    """Sentences on what a log leaves open, whatever its readings are."""
    return tuple(_sentences(log))


def _sentences(log: RigLog) -> Iterator[str]:
    possible = possible_effects(log)
    hidden: dict[str, list[str]] = {}
    for name in LIBRARY:
        if name not in possible:
            hidden.setdefault(NEEDS[name], []).append(name)
    for signal, names in hidden.items():
        yield f"without {signal} nothing can be said of {', '.join(names)}"
    if not any(trial.has("base_torque_n_mm") for trial in log.trials):
        yield (
            "without base_torque_n_mm stiffness and resistance show only as their ratio: "
            "stiffness_error and damping_error cannot be told apart, and torques have no scale"
        )
    if not any(trial.has("tip_angle_deg") for trial in log.trials):
        yield (
            "without tip_angle_deg the base feels only the nearest part of the shaft: "
            "what happens deep in the tissue or at the tip is seen late and faintly"
        )
    slides = any(abs(trial["speed_mm_s"]).max() > _SLIDING_MM_S for trial in log.trials)
    if not slides:
        yield "the needle never slides: speed_dependent_friction is coulomb_friction there"
    lengths = [trial["inserted_mm"] for trial in log.trials]
    if max(x.max() for x in lengths) - min(x.min() for x in lengths) < _SAME_DEPTH_MM:
        yield "all trials are equally deep: friction per mm and friction in one place look alike"
    if len(log.trials) < 2:
        yield "there is one trial: nothing is checked on a trial that the fit has not seen"
