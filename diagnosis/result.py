"""Everything that a report is made of."""

from dataclasses import dataclass
from datetime import date

from diagnosis.assessment.assess import Assessment
from diagnosis.log.rig_log import RigLog
from diagnosis.prepare.noise.sensor_noise import Noise
from diagnosis.replay.replay import Prediction
from diagnosis.selection.record import Decision, RecordEntry
from diagnosis.selection.verdict import Verdict
from diagnosis.stopping import EarlyStop


@dataclass(frozen=True, kw_only=True)
class Diagnosis:
    """What a log says of its rig.

    Attributes:
      nominal: readings that the nominal rig predicts, at the samples of the log, by trial.
      record: of the search, stage by stage.
      stopped: what a stop left out; None: it went to its end.
      diagnosed_on: the day of the diagnosis, as whoever asked for it says; None: not said.
    """

    log: RigLog
    noise: Noise
    nominal: list[Prediction]
    verdict: Verdict
    assessment: Assessment
    record: tuple[RecordEntry, ...]
    stopped: EarlyStop | None = None
    diagnosed_on: date | None = None

    @property
    def warnings(self) -> tuple[str, ...]:
        """Of a stop, of the log, of its noise, of the search and of the replay."""
        return (
            *([self.stopped.warning] if self.stopped else ()),
            *self.log.warnings,
            *self.noise.notes,
            *self._failures,
            *self.assessment.warnings,
        )

    @property
    def _failures(self) -> tuple[str, ...]:
        """What could not be simulated, once for each set of effects."""
        lost = {e.effects: e for e in self.record if e.decision is Decision.FAILED}
        return tuple(
            f"{' with '.join(names) or 'the nominal rig'}: not fully tried ({entry.stage}): "
            f"{entry.reason}"
            for names, entry in lost.items()
        )
