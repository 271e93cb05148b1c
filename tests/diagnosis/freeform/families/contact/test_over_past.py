"""Free laws of the past of a contact: where they become effects of the library, they are these."""

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import DAMPING, VOCABULARY, covered, same_readings

from diagnosis.effects import LIBRARY
from diagnosis.freeform.families.contact.over_past import families
from diagnosis.replay.rig_parameters import NOMINAL
from models.contact import CONTACT_POINTS

ANGLE = turns(6.0)
RANGES = covered(ANGLE, tip=ANGLE)
FAMILIES = {family.name: family for family in families(RANGES)}
LEVEL, SCALE, RENEWAL = 0.001, 1.2, 3.0
DRY = LIBRARY["coulomb_friction"].apply(NOMINAL, LEVEL)
LEVEL_CURVE = (0.0,) * CONTACT_POINTS


def rig_of(name, *values):
    return FAMILIES[name].effect.apply(NOMINAL, *values)


def test_damping_times_a_constant_is_damping_of_another_size():
    thick = LIBRARY["damping_error"].apply(NOMINAL, SCALE)
    assert same_readings(ANGLE, rig_of("damping over slip", *LEVEL_CURVE), NOMINAL)
    constant = (np.log(SCALE), *LEVEL_CURVE[1:])
    assert same_readings(ANGLE, rig_of("damping over slip", *constant), thick)
    falling = (0.0, -0.5, *LEVEL_CURVE[2:])
    assert not same_readings(ANGLE, rig_of("damping over slip", *falling), NOMINAL)


def test_damping_over_heat_is_the_nominal_one_where_its_curve_is_level():
    law, fading_s = "damping over heat", 2.0
    assert same_readings(ANGLE, rig_of(law, fading_s, *LEVEL_CURVE), NOMINAL)
    rising = (0.0, 0.5, *LEVEL_CURVE[2:])
    heated = rig_of(law, fading_s, *rising)
    assert not same_readings(ANGLE, heated, NOMINAL)
    assert not same_readings(ANGLE, heated, rig_of(law, 10.0 * fading_s, *rising))
    assert {len(p.start) for p in FAMILIES[law].effect.parameters} == {2}


def test_damping_over_what_is_broken_follows_what_breaks_and_what_heals_it():
    law, memory = "damping over broken", (40.0, 2.0)
    assert same_readings(ANGLE, rig_of(law, *memory, *LEVEL_CURVE), NOMINAL)
    falling = (0.0, -1.0, *LEVEL_CURVE[2:])
    weaker = rig_of(law, *memory, *falling)
    for other in ((4.0, 2.0), (40.0, 0.5)):
        assert not same_readings(ANGLE, weaker, rig_of(law, *other, *falling))
    assert {len(p.start) for p in FAMILIES[law].effect.parameters} == {4}


@pytest.mark.parametrize("law", ["damping over aligned", "dry friction over aligned"])
def test_what_depends_on_how_fibres_lie_follows_the_slip_that_lays_them(law):
    """The curve tells how much less they resist along their lie than against it."""
    level = (LEVEL,) if law.startswith("dry") else ()
    same = DRY if level else NOMINAL
    assert same_readings(ANGLE, rig_of(law, *level, 30.0, *LEVEL_CURVE), same)
    falling = (0.0, -1.0, *LEVEL_CURVE[2:])
    laid = rig_of(law, *level, 30.0, *falling)
    assert not same_readings(ANGLE, laid, rig_of(law, *level, 300.0, *falling))
    assert not same_readings(ANGLE, laid, same)
    share, torque = FAMILIES[law].curve(*level, 30.0, *falling)
    assert (share[0], share[-1]) == pytest.approx((0.0, 1.0))
    assert torque[0] > torque[-1]
    assert {len(p.start) for p in FAMILIES[law].effect.parameters} == {4}


@pytest.mark.parametrize(
    ("name", "own"),
    [("slip", ()), ("age", (RENEWAL,)), ("broken", (RENEWAL, 2.0)), ("aligned", (RENEWAL,))],
)
def test_dry_friction_times_a_constant_is_that_of_the_library(name, own):
    law = f"dry friction over {name}"
    assert same_readings(ANGLE, rig_of(law, LEVEL, *own, *LEVEL_CURVE), DRY)
    constant = (np.log(SCALE), *LEVEL_CURVE[1:])
    assert same_readings(ANGLE, rig_of(law, LEVEL / SCALE, *own, *constant), DRY)
    rising = (0.0, 0.5, *LEVEL_CURVE[2:])
    assert not same_readings(ANGLE, rig_of(law, LEVEL, *own, *rising), DRY)


def test_how_much_slip_renews_a_contact_matters():
    rising = (0.0, 1.0, *LEVEL_CURVE[2:])
    one, other = (rig_of("dry friction over age", LEVEL, d, *rising) for d in (1.0, 30.0))
    assert not same_readings(ANGLE, one, other)


def test_curves_are_told_in_the_units_of_the_needle():
    slip_deg, damping = FAMILIES["damping over slip"].curve(*LEVEL_CURVE)
    np.testing.assert_allclose(damping, DAMPING)
    turned_deg = np.abs(np.diff(ANGLE)).sum()
    assert (slip_deg[0], slip_deg[-1]) == pytest.approx((0.0, turned_deg), rel=0.02)
    age_s, level = FAMILIES["dry friction over age"].curve(LEVEL, RENEWAL, *LEVEL_CURVE)
    np.testing.assert_allclose(level, LEVEL)
    assert age_s[-1] == pytest.approx(RANGES.ends["time"][1])
    assert {family.says for family in FAMILIES.values()} == {"history"} <= VOCABULARY


def test_a_base_that_hardly_turns_has_no_law_of_the_slip():
    still = families(covered(0.001 * ANGLE, tip=ANGLE))
    assert [family.name for family in still] == ["dry friction over age"]
