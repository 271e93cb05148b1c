"""Contenders that are fitted to their end, alone and beside another law."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import log_of, problem_of
from free_forms import priors

from diagnosis.fitting.fit import fit_effects
from diagnosis.freeform.families import families_of
from diagnosis.freeform.fits.first_fit import first_fit
from diagnosis.freeform.fits.full_fit import begun_only, full_fit
from diagnosis.freeform.ranges import ranges_of
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import RigParameters
from diagnosis.replay.variables import Variable

GAIN = Curve(
    acts_on=ActsOn.TIP_READING, variable=Variable.TIME, places=(0.0, 4.0, 8.0), values=(0.0, 3.0, -2.0)
)
SOFTER = Curve(
    acts_on=ActsOn.TISSUE, variable=Variable.TIME, places=(0.0, 4.0, 8.0), values=(1.0, 1.6, 0.7)
)


@pytest.fixture(scope="module")
def found():
    """First fits of two families of a log that has both laws."""
    rig = RigParameters(free=FreeLaw(curves=(GAIN, SOFTER), tissue_varies=True))
    problem = problem_of(log_of(rig, seconds=8.0))
    named = {f.name: f for f in families_of(ranges_of(problem, replay(problem.log)))}
    base = fit_effects(problem, ())
    wanted = ("damping over time", "tip reading over time")
    return problem, [first_fit(problem, base, named[name]) for name in wanted]


def test_alone_neither_comes_near_and_together_they_leave_the_noise(found):
    problem, (damping, reading) = found
    alone = [full_fit(problem, one) for one in (damping, reading)]
    both = full_fit(problem, replace(alone[0], others=(reading.family,)))
    assert min(one.fit.gap for one in alone) > 2.0
    assert both.fit.gap == pytest.approx(1.0, abs=0.1)
    assert both.names == both.fit.names == (damping.family.name, reading.family.name)
    # The strength of either prior is estimated from the common fit.
    for family, first in zip(both.families, (damping, reading), strict=True):
        assert (priors(family) != priors(first.family)).any()


def test_a_fit_that_would_be_of_no_use_is_given_up(found):
    problem, (damping, _) = found
    given_up = full_fit(problem, damping, enough=1e-3)
    assert given_up.fit.status.ended_early
    np.testing.assert_array_equal(priors(given_up.family), priors(damping.family))


def test_it_goes_on_from_where_a_few_iterations_ended_and_stays_where_it_is_at_its_end(found):
    problem, (damping, reading) = found
    both = replace(damping, others=(reading.family,))
    begun = begun_only(problem, both)
    ended = full_fit(problem, begun)
    assert begun.fit.names == both.names
    assert ended.fit.gap <= begun.fit.gap + 1e-3  # with another prior
    assert ended.fit.gap == pytest.approx(full_fit(problem, both).fit.gap, abs=1e-3)
    again = full_fit(problem, ended)
    assert again.fit.gap == pytest.approx(ended.fit.gap, abs=1e-3)
