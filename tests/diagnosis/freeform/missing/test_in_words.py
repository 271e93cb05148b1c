"""What is missing, in plain words."""

from dataclasses import replace

import numpy as np
import pytest
from diagnosis_fixtures import turns
from free_forms import LAW, covered, free_fit, linear_fit, missing_with

from diagnosis.effects import LIBRARY
from diagnosis.effects.effect import Place
from diagnosis.freeform.families import families_of
from diagnosis.freeform.families.angle import families as families_over_angles
from diagnosis.freeform.family import TRIALS
from diagnosis.freeform.fits.free_fit import FreeFit
from diagnosis.freeform.missing.course import course_of
from diagnosis.freeform.missing.in_words import DOUBT, laws_of, repeating, what_is_missing


def test_place_variable_course_and_gap_are_in_the_sentence():
    said = what_is_missing(missing_with(best=seen_fit()), 8.9)
    assert said.startswith(
        "What is missing acts between shaft and tissue (probability 0.90) and depends "
        "on the rate of turning: friction along the shaft rises from"
    )
    assert "A free-form law of this kind reduces the residual from 8.90 σ to 1.03 σ on trials" in said
    # What could not be simulated on an unseen trial has no gap to tell.
    assert "the best laws of other variables leave 2.50 σ with the time." in said


def test_a_place_that_is_nearly_as_likely_is_told():
    place = {**dict.fromkeys(Place, 0.01), Place.INTERFACE: 0.55, Place.TISSUE: 0.41}
    said = what_is_missing(replace(missing_with(best=seen_fit()), place=place), 8.9)
    assert said.startswith(
        "What is missing acts between shaft and tissue (probability 0.55; in the tissue: 0.41)"
    )


def test_a_place_that_is_likelier_than_that_of_the_law_comes_first():
    places = dict.fromkeys(Place, 0.08) | {Place.INTERFACE: 0.29, Place.TISSUE: 0.37}
    said = what_is_missing(missing_with(place=places), 8.9)
    assert (
        "acts in the tissue (probability 0.37) or between shaft and tissue (0.29), whose law leaves "
        "least, and depends on"
    ) in said


def test_gaps_of_the_decimated_log_are_not_told_beside_those_of_the_log_itself():
    """Means have less noise: in sigma, they leave more than the nominal rig does on all samples."""
    told = missing_with(best=seen_fit())
    first, *others = told.depends_on
    behind = (first, *(replace(one, decimated=True) for one in others))
    assert "other variables" not in what_is_missing(replace(told, depends_on=behind), 8.9)


def seen_fit():
    """A fit that was checked on unseen trials."""
    return replace(free_fit(1.03, says="rate"), held_out=(LAW.x,))


def test_only_a_law_of_a_periodic_family_repeats_itself():
    """The curve over a turn, waves in the tissue, and curves over the range of the log."""
    angle = turns()
    seen = (0.9 * angle, 0.02 * angle)
    families = families_of(covered(angle, tip=angle, torque=0.01 * angle, seen=seen))
    turn = replace(LAW, x=(-180.0, 0.0, 180.0))
    found = {
        family.name: laws_of(missing_with(turn, best=fit_of(family)))[0][1]
        for family in families
        if family.says in ("tip_angle", "rate", "base_angle")
    }
    assert found["tip reading over tip_angle, every 360 deg"] == pytest.approx(360.0)
    assert found["tip torque over tip_angle"] == pytest.approx(360.0)
    assert found["tip reading over tip_angle"] == 0.0
    assert found["tip torque over tip_angle, over many turns"] == 0.0
    assert {round(period) for name, period in found.items() if "rate" in name} == {0}


def test_a_law_that_is_known_over_less_than_a_turn_is_not_said_to_repeat():
    (around,) = (
        f for f in families_over_angles(covered(turns())) if f.name == "tip torque over tip_angle"
    )
    half = replace(LAW, x=(-90.0, 0.0, 90.0))
    assert laws_of(missing_with(half, best=fit_of(around)))[0][1] == 0.0


def test_that_a_law_repeats_is_said():
    assert repeating(60.0) == ", and repeats every 60 deg"
    assert repeating(0.0) == ""


def fit_of(family):
    """A fit of a family, with every coordinate a tenth of its scale."""
    names = family.effect.parameters
    x = [0.1 * p.scale for p in names]
    fit = linear_fit(family, [np.eye(len(names))], [np.zeros(len(names))], x)
    return FreeFit(family=family, fit=fit, gap_after=1.0, final=True)


def test_effects_beside_a_law_are_named():
    said = what_is_missing(missing_with(replace(LAW, beside=("tip_drag", "torque_bias"))), 8.9)
    each = " and ".join(LIBRARY[name].title for name in ("tip_drag", "torque_bias"))
    assert f"A free-form law of this kind, beside {each}, reduces" in said


def test_laws_that_were_fitted_together_are_told_one_by_one():
    other = replace(LAW, place=Place.TISSUE, variable="time", title="stiffness of the tissue")
    best = replace(seen_fit(), others=(free_fit(1.0, name="other").family,))
    said = what_is_missing(missing_with(beside=(other,), best=best), 8.9)
    assert f"depends on the rate of turning: {course_of(LAW)}. Another law is needed as well, " in said
    assert (
        f"in the tissue; it depends on the time: {course_of(other)}. Together they reduce the residual"
        in said
    )
    assert "with the time" not in said  # as if that were enough
    third = replace(best, others=(*best.others, *best.others))
    said = what_is_missing(missing_with(beside=(other, other), best=third), 8.9)
    assert said.index("Another law is needed as well, ") < said.index(
        "Yet another law is needed as well, "
    )


ONE_MORE = "one between shaft and tissue that depends on the rate of turning"


@pytest.mark.parametrize(
    ("beside", "said"),
    [
        ((), "A free-form law of this kind reduces the residual from 89.0 σ to 23.0 σ"),
        ((LAW,), f"This law, with {ONE_MORE}, reduces the residual from 89.0 σ to 23.0 σ"),
        (
            (LAW, LAW),
            f"This law, with {ONE_MORE} and {ONE_MORE}, reduces the residual from 89.0 σ to 23.0 σ",
        ),
    ],
)
def test_laws_that_leave_far_more_than_noise_are_hints(beside, said):
    best = replace(
        seen_fit(), others=tuple(free_fit(1.0, name=str(i)).family for i in range(len(beside)))
    )
    missing = missing_with(beside=beside, best=best)
    far = replace(missing.depends_on[0], gap_after=23.0)
    told = what_is_missing(replace(missing, depends_on=(far, *missing.depends_on[1:])), 89.0)
    assert said in told
    assert "still far above the noise: take the curve as a hint only" in told
    assert "another law" not in told
    assert "hint" not in what_is_missing(missing, 89.0)


def test_far_above_the_noise_places_have_no_probabilities():
    missing = missing_with(best=seen_fit())
    far = replace(missing.depends_on[0], gap_after=23.0)
    told = what_is_missing(replace(missing, depends_on=(far,)), 89.0)
    assert told.startswith("What is missing acts most likely between shaft and tissue and depends on")
    assert "probability" not in told


@pytest.mark.parametrize(
    ("after", "told"),
    [
        (
            3.2,
            "to 3.20 σ on trials that the fit has not seen, "
            "1.03 times what noise and the band account for",
        ),
        (1.05, "to 1.05 σ on trials that the fit has not seen;"),
    ],
)
def test_what_the_band_of_a_loose_curve_allows_is_told_beside_the_residual(after, told):
    assert told in what_is_missing(missing_with(best=seen_fit()), 8.9, after)


def test_an_effect_of_the_library_beside_laws_that_leave_far_more_than_noise_is_told():
    missing = missing_with(beside=(LAW,), best=replace(seen_fit(), others=(free_fit(1.0).family,)))
    far = replace(missing.depends_on[0], gap_after=23.0)
    beside = replace(missing, law=replace(missing.law, beside=("tip_drag",)), depends_on=(far,))
    told = what_is_missing(beside, 89.0)
    assert f"This law, beside viscous drag at the tip, with {ONE_MORE}, reduces the residual" in told


def test_that_a_law_grows_with_another_variable_is_told():
    factor = replace(LAW, variable="time", title="factor of the friction", unit="-", multiplies=True)
    law = seen_fit()
    best = replace(law, family=replace(law.family, factor=replace(law.family, multiplies=True)))
    said = what_is_missing(missing_with(beside=(factor,), best=best), 8.9)
    assert (
        f"It is multiplied by a factor that depends on the time: {course_of(factor)}. Together" in said
    )
    assert "another law" not in said


def test_of_a_single_trial_nothing_is_called_unseen():
    said = what_is_missing(missing_with(), 8.9)
    assert "not seen" not in said
    assert "1.03 σ on the trials of the fit" in said


def test_of_what_happened_once_nothing_is_called_unseen():
    best = seen_fit()
    effect = replace(best.family.effect, trial="trial_02.csv")
    once = replace(best, family=replace(best.family, effect=effect))
    assert "not seen" not in what_is_missing(missing_with(best=once), 8.9)


def test_of_what_has_a_phase_of_its_own_in_each_trial_nothing_is_called_unseen():
    best = seen_fit()
    assert "of the rest" not in what_is_missing(missing_with(best=best), 8.9)
    assert "not seen" in what_is_missing(missing_with(best=best), 8.9)
    told = what_is_missing(missing_with(best=best, determined_share=0.57), 8.9)
    assert "not seen (57 % of the readings; of the rest" in told
    effect = best.family.effect
    own = tuple(replace(p, of_one_trial=True) for p in effect.parameters)
    waves = replace(best, family=replace(best.family, effect=replace(effect, parameters=own)))
    assert "not seen" not in what_is_missing(missing_with(best=waves), 8.9)


def test_where_no_trial_tells_of_the_law_of_another_nothing_is_called_unseen():
    said = what_is_missing(missing_with(best=seen_fit(), determined_share=0.02), 8.9)
    assert "not seen" not in said
    assert "on the trials of the fit" in said


def test_where_no_law_helps_the_sentence_says_what_to_doubt():
    said = what_is_missing(missing_with(law=None), 8.9)
    assert said.startswith("No free-form law that was tried does better than the library.")
    assert DOUBT in said
    assert "probability" not in said


@pytest.mark.parametrize(
    ("shape", "said"),
    [
        ("", "The law looks like a straight line"),
        ("straight line", "The law is fitted as a straight line"),
    ],
)
def test_a_plain_law_is_told_as_what_was_fitted(shape, said):
    line = {"variable": "time", "x": (0.0, 1.0, 2.0, 3.0), "y": (1.0, 2.0, 3.0, 4.0)}
    band = {"low": (0.9, 1.9, 2.9, 3.9), "high": (1.1, 2.1, 3.1, 4.1)}
    assert said in what_is_missing(missing_with(replace(LAW, **line, **band, shape=shape)), 8.9)


def test_beside_another_law_one_of_the_library_is_not_what_it_lacks():
    """A reading of the tip that is off along a line is a gain and an offset of its sensor."""
    x = tuple(np.linspace(0.0, 90.0, 24))
    y, low, high = (tuple(0.05 * np.array(x) + 2.0 + band) for band in (0.0, -0.01, 0.01))
    line = replace(LAW, place=Place.SENSOR, variable="tip_angle", unit="deg", x_unit="deg", x=x)
    line = replace(line, y=y, low=low, high=high)
    alone = what_is_missing(missing_with(line), 8.9)
    other = replace(LAW, variable="time", title="friction")
    best = replace(seen_fit(), others=(free_fit(1.0, name="other").family,))
    both = what_is_missing(missing_with(line, beside=(other,), best=best), 8.9)
    known = "law looks like a straight line, as tip_angle_scale and tip_angle_bias in the library"
    assert f"The {known}: " in alone
    assert f"The first {known}; what the library lacks is what acts beside it: " in both


def test_a_name_that_begins_with_a_vowel_has_its_article():
    x = np.arange(9.0)
    y = 1.0 + np.exp(-x / 2.0)
    law = replace(
        LAW, variable="time", x=tuple(x), y=tuple(y), low=tuple(y - 0.01), high=tuple(y + 0.01)
    )
    assert "looks like an exponential approach" in what_is_missing(missing_with(law), 8.9)


def test_what_a_log_does_not_determine_is_not_told_as_a_range():
    """Two places of a ratio that the data leave open, among others that they tell."""
    x = tuple(float(i) for i in range(8))
    y = (1.0, 1.1, 1.2, 1.1, 1.0, 0.9, 50.0, 9e4)
    band = (0.1,) * 6 + (1e3, 1e6)
    low, high = ([a + sign * b for a, b in zip(y, band, strict=True)] for sign in (-1, 1))
    law = replace(LAW, x=x, y=y, low=tuple(low), high=tuple(high), unit="-", title="stiffness")
    assert course_of(law) == "stiffness varies between 0.9 and 1.2"


def test_a_law_of_trials_is_told_from_trial_to_trial():
    law = replace(
        LAW,
        x=(1.0, 2.0, 3.0),
        y=(0.1, 0.2, 0.4),
        low=(0.1, 0.2, 0.4),
        high=(0.1, 0.2, 0.4),
        x_unit=TRIALS,
    )
    assert course_of(law).endswith("rises from 0.1 to 0.4 N mm / mm from trial 1 to trial 3")
