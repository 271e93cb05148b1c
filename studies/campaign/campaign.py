"""A campaign: what is run, what varies, and how often. One YAML file."""

import hashlib
from enum import StrEnum
from pathlib import Path
from typing import Annotated, Any

import mujoco
import yaml
from pydantic import Field, field_validator, model_validator

from models.drive import DriveKind
from models.errors import InvalidValue
from models.needle import Positive
from models.record import Record
from sim.paper_protocols import protocol_named
from sim.protocol import Protocol, read_protocol
from studies.campaign.posterior.rig_posterior import RigPosterior, read_posterior
from studies.campaign.variation import Variation
from studies.control.tip_controllers import TIP_CONTROLLERS

_SPREAD_OVER = 100  # cases of the usual piece: a piece is written whole, or run again


class Kind(StrEnum):
    """What one case of a campaign is."""

    INSERTION = "insertion"
    CONTROL = "control"
    DIAGNOSIS = "diagnosis"
    POSTERIOR = "posterior"
    """An insertion of a rig that is drawn from what a diagnosis knows of it."""


_VARIES_ITSELF = {
    Kind.DIAGNOSIS: "its cases are the logs",
    Kind.POSTERIOR: "its cases are drawn rigs, which all make the same motion",
}


class Campaign(Record):
    """Many cases of one kind: grids are crossed, distributions are drawn anew for each case."""

    name: str
    kind: Kind
    base: Protocol | None = None
    """The protocol that cases change: a name, or its fields. None for a diagnosis."""
    controller: str | None = None
    """Of the tip, for kind control."""
    posterior: RigPosterior | None = None
    """What rigs are drawn from, for kind posterior."""
    logs: tuple[str, ...] = ()
    """Folders of logs, for kind diagnosis."""
    limit_s: Positive | None = None
    """Time for each diagnosis; results then depend on the machine."""
    vary: dict[str, Variation] = Field(default_factory=dict)
    """By dotted path into the protocol."""
    samples: Annotated[int, Field(ge=1)] = 1
    """Draws for each point of the grid."""
    seed: Annotated[int, Field(ge=0)] = 0
    cases_per_piece: Annotated[int, Field(ge=1)] = _SPREAD_OVER

    @field_validator("base", mode="before")
    @classmethod
    def _base_by_name(cls, value: Any) -> Any:
        return protocol_named(value) if isinstance(value, str) else value

    @model_validator(mode="after")
    def _fits_its_kind(self) -> "Campaign":
        diagnosed = self.kind is Kind.DIAGNOSIS
        for name, wanted in (
            ("base", not diagnosed),
            ("controller", self.kind is Kind.CONTROL),
            ("logs", diagnosed),
            ("posterior", self.kind is Kind.POSTERIOR),
        ):
            if bool(getattr(self, name)) != wanted:
                expected = "a value" if wanted else "nothing"
                raise InvalidValue(name, getattr(self, name), f"{expected} for kind {self.kind.value}")
        if self.vary and self.kind in _VARIES_ITSELF:
            why = f"nothing for kind {self.kind.value}: {_VARIES_ITSELF[self.kind]}"
            raise InvalidValue("vary", list(self.vary), why)
        if self.posterior and self.base and self.base.drive.kind is DriveKind.TORQUE:
            raise InvalidValue(
                "base.drive.kind",
                "torque",
                "angle, because kind posterior prescribes the angle of the base",
            )
        if self.controller and self.controller not in TIP_CONTROLLERS:
            raise InvalidValue("controller", self.controller, "one of " + ", ".join(TIP_CONTROLLERS))
        if self.limit_s and not diagnosed:
            raise InvalidValue("limit_s", self.limit_s, "nothing, except for kind diagnosis")
        return self._draws_as_often_as_it_says()

    def _draws_as_often_as_it_says(self) -> "Campaign":
        drawn = [path for path, variation in self.vary.items() if variation.steps is None]
        if self.samples > 1 and not drawn and not self.posterior:
            raise InvalidValue(
                "samples", self.samples, "1, because nothing is drawn: all samples would be the same"
            )
        return self

    @property
    def varied(self) -> tuple[str, ...]:
        """Names of what varies: paths into the protocol, or parameters of a posterior."""
        return self.posterior.parameters if self.posterior else tuple(self.vary)

    @property
    def fingerprint(self) -> str:
        """Digest of all that a case depends on; not of the number of samples, which may grow."""
        about = f"{self.model_dump_json(exclude={'samples'})} MuJoCo {mujoco.__version__}"
        return hashlib.sha256(about.encode()).hexdigest()[:16]

    def as_yaml(self) -> str:
        """The campaign as YAML, with paths and defaults; its first line ends in the fingerprint."""
        content = self.model_dump(mode="json", exclude_none=True)
        note = f"# resolved campaign, computed with MuJoCo {mujoco.__version__}; {self.fingerprint}\n"
        return note + yaml.safe_dump(content, sort_keys=False, width=100)


def read_campaign(path: Path, *, samples: int | None = None) -> Campaign:
    """Read and check a campaign; paths in it are relative to its file.

    Args:
      samples: replaces the number in the file; None: as in the file.

    Raises:
      InvalidValue: names the field.
    """
    try:
        content = yaml.safe_load(path.read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, yaml.YAMLError) as error:
        raise InvalidValue(str(path), str(error).splitlines()[0], "a readable YAML file") from error
    if not isinstance(content, dict):
        raise InvalidValue(str(path), content, "a mapping of the fields of a campaign")
    base = content.get("base")
    if isinstance(base, str) and base.endswith((".yaml", ".yml")):
        content["base"] = read_protocol(path.parent / base)
    if isinstance(content.get("posterior"), str):
        content["posterior"] = read_posterior(path.parent / content["posterior"])
    if "logs" in content:
        content["logs"] = _folders(content["logs"], path.parent)
    return Campaign(**content | ({} if samples is None else {"samples": samples}))


def _folders(patterns: Any, beside: Path) -> tuple[str, ...]:
    """Folders of logs that match the patterns, sorted."""
    found: set[Path] = set()
    for pattern in [patterns] if isinstance(patterns, str) else patterns:
        inside = Path(pattern).is_absolute()
        folders = Path("/").glob(pattern.lstrip("/")) if inside else beside.glob(pattern)
        logs = [folder.resolve() for folder in folders if (folder / "rig.yaml").is_file()]
        if not logs:
            raise InvalidValue("logs", pattern, "a pattern that finds folders with a rig.yaml")
        found.update(logs)
    return tuple(str(folder) for folder in sorted(found))
