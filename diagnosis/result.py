"""The result of a diagnosis: everything that a report is made of."""

from dataclasses import dataclass
from datetime import date

import pandas as pd

from diagnosis.assessment.assessment import Assessment
from diagnosis.freeform.missing.missing import Missing
from diagnosis.in_sigma import in_sigma
from diagnosis.log.rig_log import RigLog
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.replay.prediction import Prediction
from diagnosis.selection.record import Decision, RecordEntry
from diagnosis.selection.verdicts.verdict import Verdict
from diagnosis.stopping import EarlyStop
from sim.recording.html_table import html_table


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """The result of a diagnosis.

    Attributes:
      nominal: readings that the nominal rig predicts, at the samples of the log, by trial.
      record: record of the search, stage by stage.
      missing: for an unknown log, what the library lacks; None: not searched for.
      stopped: what an early stop left out; None: the diagnosis was completed.
      diagnosed_on: date of the diagnosis, as given by the caller; None: not given.
    """

    log: RigLog
    noise: Noise
    nominal: list[Prediction]
    verdict: Verdict
    assessment: Assessment
    record: tuple[RecordEntry, ...]
    missing: Missing | None = None
    stopped: EarlyStop | None = None
    diagnosed_on: date | None = None

    @property
    def warnings(self) -> tuple[str, ...]:
        """Warnings about an early stop, the log, its noise, the search and the replay."""
        return (
            *([self.stopped.warning] if self.stopped else ()),
            *self.log.warnings,
            *self.noise.notes,
            *self._failures,
            *self.assessment.warnings,
        )

    def _repr_html_(self) -> str:
        """Verdict, parameters and warnings, for a notebook; the report has more."""
        tables = [html_table(self._in_short, self._parameters)]
        if self.warnings:
            tables.append(html_table("warnings", pd.DataFrame({"": self.warnings})))
        return "".join(tables)

    @property
    def _in_short(self) -> str:
        verdict, gap = self.verdict, self.assessment.gap
        early = f"stopped early ({self.stopped.why}), best so far: " if self.stopped else ""
        named = " ".join([verdict.kind.value, " + ".join(verdict.effects)]).strip()
        return (
            f"{early}{named}; residual {in_sigma(gap.before)} → {in_sigma(gap.after)} (σ = sensor noise)"
        )

    @property
    def _parameters(self) -> pd.DataFrame:
        rows = {
            f"{effect} {name}": (p.value, p.low, p.high, p.unit)
            for effect, own in self.assessment.parameters.items()
            for name, p in own.items()
        }
        columns = ["value", "low, 95 %", "high, 95 %", "unit"]
        return pd.DataFrame.from_dict(rows, orient="index", columns=columns)

    @property
    def _failures(self) -> tuple[str, ...]:
        """Failed simulations, once for each set of effects."""
        lost = {e.effects: e for e in self.record if e.decision is Decision.FAILED}
        return tuple(
            f"{' with '.join(names) or 'the nominal rig'}: not fully tried ({entry.stage}): "
            f"{entry.reason}"
            for names, entry in lost.items()
        )
