"""What to change if an effect is found: the words of its file, with the fitted values."""

from collections.abc import Mapping, Sequence

from diagnosis.assessment.uncertainty.intervals import Interval
from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Effect, Place
from diagnosis.log.nominal_rig import NominalRig

Parameters = Mapping[str, Mapping[str, Interval]]


def remedies(effects: Sequence[str], parameters: Parameters, rig: NominalRig) -> str:
    """What to change in rig or model, effect by effect, as an instruction without a full stop.

    Args:
      parameters: intervals of the parameters of each effect.
    """
    return "; ".join(_remedy(LIBRARY[name], parameters.get(name, {}), rig) for name in effects)


def constants_that_do_the_same(
    effects: Sequence[str], parameters: Parameters, rig: NominalRig
) -> tuple[str, ...]:
    """What of the rig, that no effect stands for, would do exactly what one of the effects does."""
    each = ((LIBRARY[name], parameters.get(name, {})) for name in effects)
    return tuple(_same(effect, own, rig) for effect, own in each if effect.same_as and own)


def check_that_tells(sets: Sequence[Sequence[str]]) -> str:
    """A separate measurement that tells sets of effects apart: of an effect that only one set has.

    Sensors are the easiest to calibrate; then come constants of the rig that are measured at rest.
    """
    shared = set.intersection(*(set(names) for names in sets)) if sets else set()
    apart = [LIBRARY[name] for names in sets for name in names if name not in shared]
    easiest = sorted(apart, key=lambda effect: _EASY.get(effect.place, len(_EASY)))
    return easiest[0].check if easiest else ""


_EASY = {Place.SENSOR: 0, Place.PARAMETERS: 1}


def _remedy(effect: Effect, own: Mapping[str, Interval], rig: NominalRig) -> str:
    words = {name: in_words(interval) for name, interval in own.items()}
    if effect.corrects and own:
        words["constant"] = f"{_nominal(effect, rig) * next(iter(own.values())).value:.4g}"
    words["same"] = _same(effect, own, rig)
    try:
        return effect.remedy.format_map(words) or f"put into the model: {effect.title}"
    except KeyError:  # a parameter that was not fitted
        return f"put into the model: {effect.title}"


def _same(effect: Effect, own: Mapping[str, Interval], rig: NominalRig) -> str:
    if effect.same_as is None or not own:
        return ""
    return effect.same_as(rig, *(interval.value for interval in own.values()))


def _nominal(effect: Effect, rig: NominalRig) -> float:
    """The constant of rig.yaml that an effect corrects."""
    group, _, name = effect.corrects.partition(".")
    return float(getattr(getattr(rig, group), name))


def in_words(interval: Interval) -> str:
    """A value with its unit; factors by four digits."""
    digits = ".4g" if interval.unit == "-" else ".3g"
    return f"{interval.value:{digits}} {interval.unit}".removesuffix(" -")
