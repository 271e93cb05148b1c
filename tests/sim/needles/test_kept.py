"""Models and batches are used again, never by two at once, and never with old numbers."""

from dataclasses import replace

import numpy as np
import pytest

from models.drive import Drive, DriveKind
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Arrangement, Discretisation
from sim.needles.kept import Kept, batch_of, compile_model, data_of, models_in_turn, models_of
from sim.needles.run import SimulationFailed
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate

TIME = np.array([0.0, 0.3, 1.0])
TURN = Schedule(
    time_s=TIME,
    drive=np.array([0.0, 90.0, 90.0]),
    free_mm=np.full(3, 50.0),
    inserted_mm=np.full(3, 100.0),
    speed_mm_s=np.zeros(3),
)


def setup(damping=0.01725, inserted=100.0, arrangement=Arrangement.SIBLINGS):
    return Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=damping),
        discretisation=Discretisation(elements=4, arrangement=arrangement),
        free_mm=50.0,
        inserted_mm=inserted,
    )


def test_what_is_taken_is_nobody_elses_and_comes_back():
    kept, made = Kept(), iter(range(9))
    with (
        kept.taken("kind", lambda: next(made)) as first,
        kept.taken("kind", lambda: next(made)) as other,
    ):
        assert (first, other) == ((0, True), (1, True))
    with kept.taken("kind", lambda: next(made)) as again:
        assert again == (0, False)
    with kept.taken("another kind", lambda: next(made)) as new:
        assert new == (2, True)


def test_the_oldest_kind_makes_room():
    kept, made = Kept(most=2), iter(range(9))
    for kind in "abc":
        with kept.taken(kind, lambda: next(made)):
            pass
    for kind, new in (("b", False), ("c", False), ("a", True)):
        with kept.taken(kind, lambda: next(made)) as (_, is_new):
            assert is_new is new


def test_what_failed_in_use_is_not_used_again():
    kept, made = Kept(), iter(range(9))
    with pytest.raises(SimulationFailed), kept.taken("kind", lambda: next(made)):
        raise SimulationFailed("lost its numbers")
    with kept.taken("kind", lambda: next(made)) as (one, new):
        assert (one, new) == (1, True)


OTHERS = {
    "damping": {"tissue": Tissue.uniform(viscous_n_mm_s_per_mm=0.1)},
    "inserted length": {"inserted_mm": 80.0},
    "free length": {"free_mm": 10.0},
    "needle": {"needle": NITINOL.but(diameter_mm=0.9, tip_inertia_kg_m2=1e-12)},
    "stiffness": {"needle": NITINOL.but(shear_modulus_gpa=30.0)},
    "stiffness behind a soft servo": {"needle": NITINOL.but(shear_modulus_gpa=30.0)},
    "drive": {"drive": Drive(stiffness_n_mm_per_rad=5.0, rotor_inertia_kg_m2=1e-9)},
    "torque limit": {"drive": Drive(kind=DriveKind.TORQUE, torque_limit_n_mm=3.0)},
    "step": {"discretisation": {"step_s": 3e-3}},
}
BEFORE = {
    "stiffness behind a soft servo": {"drive": Drive(stiffness_n_mm_per_rad=5.0)},
    "torque limit": {"drive": Drive(kind=DriveKind.TORQUE, torque_limit_n_mm=9.0)},
}


def arrays(model):
    """All arrays of a model."""
    return {name: value for name in dir(model) if isinstance(value := getattr(model, name), np.ndarray)}


@pytest.mark.parametrize("arrangement", Arrangement)
@pytest.mark.parametrize("other", OTHERS)
def test_a_model_that_is_used_again_is_that_of_its_set_up(other, arrangement):
    """Every number is that of a model compiled for the set-up, whatever the model was before."""
    changes = dict(OTHERS[other])
    first = replace(setup(arrangement=arrangement), **BEFORE.get(other, {}))
    changed = {"discretisation": first.discretisation.but(**changes.pop("discretisation", {}))}
    wanted = replace(first, **changed, **changes)
    assert wanted.size == first.size
    with models_of([first]) as (used,):
        before = {name: value.copy() for name, value in arrays(used).items()}
    with models_of([wanted]) as (again,):
        assert again is used
        assert again.opt.timestep == wanted.discretisation.step_s
        for name, value in arrays(compile_model(wanted)).items():
            np.testing.assert_array_equal(getattr(again, name), value, err_msg=name)
    same = all(np.array_equal(before[name], value) for name, value in arrays(used).items())
    assert same == (other == "step")  # the step is no array; everything else changes one


def test_two_needles_of_one_size_never_share_a_model():
    with models_of([setup(0.01), setup(0.02)]) as (one, other):
        assert one is not other
        assert not np.array_equal(one.numeric_data, other.numeric_data)


def test_needles_in_turn_share_a_model_that_has_the_numbers_of_each():
    wanted = [setup(0.01), setup(0.02), setup(0.02, inserted=80.0), setup(0.01)]
    used = []
    for one, model in zip(wanted, models_in_turn(wanted), strict=True):
        used.append(model)
        for name, value in arrays(compile_model(one)).items():
            np.testing.assert_array_equal(getattr(model, name), value, err_msg=name)
    assert all(model is used[0] for model in used)


def test_needles_of_other_sizes_share_no_model():
    finer = replace(setup(), discretisation=Discretisation(elements=5))
    with models_of([setup()]) as (one,):
        pass
    with models_of([finer]) as (other,):
        assert one.nq != other.nq


def test_batches_and_data_of_one_size_are_used_again():
    with models_of([setup(), setup(0.02)]) as models:
        with batch_of(models, 1) as first:
            pass
        with batch_of(models, 1) as again, batch_of(models, 1) as other:
            assert again is first
            assert other is not first
        with batch_of(models, 2) as threaded:
            assert threaded is not first
        with data_of(models[0]) as data:
            data.time, data.qpos[1] = 3.0, 1.0
        with data_of(models[1]) as later:
            assert later is data
            assert (later.time, later.qpos[1]) == (0.0, 0.0)


@pytest.mark.parametrize("arrangement", Arrangement)
def test_runs_do_not_depend_on_what_ran_before(arrangement):
    first = simulate([setup(arrangement=arrangement)], TURN)[0]
    simulate([setup(0.1, arrangement=arrangement)], TURN)
    again = simulate([setup(arrangement=arrangement)], TURN)[0]
    np.testing.assert_array_equal(first.outputs, again.outputs)
