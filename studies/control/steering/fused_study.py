"""Roll of the tip from the base alone, and fused with images, where the base alone is wrong.

A needle is inserted from 2 to 10 cm at 5 mm/s while its base turns to and fro. Both estimators
assume the paper's needle in viscous plastisol and read the same noisy sensors; each plant
differs from that in one respect. Uneven tissue bends the path at random, differently for every
seed.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from controllers.estimators import FeedforwardEstimator
from controllers.signals import Sample
from controllers.steering.fused import FusedEstimator, FusionNoise
from controllers.steering.model_average import ModelAverage
from controllers.steering.tip_pose import TipPose
from models.bevel import PREBENT_RADIUS_MM
from models.needle import NITINOL
from models.tissue import Interface, Layer, Tissue
from sim.needles.run import Run
from sim.schedule import Schedule
from sim.simulation import simulate
from studies.control.steering.camera import Camera, CameraModel
from studies.control.steering.insertion_setup import lagrangian_setup
from studies.control.steering.seed_spread import Spread
from studies.control.tables import DAMPING

Array = NDArray[np.float64]

FUSED_SEEDS = tuple(range(101, 109))  # the filter's drift and doubt were set on seeds 1 to 8
_START_MM, _END_MM, _SPEED_MM_S, _FREE_MM = 20.0, 100.0, 5.0, 50.0
_SAMPLE_S, _ELEMENTS = 0.02, 24
_TURNS_MM, _TURNS_DEG, _TURN_S = (30.0, 45.0, 60.0, 75.0), (90.0, 180.0, 90.0, 0.0), 0.3
_BASE_NOISE_DEG, _TORQUE_NOISE_N_MM = 0.02, 0.015
ASSUMED = FusionNoise()
TRUSTING = ASSUMED.but(torque_bias_n_mm=0.0, lag_deg=0.0, lag_drift_deg=0.0)


@dataclass(frozen=True, kw_only=True)
class Plant:
    """A needle that differs from what the estimators assume.

    Attributes:
      tip_torque_n_mm: torque on the tip, against positive rotation.
      torque_bias_n_mm: bias of the torque sensor.
    """

    name: str
    tissue: Tissue
    tip_torque_n_mm: float = 0.0
    torque_bias_n_mm: float = 0.0


_VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=DAMPING)
_FRICTION_AT_DEPTH = Tissue(
    name="dry friction at depth",
    layers=(
        Layer(interface=Interface(viscous_n_mm_s_per_mm=DAMPING), fraction=0.5),
        Layer(interface=Interface(viscous_n_mm_s_per_mm=DAMPING, kinetic_n_mm_per_mm=0.04)),
    ),
)
PLANTS = (
    Plant(name="as assumed", tissue=_VISCOUS),
    Plant(name="torque sensor off by 0.5 N mm", tissue=_VISCOUS, torque_bias_n_mm=0.5),
    Plant(name="1.5 N mm at the tip", tissue=_VISCOUS, tip_torque_n_mm=1.5),
    Plant(name="dry friction at depth", tissue=_FRICTION_AT_DEPTH),
    Plant(name="damping x 2", tissue=Tissue.uniform(viscous_n_mm_s_per_mm=2 * DAMPING)),
)


@dataclass(frozen=True, kw_only=True)
class RollErrors:
    """Errors of one estimator on one plant, over the seeds.

    Attributes:
      rms_deg: root mean square over the second half of the insertion.
      end_deg: absolute error at its end.
    """

    rms_deg: Spread
    end_deg: Spread


ESTIMATORS = ("base alone", "fused, base uncertain", "fused, averaged")


def compare_estimators(
    plants: Sequence[Plant] = PLANTS, *, seeds: Sequence[int] = FUSED_SEEDS
) -> dict[str, dict[str, RollErrors]]:
    """Errors by plant and estimator."""
    return {plant.name: _errors(plant, seeds) for plant in plants}


def _errors(plant: Plant, seeds: Sequence[int]) -> dict[str, RollErrors]:
    run = insert(plant)
    rolls = [estimated_rolls(run, plant, seed) for seed in seeds]
    half = run.time_s.size // 2
    found = {}
    for name in ESTIMATORS:
        wrong = [estimates[name] - run.tip_deg for estimates in rolls]
        found[name] = RollErrors(
            rms_deg=Spread.of([float(np.sqrt(np.mean(e[half:] ** 2))) for e in wrong]),
            end_deg=Spread.of([abs(float(e[-1])) for e in wrong]),
        )
    return found


def insert(plant: Plant) -> Run:
    """Simulate the plant; its base turns as scheduled, without sensors."""
    setup = lagrangian_setup(
        plant.tissue,
        free_mm=_FREE_MM + _END_MM - _START_MM,
        inserted_mm=_START_MM,
        step_s=_SAMPLE_S,
        elements=_ELEMENTS,
    )
    return simulate([setup], _schedule(plant.tip_torque_n_mm))[0]


def _schedule(tip_torque_n_mm: float) -> Schedule:
    time, angle = [0.0], [0.0]
    for depth, turned in zip(_TURNS_MM, _TURNS_DEG, strict=True):
        at = (depth - _START_MM) / _SPEED_MM_S
        time += [at, at + _TURN_S]
        angle += [angle[-1], turned]
    times = np.array([*time, (_END_MM - _START_MM) / _SPEED_MM_S])
    inserted = _START_MM + _SPEED_MM_S * times
    return Schedule(
        time_s=times,
        drive=np.array([*angle, angle[-1]]),
        free_mm=_FREE_MM + _END_MM - inserted,
        inserted_mm=inserted,
        speed_mm_s=np.full(times.size, _SPEED_MM_S),
        tip_torque_n_mm=np.full(times.size, tip_torque_n_mm),
    )


def estimated_rolls(
    run: Run,
    plant: Plant,
    seed: int,
    *,
    camera: CameraModel = CameraModel(),  # noqa: B008 - frozen
) -> dict[str, Array]:
    """Roll of the tip by estimator, deg, (N,) each."""
    base = FeedforwardEstimator(NITINOL, damping_n_mm_s_per_mm=DAMPING)
    fused = ModelAverage(_fused(TRUSTING), _fused(ASSUMED))
    looking, path = Camera(camera, seed=seed), wandering_path(run, seed)
    rolls = []
    for sample, place in zip(_samples(run, plant, seed), path, strict=True):
        average = fused.update(sample)
        rolls.append((base.update(sample).tip_deg, fused.doubting_estimate.tip_deg, average.tip_deg))
        view = looking.look(sample.time_s, place)
        if view.position_mm is not None:
            fused.see(view.position_mm)
        if view.exposes:
            fused.expose()
    return dict(zip(ESTIMATORS, np.array(rolls).T, strict=True))


def _fused(noise: FusionNoise) -> FusedEstimator:
    return FusedEstimator(
        NITINOL, damping_n_mm_s_per_mm=DAMPING, radius_mm=PREBENT_RADIUS_MM, noise=noise
    )


def _samples(run: Run, plant: Plant, seed: int) -> list[Sample]:
    noise = np.random.default_rng([seed, 1]).normal(size=(run.time_s.size, 2))
    base_deg = run.inputs.drive + _BASE_NOISE_DEG * noise[:, 0]
    torque = run.base_torque_n_mm + plant.torque_bias_n_mm + _TORQUE_NOISE_N_MM * noise[:, 1]
    columns = (run.time_s, base_deg, torque, run.inputs.inserted_mm, run.inputs.free_mm)
    return [Sample(*(float(value) for value in row)) for row in zip(*columns, strict=True)]


def wandering_path(run: Run, seed: int) -> Array:
    """Positions of the tip, mm, (N, 3), with the random bends that the filter assumes."""
    bends = np.random.default_rng([seed, 2]).normal(size=(run.time_s.size, 3))
    roll, depth = np.radians(run.tip_deg), run.inputs.inserted_mm
    tip, places = TipPose(PREBENT_RADIUS_MM), np.zeros((run.time_s.size, 3))
    for i in range(1, run.time_s.size):
        travel = float(depth[i] - depth[i - 1])
        tip.advance(travel, 0.5 * float(roll[i] + roll[i - 1]))
        spread = math.radians(ASSUMED.direction_drift_deg) * math.sqrt(travel)
        tip.correct(np.zeros(3), spread * bends[i])
        places[i] = tip.position_mm
    return places
