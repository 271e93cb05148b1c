"""A family fitted to a log: its score, and its place in the library of a problem."""

from dataclasses import replace
from functools import partial

import numpy as np
import pytest
from free_forms import family_of, free_fit, one_trial

from diagnosis.freeform.fits.free_fit import with_family
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_shaft import FreeShaft
from diagnosis.replay.rig_parameters import NOMINAL


def test_a_score_is_a_cost_in_its_own_units_and_a_penalty_for_what_data_determine():
    simple, free = (free_fit(1.0, freedom=n) for n in (1, 4))
    given = {"by_trial": (np.full(100, 1.0),), "jacobian": (np.zeros((100, 1)),), "cost": 100.0}
    one = replace(simple, fit=replace(simple.fit, **given))
    assert one.score == pytest.approx(np.log(100), abs=1e-6)  # a level without a prior counts whole
    loud = replace(one, fit=replace(one.fit, cost=200.0))
    assert loud.score - one.score == pytest.approx(100 * np.log(2))
    beside = replace(one, beside=("tip_drag",))
    assert beside.score - one.score == pytest.approx(2 * np.log(100))
    free_given = given | {"jacobian": (np.zeros((100, 4)),)}
    four = replace(free, fit=replace(free.fit, **free_given))
    assert four.score - one.score == pytest.approx(3 * np.log(100), abs=1e-6)


def test_a_law_more_costs_what_an_effect_does_and_what_the_data_determine_of_it():
    one = free_fit(1.0, freedom=1)
    given = {"by_trial": (np.full(100, 1.0),), "jacobian": (np.zeros((100, 1)),), "cost": 100.0}
    one = replace(one, fit=replace(one.fit, **given))
    two = replace(one, others=(one.family,))
    assert two.score - one.score == pytest.approx(3 * np.log(100), abs=1e-6)
    assert two.names == (one.family.name, one.family.name)
    assert replace(two, beside=("tip_drag",)).names[-1] == "tip_drag"


def test_families_in_one_rig_add_to_each_other():
    problem, _ = one_trial(np.linspace(0, 90, 200), tip=np.zeros(200))
    sided, stiff = FreeLaw(asymmetry=0.2), FreeLaw(shaft=FreeShaft(creep_ratio=0.1))
    families = [
        replace(own, effect=replace(own.effect, apply=partial(_with, law)))
        for own, law in ((family_of(name="sided"), sided), (family_of(name="stiff"), stiff))
    ]
    library = with_family(problem, *families).library
    both = library["stiff"].apply(library["sided"].apply(NOMINAL))
    assert both.free == sided.beside(stiff)
    alone = with_family(problem, families[0]).library["sided"].apply(NOMINAL)
    assert alone.free == sided


def _with(law, rig, *_):
    return replace(rig, free=law)


def test_a_family_is_fitted_as_an_effect_of_the_library():
    problem, _ = one_trial(np.linspace(0, 90, 200), tip=np.zeros(200))
    own, family = with_family(problem, family_of(name="mine")), family_of(name="mine")
    assert own.library["mine"].parameters == family.effect.parameters
    assert set(own.library) == {*problem.library, "mine"}
    assert "mine" not in problem.library


def test_a_law_of_all_trials_leads_numbers_of_each():
    common, each = free_fit(1.0, freedom=1), free_fit(1.0, freedom=1).family
    parameters = tuple(replace(p, of_one_trial=True) for p in each.effect.parameters)
    each = replace(each, effect=replace(each.effect, parameters=parameters, name="offsets"))
    mixed = replace(common, family=each, others=(common.family,))
    led = mixed.with_its_law_first
    assert (led.family, led.others) == (common.family, (each,))
    assert led.with_its_law_first.names == led.names
    alone = replace(common, family=each)
    assert alone.with_its_law_first.family is each
