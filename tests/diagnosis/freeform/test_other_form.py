"""An effect explains nothing where a free-form law of its kind leaves clearly less."""

from dataclasses import replace
from types import SimpleNamespace

import pytest
from diagnosis_fixtures import joined, log_of, start_of_search

from diagnosis.effects import LIBRARY
from diagnosis.fitting.fit import fit_effects
from diagnosis.fitting.fit_status import Termination
from diagnosis.freeform import other_form as module
from diagnosis.freeform.families import families_of
from diagnosis.freeform.fits.free_fit import with_family
from diagnosis.freeform.other_form import other_form
from diagnosis.freeform.ranges import ranges_of
from diagnosis.nominal_replay import replay_nominal
from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.curve import ActsOn, Curve
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.replay import replay
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from diagnosis.replay.variables import Variable
from diagnosis.selection.screening import screen
from diagnosis.workers import Workers
from models.tissue import Interface, Section

LAYERED = RigParameters(layer_ratio=0.2, layer_boundary_fraction=0.5)
EVENLY = RigParameters(free=FreeLaw(along_depth=AlongDepth(damping=(1.9, 1.54, 1.18, 0.82, 0.46, 0.1))))

DRY = RigParameters(kinetic_n_mm_per_mm=0.003)
DEEPER = RigParameters(
    free=FreeLaw(
        along_depth=AlongDepth(
            friction_n_mm_per_mm=(0.0, 0.0005, 0.001, 0.003, 0.005, 0.008), thickness_mm=26.0
        )
    )
)


def reading_of_torque(values):
    """A torque sensor with an error that depends on the torque: values at three torques."""
    curve = Curve(
        acts_on=ActsOn.TORQUE_READING, variable=Variable.TORQUE, places=(-5.0, 0.0, 5.0), values=values
    )
    return RigParameters(free=FreeLaw(curves=(curve,)))


DEPTHS_MM = (40.0, 90.0, 160.0)


def fitted(rig, names=("layered_tissue",)):
    """The first replay of a rig's log, and a fit of the named effects."""
    trials = [log_of(rig, seed=i, seconds=8.0, deep_mm=depth) for i, depth in enumerate(DEPTHS_MM)]
    nominal = replay_nominal(joined(*trials))
    problem, base = nominal.problem, nominal.fit
    first = fit_effects(problem, names[:1], screen(problem, base, names[0])[0].start)
    start = problem.parameterization(names).joined(first.parts)
    return nominal, fit_effects(problem, names, start)


def form_of(nominal, best):
    found = other_form(nominal, best, Workers())
    return found and found.family


def test_two_layers_are_refuted_where_damping_changes_evenly_along_the_shaft():
    form = other_form(*fitted(EVENLY), Workers())
    assert form.family.name == "damping over position"
    assert form.in_words.endswith(" leaves clearly less")


def test_two_layers_stand_where_there_are_two():
    assert form_of(*fitted(LAYERED)) is None


def test_dry_friction_is_refuted_where_it_grows_with_the_depth():
    assert (
        form_of(*fitted(DEEPER, ("coulomb_friction",))).name == "dry friction over position, in layers"
    )


def test_dry_friction_stands_where_it_is_even():
    assert form_of(*fitted(DRY, ("coulomb_friction",))) is None


def test_another_form_alone_refutes_an_effect_that_needs_another():
    pair = ("layered_tissue", "torque_bias")
    assert form_of(*fitted(EVENLY, pair)).name == "damping over position"


def test_a_damping_that_is_off_does_not_refute():
    """Curves along the depth could take its place."""
    found = fitted(replace(LAYERED, damping_scale=1.04), ("layered_tissue", "damping_error"))
    assert form_of(*found) is None


def test_two_effects_that_are_there_stand():
    both = replace(LAYERED, torque_bias_n_mm=0.05)
    assert form_of(*fitted(both, ("layered_tissue", "torque_bias"))) is None


def test_a_gain_of_the_torque_sensor_stands_though_stiffness_damping_and_tissue_imitate_it():
    """These are three effects, and the gain and the tissue are two."""
    elastic = LIBRARY["tissue_viscoelasticity"].apply(NOMINAL, 0.3, 0.3)
    both = replace(elastic, torque_scale=0.965)
    assert form_of(*fitted(both, ("tissue_viscoelasticity", "torque_scale"))) is None


def test_an_effect_stands_beside_an_imperfection_that_is_there():
    """Without the filter of the torque, a stiffness that changes takes the place of a part of it."""
    elastic = LIBRARY["tissue_viscoelasticity"].apply(RigParameters(torque_low_pass_s=0.0025), 0.06, 0.2)
    assert form_of(*fitted(elastic, ("tissue_viscoelasticity", "torque_low_pass"))) is None


def test_an_imperfection_that_compensates_for_the_wrong_form_saves_no_effect():
    pair = ("layered_tissue", "torque_clock")
    assert form_of(*fitted(EVENLY, pair)).name == "damping over position"


def test_a_power_law_stands_where_it_is_one():
    assert form_of(*fitted(RigParameters(rate_exponent=0.6), ("shear_thinning",))) is None


@pytest.mark.parametrize("dry", ["coulomb_friction", "speed_dependent_friction"])
def test_dry_friction_beside_a_power_law_stands_though_a_curve_over_the_rate_has_it_for_a_part(dry):
    """The curve alone leaves as little as both; so it says nothing against two. Nothing slides here."""
    both = RigParameters(rate_exponent=0.6, kinetic_n_mm_per_mm=0.0005)
    assert form_of(*fitted(both, ("shear_thinning", dry))) is None


def test_a_curve_over_the_rate_begins_as_the_power_law_that_it_replaces():
    """Straight lines between twelve rates leave a little; without the law it is some hundred times."""
    nominal, best = fitted(RigParameters(rate_exponent=0.6), ("shear_thinning",))
    coarse = start_of_search(nominal.log, ()).coarse
    families = {f.name: f for f in families_of(ranges_of(coarse, replay(coarse.log)))}
    family = families["friction over rate"]
    own = with_family(coarse, family)
    parts = {**best.parts, family.name: module._begun(best, coarse, "shear_thinning", family)}
    costs = []
    for names in (("shear_thinning",), (family.name,)):
        parameterization = own.parameterization(names)
        rig = parameterization.rig(parameterization.joined(parts))
        costs.append(sum(float(left[0] @ left[0]) for left in own.residuals([rig])))
    assert costs[1] < 1.25 * costs[0]
    assert sum(float(left[0] @ left[0]) for left in own.residuals([NOMINAL])) > 20 * costs[0]


def test_a_gain_of_the_torque_sensor_is_refuted_where_only_positive_torques_have_it():
    found = fitted(reading_of_torque((0.0, 0.0, 0.2)), ("torque_scale",))
    assert form_of(*found).name == "torque reading over torque"


def test_a_gain_of_the_torque_sensor_stands_where_all_torques_have_it():
    assert form_of(*fitted(reading_of_torque((-0.2, 0.0, 0.2)), ("torque_scale",))) is None


def test_drag_at_the_tip_is_refuted_where_a_section_behind_it_is_rough():
    """Which it imitates beside a shaft that is shorter by what lies in front of it."""
    section = Section(interface=Interface(viscous_n_mm_s_per_mm=0.03), from_tip_mm=5.0, length_mm=25.0)
    rig = RigParameters(free=FreeLaw(sections=(section,)))
    form = other_form(*fitted(rig, ("tip_drag", "inserted_offset")), Workers())
    assert form.family.name == "damping over position, in one section of the shaft"
    assert form.in_words == (
        "additional damping along the shaft that depends on the place along the shaft "
        "leaves about as little alone"
    )


def test_drag_at_the_tip_stands_where_it_is_there():
    rig = RigParameters(tip_drag_n_mm_s_per_rad=0.3, inserted_offset_mm=4.0)
    assert form_of(*fitted(rig, ("tip_drag", "inserted_offset"))) is None


def test_an_effect_of_which_no_other_form_is_named_is_not_compared(monkeypatch):
    monkeypatch.setattr("diagnosis.freeform.other_form.families_of", pytest.fail)
    assert form_of(*fitted(RigParameters(torque_bias_n_mm=0.05), ("torque_bias",))) is None


@pytest.mark.parametrize(
    ("costs", "found"),
    [
        ((40.0,), 40.0),  # near enough at once
        ((90.0, 60.0, 45.0), 45.0),  # from a nearly straight curve
        ((90.0, None), None),  # not even that comes near
    ],
)
def test_a_form_is_begun_as_it_is_and_then_nearly_straight(costs, found, monkeypatch):
    left = iter(costs)

    def from_there(*_, **__):
        cost = next(left)
        termination = Termination.OFFSET if cost else Termination.BEHIND
        return SimpleNamespace(cost=cost, status=SimpleNamespace(termination=termination))

    monkeypatch.setattr(module, "_from", from_there)
    monkeypatch.setattr(module, "with_family", lambda *_: None)
    monkeypatch.setattr(module, "_begun", lambda *_: None)
    family = SimpleNamespace(name="form", with_prior=lambda *_: None)
    known = SimpleNamespace(names=("layered_tissue", "tip_drag"))
    compared = module._Comparison(
        problem=None, coarse=None, best=None, known=known, family=family, replaced="layered_tissue"
    )
    form = compared._on_the_decimated_log(("form",), 50.0)
    assert (form.cost if form else None) == found
    assert next(left, None) is None


def test_forms_that_effects_name_are_families():
    log = joined(*(log_of(LAYERED, deep_mm=depth) for depth in DEPTHS_MM))
    coarse = start_of_search(log, ()).coarse
    known = {f.name for f in families_of(ranges_of(coarse, replay(coarse.log)))}
    named = [form for effect in LIBRARY.values() for form in effect.other_forms]
    assert named
    assert {*named} <= known
