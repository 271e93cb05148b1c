"""What swings at one frequency is no noise, though its colour be that of noise."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, problem_of

from diagnosis.criteria.noise import SWINGS_SHARE
from diagnosis.fitting.swinging import swinging_hz, swinging_where_coloured
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.replay.rig_parameters import NOMINAL

STEP_S, SECONDS, TRIALS = 0.01, 30.0, 4
TIME = np.arange(0.0, SECONDS, STEP_S)
COLOUR = NoiseColour.of(share=0.5, correlation_time_s=0.3)


def noise(seed):
    """Noise of that colour."""
    return COLOUR.restored(TIME, np.random.default_rng(seed).normal(size=TIME.size))


def swing(hertz, size, phase):
    """Pulses, as of a heart."""
    return size * (np.cos(2 * np.pi * hertz * TIME + phase) > 0.7)


def told(values):
    white = [(TIME, COLOUR.whitened(TIME, own)) for own in values]
    return swinging_hz(white, [(TIME, own) for own in values])


@pytest.mark.parametrize("seed", range(20))
def test_coloured_noise_does_not_swing(seed):
    assert told([noise(TRIALS * seed + i) for i in range(TRIALS)]) == 0.0


@pytest.mark.parametrize("hertz", [0.4, 1.33, 3.1])
def test_pulses_are_told_by_a_multiple_of_their_frequency_whatever_their_phase(hertz):
    """Coloured noise hides the lowest lines most."""
    found = told([noise(i) + swing(hertz, 1.5, 2.0 * i) for i in range(TRIALS)])
    multiple = round(found / hertz)
    assert multiple > 0
    assert found == pytest.approx(multiple * hertz, abs=0.5 / SECONDS)


def test_a_line_that_is_little_of_the_noise_is_left_to_it():
    size = np.sqrt(0.2 * SWINGS_SHARE)
    values = [noise(i) + size * np.sin(2 * np.pi * 1.3 * TIME + i) for i in range(TRIALS)]
    assert told(values) == 0.0


def test_what_comes_a_few_times_in_a_trial_is_of_its_motion():
    values = [noise(i) + 1.5 * np.sin(2 * np.pi * 3 / SECONDS * TIME) for i in range(TRIALS)]
    assert told(values) == 0.0


def test_only_sensors_whose_noise_is_coloured_are_asked():
    problem = problem_of(log_of(NOMINAL, seconds=30.0))
    ((left,),) = problem.residuals([NOMINAL])
    (trial,) = problem.log.trials
    swung = left + np.tile(1.5 * np.sin(2 * np.pi * 1.3 * trial.time_s), 2)
    assert swinging_where_coloured(problem, [swung]) == {}
    coloured = replace(problem, noise=replace(problem.noise, colour={"tip_angle_deg": COLOUR}))
    ((left,),) = coloured.residuals([NOMINAL])
    rows = left.size // 2
    swung = left.copy()
    swung[rows:] += COLOUR.whitened(trial.time_s, 1.5 * np.sin(2 * np.pi * 1.3 * trial.time_s))
    assert swinging_where_coloured(coloured, [swung]) == {"tip_angle_deg": pytest.approx(1.3, abs=0.02)}
