"""The cases of a campaign: case k does not depend on their number, on their order or on the engine.

Cases go through the points of the grid, the last path fastest; case k draws from
`SeedSequence([seed, k])`. More samples are more rounds through the grid: they add cases at the end.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from models.errors import InvalidValue, NeedleError
from sim.protocol import Protocol
from studies.campaign.campaign import Campaign, Kind
from studies.campaign.dotted import replaced


@dataclass(frozen=True, kw_only=True)
class Case:
    """A case to run.

    Attributes:
      varied: values of what varies, by dotted path.
      protocol: None if the values are refused, or for a diagnosis; the motion for a posterior.
      refused: reason why there is no protocol; empty if there is one.
      log: folder of the log, for a diagnosis.
    """

    number: int
    varied: dict[str, Any] = field(default_factory=dict)
    protocol: Protocol | None = None
    refused: NeedleError | None = None
    log: str | None = None


def case_count(campaign: Campaign) -> int:
    """Number of cases."""
    if campaign.kind is Kind.DIAGNOSIS:
        return len(campaign.logs)
    return campaign.samples * math.prod(_grid_shape(campaign))


def pieces(campaign: Campaign) -> list[range]:
    """Numbers of the cases of each piece; a piece is computed and written at once."""
    count, size = case_count(campaign), campaign.cases_per_piece
    return [range(first, min(first + size, count)) for first in range(0, count, size)]


def cases_of(campaign: Campaign, numbers: Sequence[int]) -> list[Case]:
    """The cases with these numbers."""
    if campaign.kind is Kind.DIAGNOSIS:
        return [Case(number=number, log=campaign.logs[number]) for number in numbers]
    base = _plain(campaign)
    return [_case(campaign, base, number) for number in numbers]


def _case(campaign: Campaign, base: dict[str, Any], number: int) -> Case:
    varied = varied_values(campaign, number)
    if campaign.posterior:
        return Case(number=number, varied=varied, protocol=campaign.base)
    try:
        return Case(number=number, varied=varied, protocol=_protocol(base, varied))
    except NeedleError as refused:
        return Case(number=number, varied=varied, refused=refused)


def varied_values(campaign: Campaign, number: int) -> dict[str, Any]:
    """Values of what varies in a case, by path or parameter."""
    rng = np.random.default_rng(np.random.SeedSequence([campaign.seed, number]))
    if campaign.posterior:
        return campaign.posterior.drawn(rng)
    shape = _grid_shape(campaign)
    point = iter(np.unravel_index(number % math.prod(shape), shape)) if shape else iter(())
    return {
        path: variation.drawn(rng) if variation.steps is None else variation.steps[int(next(point))]
        for path, variation in campaign.vary.items()
    }


def check_values(campaign: Campaign) -> None:
    """Refuse paths that do not exist, and values that the base protocol does not accept.

    Raises:
      InvalidValue: names the path and the value.
    """
    paths = list(campaign.vary)
    for path in paths:
        inside = [other for other in paths if other.startswith(f"{path}.")]
        if inside:
            raise InvalidValue(
                f"vary.{path}", inside[0], "no other path inside this one", "vary one of the two"
            )
    base = _plain(campaign) if paths else {}
    for path, variation in campaign.vary.items():
        for value in variation.support:
            _check(base, path, value)


def _check(base: dict[str, Any], path: str, value: Any) -> None:
    content = replaced(base, path, value)
    try:
        Protocol(**content).setup().nodes_mm  # noqa: B018 - a mesh may be impossible
    except NeedleError as refused:
        fix = "remove it, or choose a base that accepts it"
        raise InvalidValue(
            f"vary.{path}", value, f"a value that the base accepts ({refused})", fix
        ) from None


def _protocol(base: dict[str, Any], varied: dict[str, Any]) -> Protocol:
    content: Any = base
    for path, value in varied.items():
        content = replaced(content, path, value)
    return Protocol(**content)


def _plain(campaign: Campaign) -> dict[str, Any]:
    if campaign.base is None:
        raise InvalidValue("base", None, "a protocol")
    return campaign.base.model_dump(mode="json")


def _grid_shape(campaign: Campaign) -> tuple[int, ...]:
    """Number of values along each grid."""
    return tuple(len(v.steps) for v in campaign.vary.values() if v.steps is not None)
