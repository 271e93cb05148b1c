"""The stages of a diagnosis, in their order: in words, and what they usually take."""

from dataclasses import dataclass
from enum import StrEnum


class Log(StrEnum):
    """What the tasks of a stage replay, on which their time depends."""

    DECIMATED = "decimated log"
    WHOLE = "whole log"


@dataclass(frozen=True, kw_only=True)
class Usual:
    """A stage in words, and its usual tasks.

    Attributes:
      task_s: time of a task, s; only ratios count, as every machine and every log has its own pace.
      least: tasks where one effect explains the log.
      most: tasks where nothing does.
    """

    words: str
    log: Log = Log.DECIMATED
    task_s: float = 0.0
    least: int = 0
    most: int = 0


def _coarse(words: str, task_s: float, least: int, most: int) -> Usual:
    return Usual(words=words, task_s=task_s, least=least, most=most)


def _whole(words: str, task_s: float, least: int, most: int) -> Usual:
    return Usual(words=words, log=Log.WHOLE, task_s=task_s, least=least, most=most)


REPLAYING, CHECKING, ASSESSING = "nominal replay", "held-out trials", "assessment"
SCREENING_PAIRS, ALIKE = "screening pairs", "what cannot be told apart"
STAGES = {
    REPLAYING: _coarse("replaying the nominal rig", 0.0, 1, 1),
    "nominal rig": _whole("fitting the nominal rig", 0.4, 1, 1),
    "stiffness or damping alone": _whole("fitting stiffness or damping alone", 0.5, 0, 1),
    "screening single effects": _coarse("screening single effects", 0.06, 27, 27),
    "single effects": _coarse("fitting single effects", 0.25, 4, 32),
    "coloured noise": _whole("fitting again with coloured noise", 1.0, 0, 0),
    "finalists": _whole("fitting the best single effects to the whole log", 1.0, 1, 2),
    "flicker noise that shows": _whole("fitting with 1/f noise that shows itself", 1.0, 0, 0),
    SCREENING_PAIRS: _coarse("screening pairs", 0.04, 27, 150),
    "pairs": _coarse("fitting pairs", 0.25, 0, 20),
    "finalists, pairs": _whole("fitting the best pairs to the whole log", 1.0, 0, 2),
    "richer effects": _coarse("fitting richer effects of the best", 0.5, 0, 2),
    "finalists, richer effects": _whole("fitting richer effects to the whole log", 1.0, 0, 1),
    "screening imperfections of sensors": _coarse("screening imperfections of sensors", 0.03, 0, 6),
    "imperfections of sensors": _coarse("fitting imperfections of sensors", 0.2, 0, 3),
    "finalists, imperfections of sensors": _whole(
        "fitting the best imperfections of sensors to the whole log", 1.0, 0, 2
    ),
    "presliding of dry friction": _whole("fitting the presliding angle of dry friction", 1.0, 0, 1),
    "screening three effects": _coarse("screening sets of three effects", 0.05, 0, 96),
    "three effects": _coarse("fitting sets of three effects", 0.5, 0, 12),
    "finalists, three effects": _whole("fitting the best sets of three to the whole log", 1.0, 0, 4),
    "richer effects in place of three": _whole("fitting richer effects of a set of three", 1.0, 0, 0),
    "screening exchanges": _coarse("screening other effects in place of one", 0.05, 0, 0),
    "exchanges": _coarse("fitting another effect in place of one", 0.5, 0, 0),
    "finalists, exchanges": _whole("fitting sets with one effect exchanged to the whole log", 1.0, 0, 0),
    "screening exchanges in the best": _coarse(
        "screening others in place of one of the best", 0.05, 0, 0
    ),
    "exchanges in the best": _coarse("fitting another in place of one of the best", 0.5, 0, 0),
    "finalists, exchanges in the best": _whole(
        "fitting the best with one effect exchanged to the whole log", 1.0, 0, 0
    ),
    "screening imperfections beside three": _whole("screening imperfections beside three", 0.2, 0, 0),
    "imperfections beside three": _whole("fitting imperfections beside three", 1.0, 0, 0),
    "best to its end": _whole("completing the fit of the best", 4.0, 0, 1),
    "imperfections in place": _whole("fitting imperfections in place of a delay", 1.0, 0, 2),
    "best without each effect": _whole("fitting the best without each of its effects", 1.0, 0, 3),
    "richer effects in the best": _whole("fitting richer effects of the best again", 1.0, 0, 0),
    "scatter of the best": _whole("fitting stiffness and damping of the best freely", 10.0, 0, 1),
    "mesh refinement": _whole("fitting with a finer mesh", 5.0, 0, 0),
    "finer mesh near the floor": _whole("fitting with a finer mesh", 5.0, 0, 0),
    "finer mesh": _whole("fitting with a finer mesh", 5.0, 0, 0),
    "simpler effects": _whole("fitting simpler effects in the best", 1.0, 0, 0),
    "plainer sets": _whole("fitting plainer sets that leave hardly more", 1.0, 0, 1),
    "noise of the best": _whole("fitting with the noise that the best leaves", 1.0, 0, 0),
    "lost counts": _whole("looking for counts that the encoder has lost", 0.02, 0, 40),
    "tissue that goes along": _whole("fitting with tissue that the shaft drags along", 1.0, 0, 0),
    "starts of trials": _whole("fitting what wound trials up before they began", 1.0, 0, 0),
    "clocks before trials": _whole("fitting clocks that ran before the trials", 1.0, 0, 0),
    "noise that grows": _whole("fitting with noise that grows with rate or torque", 1.0, 0, 0),
    "noise of each trial": _whole("fitting with noise that differs from trial to trial", 1.0, 0, 0),
    "outliers beside the best": _whole("fitting without outliers", 1.0, 0, 0),
    "weakly coloured noise": _whole("fitting with noise of another colour", 1.0, 0, 0),
    "flicker noise": _whole("fitting with 1/f noise", 1.0, 0, 0),
    "screening jumps of readings": _coarse("screening single effects beside a jump", 0.06, 0, 0),
    "jumps of readings": _coarse("fitting with jumps of readings", 0.3, 0, 0),
    "drift of the torque sensor": _coarse("fitting with a drift of the torque sensor", 0.3, 0, 14),
    "drift of the tip sensor": _coarse("fitting with a drift of the tip sensor", 0.3, 0, 0),
    "starts and another imperfection": _whole("fitting with starts, and a drift of a sensor", 1.0, 0, 0),
    "outliers and another imperfection": _whole(
        "fitting without outliers, with another imperfection", 1.0, 0, 0
    ),
    "drift or offset": _whole("comparing drifts and offsets of a sensor", 1.0, 0, 0),
    ALIKE: _coarse("looking for equivalent explanations", 0.03, 24, 24),
    CHECKING: _coarse("checking on held-out trials", 0.0, 1, 1),
    "other forms of a law": _whole("comparing with other forms of a law", 1.0, 0, 0),
    ASSESSING: _coarse("assessing the best explanation", 0.4, 1, 1),
    "adding another effect": _coarse("adding another effect", 0.03, 24, 24),
    "detection limits": _coarse("computing detection limits", 0.12, 20, 20),
    "effects that hide": _whole("fitting effects that may hide", 1.0, 0, 0),
    "screening free-form laws": _coarse("screening free-form laws", 0.04, 0, 220),
    "free-form laws": _coarse("fitting free-form laws", 0.4, 0, 6),
    "screening richer free-form laws": _coarse("screening richer free-form laws", 0.03, 0, 20),
    "richer free-form laws": _coarse("fitting richer free-form laws", 0.2, 0, 6),
    "screening effects without a law": _coarse("screening effects without a free-form law", 0.02, 0, 28),
    "screening effects beside a free-form law": _coarse(
        "screening effects beside a free-form law", 0.03, 0, 24
    ),
    "free-form laws in pairs and beside an effect": _coarse(
        "fitting free-form laws in pairs", 0.3, 0, 12
    ),
    "three free-form laws": _coarse("fitting three free-form laws", 1.5, 0, 4),
    "finalists, free-form laws": _whole("fitting the best free-form laws to the whole log", 1.5, 0, 4),
    "plain laws": _whole("fitting plain laws like the free-form ones", 1.2, 0, 4),
}
"""Times and numbers of tasks are rounded from six logs: one without any effect, two with one, one with
three, two that nothing explains. Only the estimate of the time that is left depends on them."""
_OF_NO_KNOWN = Usual(words="")


_SCREENING = "screening "  # and the name of a stage: before its fits


def usual(stage: str) -> Usual:
    """What is usual of a stage; of one that is not known, that it takes no time."""
    return STAGES.get(stage, _OF_NO_KNOWN)


def in_words(stage: str) -> str:
    """A stage as people say what is done in it."""
    if words := usual(stage).words:
        return words
    of = usual(stage.removeprefix(_SCREENING)).words.removeprefix("fitting ")
    if not of:
        return stage
    return f"{_SCREENING}{'effects ' if of.startswith('with') else ''}{of}"
