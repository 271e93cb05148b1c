"""The second rig against closed forms and the reference, and the maker of logs with hidden answers.

Bounds for the rig's own error are 0.02 deg and 0.002 N mm: a twentieth of 0.4 deg and an eighth of
0.015 N mm, what sensors resolve at best.
"""

import json
import math

import numpy as np
import pytest
from reference_rig import Rig as ReferenceRig
from reference_rig import simulate

from models.modes import InsertedNeedle
from models.needle import NITINOL
from validation.logs.case import NEEDS_LOAD, NEEDS_SLIDING
from validation.logs.comparison import Bench
from validation.logs.make import make_logs
from validation.logs.motions import draw_motions, draw_plan
from validation.logs.rig_draw import draw_rig
from validation.logs.schedule import KINDS, effects_of, kind_of
from validation.logs.sensors import draw_sensors
from validation.logs.strengths import FAMILIES, OUTSIDE_FAMILIES, without
from validation.rig.rig import VOCABULARY, Fineness, Motion, Rig, observe, turn

BETA, DEPTH, FREE = 0.018, 100.0, 80.0
KAPPA = NITINOL.rigidity_n_mm2
TIP_DEG, TORQUE_N_MM = 0.02, 0.002


def motion(base, *, dt=0.0025, end=3.0, speed=0.0, growing=False, load=None, depth=DEPTH, free=FREE):
    time = np.arange(round(end / dt) + 1) * dt
    return Motion(
        dt_s=dt,
        per_sample=1,
        base_deg=base(time),
        inserted_mm=depth + speed * time * growing,
        free_mm=free - speed * time,
        speed_mm_s=np.full_like(time, speed),
        tip_torque_n_mm=None if load is None else load(time),
    )


def swing(time):
    return 120 * np.sin(2.5 * time) ** 2 * np.sign(np.sin(2.5 * time))


def steady(time):
    return 60 * time


def rig(outside=(), **effects):
    return Rig(damping_n_mm_s_per_mm=BETA, effects=effects, outside=dict(outside))


def closed_form(moved):
    needle = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=DEPTH, free_mm=FREE)
    exact = needle.respond(moved.time_s, np.radians(moved.base_deg), count=200)
    return np.degrees(exact.tip_rad), exact.base_torque_n_mm


def test_the_nominal_rig_follows_the_modes():
    moved = motion(swing)
    shown = observe(rig(), moved)
    tip, torque = closed_form(moved)
    assert np.ptp(torque) > 1
    assert shown.tip_deg == pytest.approx(tip, abs=TIP_DEG)
    assert shown.torque_n_mm == pytest.approx(torque, abs=TORQUE_N_MM)


@pytest.mark.parametrize("finer", ["steps", "cells"])
def test_errors_fall_with_the_square_of_steps_and_of_cells(finer):
    errors = []
    for part in (1, 2):
        moved = motion(swing, dt=0.02 / part if finer == "steps" else 0.00125)
        cells = Fineness(200 if finer == "steps" else 10 * part, 0, 0)
        tip, _ = turn(rig().law(), moved, cells)
        # The closed form moves straight between samples: compare on fine ones, where that is exact.
        exact, _ = closed_form(motion(swing, dt=0.00125))
        errors.append(np.abs(np.degrees(tip) - exact[:: round(moved.dt_s / 0.00125)]).max())
    # 4 in the limit; a first-order method would give 2.
    assert 3.2 < errors[0] / errors[1] < 4.8


def test_steady_turning_lags_as_computed_by_hand():
    shown = observe(rig(), motion(steady, end=12))
    rate = math.radians(60)
    lag = BETA * rate * DEPTH * (DEPTH / 2 + FREE) / KAPPA
    assert shown.torque_n_mm[-1] == pytest.approx(BETA * rate * DEPTH, rel=1e-4)
    assert shown.base_deg[-1] - shown.tip_deg[-1] == pytest.approx(math.degrees(lag), rel=1e-4)


LAWS = {
    "coulomb": ({"coulomb_friction": {"level": 0.004}}, {}),
    "stiction": ({"stiction": {"kinetic": 0.002, "static": 0.005, "stribeck": 0.4}}, {}),
    "shared": ({"speed_dependent_friction": {"level": 0.01}}, {"speed": 2.0}),
    "thinning": ({"shear_thinning": {"exponent": 0.5}}, {}),
    "yielding": ({"tissue_viscoelasticity": {"stiffness": 0.02, "time_constant": 0.5}}, {}),
    "layers": ({"layered_tissue": {"ratio": 4.0, "boundary": 0.43}}, {}),
    "load": (
        {"load_dependent_friction": {"coefficient": 0.4}, "tip_drag": {"damping": 0.2}},
        {"load": np.cos},
    ),
    "drive": (
        {
            "chuck_backlash": {"gap": 6.0},
            "base_compliance": {"stiffness": 8.0},
            "sheath_friction": {"level": 0.002},
            "entry_friction": {"level": 0.1},
        },
        {"speed": 2.0},
    ),
    "growing": (
        {
            "coulomb_friction": {"level": 0.002},
            "tissue_viscoelasticity": {"stiffness": 0.05, "time_constant": 0.2},
            "entry_friction": {"level": 0.1},
            "sheath_friction": {"level": 0.002},
            "needle_curvature": {"torque": 0.001, "phase": 50.0},
        },
        {"speed": 5.0, "growing": True},
    ),
}


@pytest.mark.parametrize("name", LAWS)
def test_effects_follow_the_reference(name):
    effects, how = LAWS[name]
    moved = motion(swing, dt=0.01, end=1.5, free=DEPTH, **how)
    reference = simulate(
        ReferenceRig(
            diameter_mm=0.59, shear_modulus_gpa=27.2, damping_n_mm_s_per_mm=BETA, effects=effects
        ),
        time_s=moved.time_s,
        base_angle_deg=moved.base_deg,
        inserted_mm=moved.inserted_mm,
        free_mm=moved.free_mm,
        speed_mm_s=moved.speed_mm_s,
        tip_torque_n_mm=moved.tip_torque_n_mm,
        cells=40,
        dt=0.01,
        slip="material" if moved.growing else "place",
    )
    sheath = math.ceil(40 * moved.free_mm.max() / DEPTH)
    tip, torque = turn(rig(**effects).law(), moved, Fineness(40, sheath, 40))
    nominal, _ = turn(rig().law(), moved, Fineness(40, 0, 40))
    # Same steps and cells, so that only what the Newton methods leave (1e-7 rad) may differ. That
    # would not hide a wrong law: each changes the tip by far more.
    assert np.abs(np.degrees(tip - nominal)).max() > 1
    assert np.degrees(tip) == pytest.approx(reference.tip_angle_deg, abs=1e-3)
    assert torque == pytest.approx(reference.base_torque_n_mm, abs=1e-4)


def test_sensors_err_as_they_should():
    moved = motion(swing)
    true = observe(rig(), moved)
    biased = observe(rig(tip_angle_bias={"bias": 2.0}, torque_bias={"bias": -0.1}), moved)
    assert biased.tip_deg == pytest.approx(true.tip_deg + 2)
    assert biased.torque_n_mm == pytest.approx(true.torque_n_mm - 0.1)
    late = observe(rig(tip_sensor_delay={"delay": 0.05}, tip_angle_scale={"scale": 0.9}), moved)
    assert late.tip_deg[20:] == pytest.approx(0.9 * true.tip_deg[:-20])


def test_effects_outside_the_vocabulary_follow_their_laws():
    moved, rate = motion(steady, end=12), math.radians(60)
    viscous = BETA * rate * DEPTH
    true = observe(rig(), moved)

    def end(**outside):
        return observe(rig(outside), moved)

    assert end(slipping_chuck={"torque": 1.0}).torque_n_mm.max() == pytest.approx(1.0)
    worn = end(lubrication={"share": 0.5, "angle": 60.0})
    assert worn.torque_n_mm[-1] == pytest.approx(0.5 * viscous, rel=1e-3)
    graded = end(damping_gradient={"gradient": 0.6})
    assert graded.torque_n_mm[-1] == pytest.approx(viscous, rel=1e-4)
    # The moment of a damping 1 + g (2 x / l - 1) about the entry is l^2/2 (1 + g/3).
    more = math.degrees(BETA * rate * DEPTH**2 / 2 * 0.6 / 3 / KAPPA)
    assert true.tip_deg[-1] - graded.tip_deg[-1] == pytest.approx(more, rel=1e-3)
    one_way = end(one_way_friction={"level": 0.004, "asymmetry": 0.5})
    assert one_way.torque_n_mm[-1] - viscous == pytest.approx(0.006 * DEPTH, rel=1e-3)
    hard = end(hardening_shaft={"coefficient": 1e4})
    assert hard.tip_deg[-1] > true.tip_deg[-1] + 1
    lagging = end(tip_sensor_lag={"time_constant": 0.3})
    assert true.tip_deg[-1] - lagging.tip_deg[-1] == pytest.approx(0.3 * 60, rel=1e-3)


def test_contacts_that_rested_hold_more():
    def rest_then_turn(time):
        return 90 * np.clip(time - 8, 0, 1)

    outside = {"friction_ageing": {"level": 0.002, "growth": 0.002, "time": 0.5, "angle": 1.0}}
    rested = observe(rig(outside), motion(rest_then_turn, end=10))
    fresh = observe(rig(outside), motion(lambda time: rest_then_turn(time + 8), end=2))
    assert rested.torque_n_mm.max() > fresh.torque_n_mm.max() + 0.02


def test_every_effect_can_be_given_its_strength():
    for i, name in enumerate((*FAMILIES, *OUTSIDE_FAMILIES)):
        rng = np.random.default_rng(i)
        for _ in range(20):
            plan = draw_plan(rng, short=True, slides=name in NEEDS_SLIDING, loads=name in NEEDS_LOAD)
            bench = Bench(draw_motions(rng, plan)[:1], draw_sensors(rng), coarse=True)
            found = draw_rig(rng, bench, "single", (name,), (1.0, 20.0))
            if found is not None:
                break
        assert found is not None, name
        assert 0.8 <= bench.signature(found, without(found, name)) <= 25, name
        assert {*found.effects, *found.outside} == {name}


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("blind") / "set"
    make_logs(folder, seed=3, count=4, short=True, kinds=["none", "single", "off_nominal"], workers=1)
    return folder


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() for path in sorted(folder.rglob("*.*"))}


def test_a_case_depends_on_seed_and_number_alone(made, tmp_path):
    again = tmp_path / "again"
    make_logs(again, seed=3, count=2, short=True, kinds=["none", "single", "off_nominal"], workers=1)
    logs = contents(made / "logs")
    assert contents(again / "logs").items() < logs.items()
    answers = json.loads((made / "answers" / "answers.json").read_text())
    fewer = json.loads((again / "answers" / "answers.json").read_text())
    assert fewer.items() < answers.items()


def test_logs_do_not_tell_their_answers(made):
    answers = json.loads((made / "answers" / "answers.json").read_text())
    cases = sorted(path.name for path in (made / "logs").iterdir())
    assert cases == sorted(answers)
    for path, text in contents(made / "logs").items():
        assert path.name == "rig.yaml" or path.suffix == ".csv"
        assert not any(name in text.decode() for name in (*VOCABULARY, *OUTSIDE_FAMILIES, *KINDS))
    for answer in answers.values():
        errors = {"stiffness_error", "damping_error"} if answer["kind"] == "off_nominal" else set()
        assert set(answer["parameters"]) - errors == set(answer["effects"])
        assert answer["verdict"] == ("none" if answer["kind"] == "none" else "explained")
        assert all(1 <= value <= 20 for value in answer["signature"].values())


def test_a_folder_is_never_overwritten_and_names_are_checked(made, tmp_path):
    with pytest.raises(FileExistsError):
        make_logs(made, seed=3, count=1)
    with pytest.raises(ValueError, match="kinds: 'double'"):
        make_logs(tmp_path / "new", seed=3, count=1, kinds=["double"])
    with pytest.raises(ValueError, match="effects: coulomb_friction"):
        rig(coulomb_friction={"slope": 1.0})


def test_shares_are_kept_and_effects_take_turns():
    kinds = [kind_of(9, i) for i in range(330)]
    counts = {kind: sum(k == kind for k, _ in kinds) for kind in KINDS}
    assert counts == {"none": 40, "single": 150, "pair": 60, "off_nominal": 40, "outside": 40}
    singles = [effects_of(9, "single", earlier, None)[0] for earlier in range(38)]
    assert sorted(singles) == sorted(2 * VOCABULARY)
