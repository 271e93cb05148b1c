"""Whether the report on one log is right, and whether it is confidently wrong.

A report is exact if its verdict and its set of effects are those of the ground truth. Errors of
stiffness or damping of up to 3 % beside an effect may be named or not. If the laws make two effects
indistinguishable in the log, so that no method could decide, the exact report is `undecided` with the
truth among the confusable sets; this is also exact if a rough recording or a wrong constant may hide
the effects. For a trial with the wrong sign, a refusal that names trial and column is exact.

A report is confidently wrong if its verdict is `explained` or `none`, and not true. Naming a set
that no log can tell from the truth is not wrong, unless it has more effects than the truth (which only
happen to be equal to it) and the report names no alternative.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from validation.logs.schedule import PLAIN_KINDS

SAME_AT_REST = {"coulomb_friction", "speed_dependent_friction"}
"""The same law where the needle never slides."""
PARAMETER_ERRORS = {"stiffness_error", "damping_error"}
"""Without the base torque only their ratio is identifiable."""
TOLERATED = 0.03
"""Error of a nominal constant that may be named or not: no rig knows its constants better."""


@dataclass(frozen=True, kw_only=True)
class Correctness:
    """The comparison of a report with the ground truth.

    Attributes:
      confused: `undecided`, with the truth among the confusable sets.
      undecidable: no trial can distinguish the true effect from another one.
    """

    exact: bool
    confidently_wrong: bool
    confused: bool
    undecidable: bool


def correctness(
    answer: Mapping[str, Any], report: Mapping[str, Any], trials: int | None = None
) -> Correctness:
    """Compare a report with the ground truth of its log; `trials` as in `read_scores`."""
    true, verdict = set(answer["effects"]), report["verdict"]
    optional = optional_effects(answer)
    named = set(report["effects"]) - optional
    equal = [set(names) for names in answer.get("acceptable", [])]
    may_be = [set(names) - {"none"} - optional for names in report.get("confusable", [])]
    confused = verdict == "undecided" and true - optional in may_be
    undecidable = _is_undecidable(answer, trials)
    right = verdict == answer["verdict"] and named == true - optional
    may_stay_open = bool(equal) or answer.get("kind") in PLAIN_KINDS
    left_open = verdict == "undecided" and any(s - optional in may_be for s in (true, *equal))
    simple_enough = [s for s in equal if len(s) <= len(true) or true - optional in may_be]
    so = right or any(named == s - optional for s in simple_enough)
    told = true - optional in may_be  # beside `explained`, of laws that coincide
    return Correctness(
        exact=confused
        if undecidable
        else right or (may_stay_open and left_open) or _refused_rightly(answer, report),
        confidently_wrong=verdict in ("explained", "none") and not so and not (undecidable and told),
        confused=confused,
        undecidable=undecidable,
    )


def optional_effects(answer: Mapping[str, Any]) -> set[str]:
    """Effects that may be named or not: small errors of stiffness and damping beside another effect."""
    true = set(answer["effects"])
    scales = {n: p["scale"] for n, p in answer["parameters"].items() if n in PARAMETER_ERRORS}
    return {
        name
        for name, scale in scales.items()
        if name not in true or (len(true) > 1 and abs(scale - 1.0) <= TOLERATED)
    }


def _is_undecidable(answer: Mapping[str, Any], trials: int | None) -> bool:
    details, true = answer.get("details", {}), set(answer["effects"])
    used = details.get("trials", [{"sliding": True}])[:trials]
    at_rest = not any(trial["sliding"] for trial in used)
    without_torque = details.get("missing") == "base_torque_n_mm"
    return (bool(SAME_AT_REST & true) and at_rest) or (bool(PARAMETER_ERRORS & true) and without_torque)


def _refused_rightly(answer: Mapping[str, Any], report: Mapping[str, Any]) -> bool:
    """Whether the log was refused for the reason that the ground truth states."""
    reason = answer.get("refusal", [])
    return bool(reason) and report["verdict"] == "refused" and all(w in report["why"] for w in reason)
