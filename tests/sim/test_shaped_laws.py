"""Laws beyond the usual ones, against closed forms.

Turned steadily, every place of a shaft in viscous tissue turns at the rate of its base, so that the
base torque is damping * length * rate times whatever shapes the law. At rest in tissue that prefers an
orientation, a short stiff shaft takes torque sin(cycles theta - phase) per mm.
"""

import math

import numpy as np
import pytest
from scipy.optimize import brentq

from models.drive import Drive
from models.errors import InvalidValue
from models.needle import STIFFNESS_POINTS, Needle
from models.tissue import RATE_POINTS, Interface, Layer, Section, Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.kernel import memory_map
from sim.needles.run import Run
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

DAMPING, LENGTH_MM, RATE = 0.017, 60.0, 0.8
NEEDLE = Needle(diameter_mm=0.59, shear_modulus_gpa=27.2, density_g_cm3=6.45)


def turned(
    tissue: Tissue,
    *,
    rate: float = RATE,
    factor: float = 1.0,
    needle: Needle = NEEDLE,
    drive: Drive | None = None,
) -> Run:
    """A run at a constant rate; to a constant angle at rate 0."""
    time_s = np.linspace(0.0, 6.0, 601)
    drive_deg = np.degrees(rate) * time_s
    return run_of(tissue, time_s, drive_deg, np.full(time_s.shape, factor), needle, drive)


def run_of(
    tissue: Tissue,
    time_s: np.ndarray,
    drive_deg: np.ndarray,
    factor: np.ndarray,
    needle: Needle = NEEDLE,
    drive: Drive | None = None,
) -> Run:
    setup = Setup(
        needle=needle,
        tissue=tissue,
        drive=drive or Drive(),
        free_mm=10.0,
        inserted_mm=LENGTH_MM,
        discretisation=Discretisation(elements=16, step_s=0.01, arrangement=Arrangement.SIBLINGS),
    )
    inputs = Schedule(
        time_s=time_s,
        drive=drive_deg,
        free_mm=np.full(time_s.shape, 10.0),
        inserted_mm=np.full(time_s.shape, LENGTH_MM),
        speed_mm_s=np.zeros(time_s.shape),
        tissue_factor=factor,
    )
    return simulate([setup], inputs)[0]


def steady_n_mm(run: Run) -> float:
    return float(run.base_torque_n_mm[-1])


PLAIN_N_MM = DAMPING * LENGTH_MM * RATE


def test_the_factor_of_time_scales_tissue_that_varies_and_no_other() -> None:
    varies = Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING, varies=True)
    assert steady_n_mm(turned(varies, factor=1.7)) == pytest.approx(1.7 * PLAIN_N_MM, rel=1e-6)
    still = Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING)
    assert steady_n_mm(turned(still, factor=1.7)) == pytest.approx(PLAIN_N_MM, rel=1e-6)


def test_it_may_scale_the_stiffness_of_yielding_tissue_alone() -> None:
    """Twice the stiffness at the same time constant; the friction at the shaft stays as it is."""

    def tissue(stiffness: float, **changes: bool) -> Tissue:
        elastic = {"stiffness_n_mm_per_rad_per_mm": stiffness, "time_constant_s": 0.5}
        return Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING, **elastic, **changes)

    scaled = turned(tissue(0.01, stiffness_varies=True), factor=2.0).base_torque_n_mm
    stiffer, all_scaled = (
        turned(tissue(0.02)).base_torque_n_mm,
        turned(tissue(0.01, varies=True), factor=2.0).base_torque_n_mm,
    )
    np.testing.assert_allclose(scaled, stiffer, rtol=0, atol=1e-9)
    assert np.abs(scaled - all_scaled).max() > 0.1 * np.abs(scaled).max()


def test_the_viscosity_of_yielding_tissue_goes_along_with_its_stiffness_or_stays() -> None:
    """Three times the stiffness at sqrt(3) of the viscosity, k tau, or at the same."""

    def torque(factor: float, **elastic: float) -> np.ndarray:
        tissue = Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING, stiffness_varies=True, **elastic)
        return turned(tissue, factor=factor).base_torque_n_mm

    stiffer = {"stiffness_n_mm_per_rad_per_mm": 0.03}
    scaled = {"stiffness_n_mm_per_rad_per_mm": 0.01, "time_constant_s": 0.5}
    for follows in (0.0, 0.5):
        expected = torque(1.0, time_constant_s=0.5 * 3.0**follows / 3.0, **stiffer)
        varied = torque(3.0, viscosity_exponent=follows, **scaled)
        np.testing.assert_allclose(varied, expected, rtol=0, atol=1e-9)
        assert np.abs(varied - torque(3.0, **scaled)).max() > 0.01 * np.abs(varied).max()


@pytest.mark.parametrize("time_constant_s", [0.0, 0.3])
def test_tissue_that_flows_bears_no_more_and_gives_back_what_it_bore(time_constant_s: float) -> None:
    """Steadily, beta s = Y + k tau (omega - s) for its shaft's slip s, whichever way it turns."""
    k, flows_at_deg = 0.02, 20.0
    elastic = {"stiffness_n_mm_per_rad_per_mm": k, "time_constant_s": time_constant_s}
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING, flows_at_deg=flows_at_deg, **elastic)
    most, viscosity = k * math.radians(flows_at_deg), k * time_constant_s
    slip = (most + viscosity * RATE) / (DAMPING + viscosity)
    for rate in (RATE, -RATE):
        expected = math.copysign(DAMPING * slip * LENGTH_MM, rate)
        assert steady_n_mm(turned(tissue, rate=rate)) == pytest.approx(expected, rel=1e-6)
    time_s = np.linspace(0.0, 30.0, 3001)
    there_and_back = np.interp(time_s, (0.0, 4.0, 5.0, 6.0), np.degrees(RATE) * np.array([0, 4, 4, 3.7]))
    run = run_of(tissue, time_s, there_and_back, np.ones(time_s.shape))
    # Half a minute is 30 time constants beta / k: what it bore at rest turned the shaft's slip back.
    assert run.base_torque_n_mm[500] > 0.1 * expected
    assert abs(run.base_torque_n_mm[-1]) < 1e-6


def test_tissue_that_never_gets_so_far_as_to_flow_is_elastic() -> None:
    elastic = {"stiffness_n_mm_per_rad_per_mm": 0.02, "time_constant_s": 0.3}
    far, never = (
        turned(Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING, **elastic, **flows)).base_torque_n_mm
        for flows in ({"flows_at_deg": 360.0}, {})
    )
    np.testing.assert_allclose(far, never, rtol=0, atol=1e-8)


@pytest.mark.parametrize("rate", [RATE, -RATE])
def test_asymmetry_is_stronger_one_way(rate: float) -> None:
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING, asymmetry=0.3)
    expected = (1 + math.copysign(0.3, rate)) * math.copysign(PLAIN_N_MM, rate)
    assert steady_n_mm(turned(tissue, rate=rate)) == pytest.approx(expected, rel=1e-6)


def test_dry_friction_over_the_inserted_length_may_be_asymmetric() -> None:
    dry = Interface(kinetic_n_mm_per_mm=0.002, asymmetry=-0.4)
    base = Layer(interface=Interface(viscous_n_mm_s_per_mm=DAMPING))
    tissue = Tissue(layers=(base,), throughout=(dry,))
    for rate, level in ((RATE, 0.6), (-RATE, 1.4)):
        expected = math.copysign(PLAIN_N_MM + level * 0.002 * LENGTH_MM, rate)
        assert steady_n_mm(turned(tissue, rate=rate)) == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize("rate", [0.03, 0.3, 0.8, 20.0])
@pytest.mark.parametrize("count", [2, 12, RATE_POINTS])
def test_the_rate_curve_is_followed_between_and_beyond_its_places(count: int, rate: float) -> None:
    factors = tuple(np.geomspace(3.0, 0.4, count) * (1.0 + 0.1 * np.sin(np.arange(count))))
    tissue = Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING, rate_curve=factors)
    places = np.linspace(math.log(0.01), math.log(10.0), count)
    factor = math.exp(np.interp(math.log(rate), places, np.log(factors)))
    expected = factor * DAMPING * LENGTH_MM * rate
    assert steady_n_mm(turned(tissue, rate=rate)) == pytest.approx(expected, rel=1e-5)


def test_a_law_at_the_tip_acts_there_alone() -> None:
    """Twist between base and tip is torque over stiffness: rate * drag * length / rigidity."""
    none = Layer(interface=Interface())
    law = Interface(viscous_n_mm_s_per_mm=0.5, kinetic_n_mm_per_mm=0.1)
    run = turned(Tissue(layers=(none,), at_tip=(law,)))
    torque = 0.5 * RATE + 0.1
    assert steady_n_mm(run) == pytest.approx(torque, rel=1e-5)
    lag_deg = math.degrees(torque * (10.0 + LENGTH_MM) / NEEDLE.rigidity_n_mm2)
    assert run.base_deg[-1] - run.tip_deg[-1] == pytest.approx(lag_deg, rel=1e-4)


@pytest.mark.parametrize(("from_tip_mm", "inside_mm"), [(20.0, 30.0), (LENGTH_MM - 10.0, 10.0)])
def test_a_law_of_a_section_acts_where_that_is_inserted(from_tip_mm: float, inside_mm: float) -> None:
    """A torque per length t over a length l, whose middle is x from the chuck, twists by t l x / GJ."""
    law = Interface(viscous_n_mm_s_per_mm=0.02, kinetic_n_mm_per_mm=0.004)
    section = Section(interface=law, from_tip_mm=from_tip_mm, length_mm=30.0)
    run = turned(Tissue(layers=(Layer(interface=Interface()),), sections=(section,)))
    torque = (0.02 * RATE + 0.004) * inside_mm
    assert steady_n_mm(run) == pytest.approx(torque, rel=1e-5)
    middle_mm = 10.0 + LENGTH_MM - from_tip_mm - inside_mm / 2.0
    lag_deg = math.degrees(torque * middle_mm / NEEDLE.rigidity_n_mm2)
    assert run.base_deg[-1] - run.tip_deg[-1] == pytest.approx(lag_deg, rel=1e-2)


def test_a_law_where_the_shaft_enters_acts_there_alone() -> None:
    """The free shaft is twisted by its torque, the inserted one is not."""
    law = Interface(viscous_n_mm_s_per_mm=0.5, kinetic_n_mm_per_mm=0.1)
    run = turned(Tissue(layers=(Layer(interface=Interface()),), at_entry=(law,)))
    torque = 0.5 * RATE + 0.1
    assert steady_n_mm(run) == pytest.approx(torque, rel=1e-5)
    lag_deg = math.degrees(torque * 10.0 / NEEDLE.rigidity_n_mm2)
    assert run.base_deg[-1] - run.tip_deg[-1] == pytest.approx(lag_deg, rel=1e-4)


def test_a_law_in_the_sheath_acts_along_the_free_shaft_alone() -> None:
    """A torque per length t over the free length L twists the tip by t L^2 / (2 rigidity)."""
    law = Interface(viscous_n_mm_s_per_mm=0.5, kinetic_n_mm_per_mm=0.1)
    none = Tissue(layers=(Layer(interface=Interface()),))
    run = turned(none, drive=Drive(in_sheath=(law,)))
    per_mm = 0.5 * RATE + 0.1
    assert steady_n_mm(run) == pytest.approx(per_mm * 10.0, rel=1e-5)
    lag_deg = math.degrees(per_mm * 10.0**2 / (2.0 * NEEDLE.rigidity_n_mm2))
    # Eight elements, each with its torque in the middle: exact to (1/8)^2 / 3.
    assert run.base_deg[-1] - run.tip_deg[-1] == pytest.approx(lag_deg, rel=6e-3)


def test_a_torque_that_depends_on_the_angle_twice_a_turn() -> None:
    law = Interface(orientation_n_mm_per_mm=0.05, orientation_cycles=2.0, orientation_phase_deg=20.0)
    damped = Interface(viscous_n_mm_s_per_mm=0.5)
    tissue = Tissue(layers=(Layer(interface=Interface()),), at_tip=(law, damped))
    time_s = np.linspace(0.0, 10.0, 1001)
    run = run_of(tissue, time_s, np.minimum(40.0 * time_s, 40.0), np.ones(time_s.shape))
    angle = math.radians(2 * run.tip_deg[-1] - 20.0)
    assert steady_n_mm(run) == pytest.approx(0.05 * math.sin(angle), rel=1e-4)


def test_a_torque_over_the_angle_varies_with_the_schedule_as_any_other() -> None:
    law = Interface(orientation_n_mm_per_mm=0.05, varies=True)
    damped = Interface(viscous_n_mm_s_per_mm=0.5)
    tissue = Tissue(layers=(Layer(interface=Interface()),), at_tip=(law, damped))
    time_s = np.linspace(0.0, 10.0, 1001)
    for factor in (3.0, -2.0):
        run = run_of(tissue, time_s, np.minimum(40.0 * time_s, 40.0), np.full(time_s.shape, factor))
        torque = factor * 0.05 * math.sin(math.radians(run.tip_deg[-1]))
        assert steady_n_mm(run) == pytest.approx(torque, rel=1e-4)


def test_damping_may_depend_on_the_angle() -> None:
    """At the tip alone, where the angle is that of the tip: (c + w cos(2 theta - phase)) omega."""
    law = Interface(
        viscous_n_mm_s_per_mm=0.5,
        orientation_viscous_n_mm_s_per_mm=0.3,
        orientation_cycles=2.0,
        orientation_phase_deg=20.0,
    )
    run = turned(Tissue(layers=(Layer(interface=Interface()),), at_tip=(law,)))
    rate = np.gradient(np.radians(run.tip_deg), run.time_s)
    expected = (0.5 + 0.3 * np.cos(2 * np.radians(run.tip_deg) - math.radians(20.0))) * rate
    later = run.time_s > 0.5 * run.time_s[-1]  # inertia has long settled
    assert np.ptp(expected[later]) > 0.1 * np.max(expected)
    np.testing.assert_allclose(run.base_torque_n_mm[later][:-1], expected[later][:-1], rtol=1e-2)


def test_dry_friction_may_depend_on_the_angle() -> None:
    """At the tip alone, while it slips: level + w (1 + cos(theta - phase))."""
    law = Interface(kinetic_n_mm_per_mm=0.4, orientation_dry_n_mm_per_mm=0.2, orientation_phase_deg=20.0)
    damped = Interface(viscous_n_mm_s_per_mm=0.1)
    run = turned(Tissue(layers=(Layer(interface=Interface()),), at_tip=(law, damped)))
    tip = np.radians(run.tip_deg)
    expected = 0.4 + 0.2 * (1.0 + np.cos(tip - math.radians(20.0)))
    expected = expected + 0.1 * np.gradient(tip, run.time_s)
    later = run.time_s > 0.5 * run.time_s[-1]  # inertia has long settled
    assert np.ptp(expected[later]) > 0.1 * np.max(expected)
    np.testing.assert_allclose(run.base_torque_n_mm[later][:-1], expected[later][:-1], rtol=1e-2)


def test_the_curve_has_as_many_places_in_the_model_as_in_the_kernel() -> None:
    assert RATE_POINTS == memory_map.CURVE_POINTS
    for factors in ((1.0,), (1.0,) * (RATE_POINTS + 1)):
        with pytest.raises(InvalidValue, match=r"rate_curve.*2 to 23 factors"):
            Interface(rate_curve=factors)


PLACES = 6.0 * (np.arange(STIFFNESS_POINTS) / (STIFFNESS_POINTS - 1)) ** 2
"""Torques of a curve of the stiffness, of either sign, N mm."""
CURVE = (*(0.7 + 0.1 * np.cos(PLACES)), *(1.0 + 0.4 * PLACES))
"""Its factors, of negative torques first: it jumps at 0."""


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_shaft_may_be_as_stiff_as_the_torque_says(way: float) -> None:
    """Dry friction at the tip holds a torque that the whole shaft carries.

    Twist = torque l / (factor kappa), with the factor at kappa twist / l = torque / factor.
    """
    needle = NEEDLE.but(stiffness_curve=CURVE, stiffness_torque_n_mm=6.0)
    tissue = Tissue(layers=(Layer(interface=Interface()),), at_tip=(Interface(kinetic_n_mm_per_mm=2.5),))

    def factor_at(nominal: float) -> float:
        own = CURVE[STIFFNESS_POINTS:] if nominal > 0 else CURVE[:STIFFNESS_POINTS]
        return math.exp(np.interp(np.sqrt(abs(nominal)), np.sqrt(PLACES), np.log(own)))

    torque = way * 2.5
    factor = factor_at(brentq(lambda nominal: nominal * factor_at(nominal) - torque, 0.0, way * 5.0))
    run = turned(tissue, needle=needle, rate=way * RATE)
    lag_deg = math.degrees(torque * (10.0 + LENGTH_MM) / (factor * NEEDLE.rigidity_n_mm2))
    assert run.base_deg[-1] - run.tip_deg[-1] == pytest.approx(lag_deg, rel=1e-3)
    with pytest.raises(InvalidValue, match=r"stiffness_torque_n_mm"):
        NEEDLE.but(stiffness_curve=CURVE)
