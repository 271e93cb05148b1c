"""The posterior of a rig after a diagnosis: the nominal rig, and parameters with their covariance.

Rigs are drawn in the coordinates of the fit: normal in a parameter, or in its logarithm if the fit
varied that,

    C_fit = C / (s_i s_j),    s = value of a parameter that is fitted in its logarithm, else 1;

truncated to the bounds: values outside of them are drawn again.
"""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from pydantic import model_validator

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Parameter
from diagnosis.log.nominal_rig import NominalRig
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from models.errors import InvalidValue
from models.needle import Positive
from models.record import Record
from sim.discretisation import PRESLIDING_DEG

Array = NDArray[np.float64]

_TRIES = 10_000  # for one draw within the bounds
_SYMMETRIC = 1e-6  # of the standard deviations
_AGAIN = "diagnose the log again with this version, and use the report.json that it writes"


class RigPosterior(Record):
    """Parameters of a rig and their covariance, in the units of a report."""

    rig: NominalRig
    parameters: tuple[str, ...]
    """As effect.parameter."""
    values: tuple[float, ...]
    bounds: tuple[tuple[float, float], ...]
    matrix: tuple[tuple[float, ...], ...]
    """Covariance."""
    presliding_deg: Positive = PRESLIDING_DEG
    """Angle by which dry friction gives before it slides."""

    @model_validator(mode="after")
    def _is_whole(self) -> "RigPosterior":
        n = len(self.parameters)
        if not n:
            raise InvalidValue("parameters", [], "at least one fitted parameter")
        for name in self.parameters:
            _parameter(name)
        sizes = {len(self.values), len(self.bounds), len(self.matrix), *map(len, self.matrix)}
        if sizes != {n}:
            raise InvalidValue(
                "matrix", sorted(sizes), f"{n} values, bounds and rows of {n}, for {n} parameters"
            )
        spread = np.array(self.matrix)
        variance = np.diag(spread)
        slack = _SYMMETRIC * np.sqrt(np.outer(variance, variance).clip(min=0))
        if (variance < 0).any() or (np.abs(spread - spread.T) > slack).any():
            raise InvalidValue("matrix", self.matrix, "a symmetric covariance")
        below = (np.array(self.values) <= 0) & self._logarithmic
        if below.any():
            raise InvalidValue("values", self.values, f"{self.parameters[below.argmax()]} above 0")
        return self

    @property
    def _logarithmic(self) -> NDArray[np.bool_]:
        return np.array([_parameter(name).logarithmic for name in self.parameters])

    @property
    def _root(self) -> Array:
        """R with R R' = C_fit."""
        slopes = np.where(self._logarithmic, self.values, 1.0)
        size, axes = np.linalg.eigh(np.array(self.matrix) / np.outer(slopes, slopes))
        return np.asarray(axes * np.sqrt(np.maximum(size, 0.0)))

    @property
    def fitted(self) -> dict[str, float]:
        """Parameter values of the most probable rig, by name."""
        return dict(zip(self.parameters, self.values, strict=True))

    def drawn(self, rng: np.random.Generator) -> dict[str, float]:
        """Parameter values of a drawn rig, by name.

        Raises:
          InvalidValue: none of many draws lies within the bounds.
        """
        fit, low, high = np.array(self.values), *np.array(self.bounds).T
        for _ in range(_TRIES):
            away = self._root @ rng.standard_normal(fit.size)
            with np.errstate(over="ignore"):
                values = np.where(self._logarithmic, fit * np.exp(away), fit + away)
            if ((low <= values) & (values <= high)).all():
                return dict(zip(self.parameters, values.tolist(), strict=True))
        raise InvalidValue(
            "posterior",
            self.parameters,
            f"bounds that contain at least one of {_TRIES} draws",
            "see at_bound in report.json: a parameter is at its bound",
        )

    def rig_with(self, values: dict[str, float]) -> RigParameters:
        """The rig with these parameter values; others of the same effects are at their first start."""
        rig = replace(NOMINAL, presliding_deg=self.presliding_deg)
        for effect in dict.fromkeys(name.partition(".")[0] for name in values):
            own = LIBRARY[effect]
            each = (values.get(f"{effect}.{p.name}", p.start[0]) for p in own.parameters)
            rig = own.apply(rig, *each)
        return rig


def _parameter(name: str) -> Parameter:
    effect, _, parameter = name.partition(".")
    known = {p.name: p for p in LIBRARY[effect].parameters} if effect in LIBRARY else {}
    if parameter not in known:
        raise InvalidValue("parameters", name, "effect.parameter of docs/effects.md")
    return known[parameter]


def read_posterior(path: Path) -> RigPosterior:
    """The posterior of the rig in a `report.json`.

    Raises:
      InvalidValue: the file is no report, or one of an earlier version, without covariance.
    """
    try:
        report = json.loads(path.read_text(encoding="utf-8"))
        content = {"rig": report["rig"], **report["covariance"]}
        held = report.get("fit") or {}
        content["presliding_deg"] = held.get("presliding_deg", PRESLIDING_DEG)
    except (OSError, ValueError, RecursionError) as error:
        raise InvalidValue(str(path), str(error), "the report.json of a diagnosis") from error
    except (KeyError, TypeError, AttributeError) as error:
        raise InvalidValue(
            str(path),
            "a file without these fields",
            "a report.json with the fields rig and covariance",
            _AGAIN,
        ) from error
    return RigPosterior(**content)
