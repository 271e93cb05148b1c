"""An assessment whose explanation is a free-form law, which gives readings, gap and residual."""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from diagnosis.assessment.assessment import Assessment
from diagnosis.assessment.gap_reduction import gap_reduction
from diagnosis.assessment.sensor_errors import sensor_errors
from diagnosis.fitting.noise_reestimation import in_units_of
from diagnosis.fitting.problem import FitProblem
from diagnosis.freeform.fits.held_out_check import determined_by_others
from diagnosis.freeform.missing.in_words import next_step
from diagnosis.freeform.missing.missing import Missing
from diagnosis.log.rig_log import RigLog
from diagnosis.nominal_replay import at_samples, nominal_residuals
from diagnosis.prepare.prepared_log import PreparedLog
from diagnosis.replay.drift import with_drift
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.twist import ShaftTwist, shaft_twist
from diagnosis.residuals.residual_breakdown import residual_breakdown
from diagnosis.residuals.residual_shape import residual_shape
from diagnosis.residuals.trial_residual import trial_residuals

Array = NDArray[np.float64]


def explained_by(
    missing: Missing,
    log: RigLog,
    problem: FitProblem,
    nominal: Sequence[Prediction],
    nearest: Assessment,
) -> Assessment:
    """The assessment with the law in place of the nearest explanation.

    Args:
      problem: the log, with the noise that the assessment is based on.
      nominal: readings of the nominal rig by trial of the problem.

    Raises:
      SimulationFailed: the rig with the law cannot be simulated.
    """
    fit = missing.best.fit
    rig = fit.parameterization.rig(fit.x)
    predictions = replay(problem.log, rig, problem.resolution)
    explained = at_samples(problem, with_drift(problem.log, problem.noise, predictions))
    left = trial_residuals(log, explained, problem.noise)
    plain = problem.noise.uncoloured
    before = nominal_residuals(replace(problem, noise=plain), nominal)
    after = in_units_of(problem, _after(missing, before), plain)
    return replace(
        nearest,
        gap=gap_reduction(before, after),
        # Imperfections of the nearest explanation are not in the fit of the law.
        sensors=sensor_errors(problem, rig, predictions, {}),
        explained=explained,
        twist=_twist(problem.log, rig, nearest.twist),
        breakdown_after=residual_breakdown(left),
        shape_after=residual_shape(left),
        next_experiment=next_step(missing),
    )


def _twist(log: PreparedLog, rig: RigParameters, at: ShaftTwist | None) -> ShaftTwist | None:
    """The shape of the shaft with the law at the moment of another one; None: there is none."""
    if at is None:
        return None
    return shaft_twist(log, at.trial, at.at_s, {"nominal": NOMINAL, "explained": rig})


def _after(missing: Missing, before: Sequence[Array]) -> tuple[Array, ...]:
    """What the law leaves of trials that its fit has not seen, where others tell anything of these.

    Beyond the rates, depths or times of the others a curve may go anywhere: there what is left of the
    trials of the fit counts; and everywhere, where led on it leaves more than the nominal rig, and that
    is no surprise.
    """
    best = missing.best
    if best.held_out is None or (missing.closed and _rms(best.held_out) > _rms(before)):
        return best.fit.by_trial
    each = enumerate(zip(best.held_out, best.fit.by_trial, strict=True))
    return tuple(np.where(determined_by_others(best.fit, i), unseen, seen) for i, (unseen, seen) in each)


def _rms(by_trial: Sequence[Array]) -> float:
    values = np.concatenate(by_trial)
    return float(np.sqrt(np.mean(values**2)))
