"""What the sensors of a rig would have read."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from diagnosis_fixtures import NOISE, RIG, TIP, TORQUE, log_of, prepared, problem_of, trial, turns

from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import SENSORS
from diagnosis.prepare.noise.noise_colour import NoiseColour
from diagnosis.prepare.prepare import prepare
from diagnosis.replay import replay as module
from diagnosis.replay.along_depth import AlongDepth
from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.prediction import Prediction
from diagnosis.replay.replay import predict, replay, residuals, residuals_of_each, shape_of
from diagnosis.replay.rig_parameters import NOMINAL, RigParameters
from models.errors import InvalidValue
from sim.needles.run import SimulationFailed

EXAMPLE = Path(__file__).parents[3] / "examples" / "rig-log"


@pytest.fixture(scope="module")
def example():
    return read_rig_log(EXAMPLE)


def noises(log):
    """Standard deviation of the nominal residual over claimed noise, by trial and sensor."""
    ready, _ = prepare(log)
    claimed = log.rig.sensors.by_column()
    each = zip(ready.trials, replay(ready), strict=True)
    return np.array([[np.nanstd(t.readings[s] - p[s]) / claimed[s] for s in SENSORS] for t, p in each])


def test_the_example_rig_is_explained_by_the_nominal_needle(example):
    """An independent rig with nothing unmodelled: the residual is its sensors' noise."""
    # Claimed noise is good to about 15 %; thousands of samples scatter by 1 %.
    assert np.all((noises(example) > 0.85) & (noises(example) < 1.15))


def test_a_needle_that_is_not_the_rigs_leaves_a_gap(example):
    """Negative control: 20 % more damping is seen."""
    damped = example.rig.tissue.but(damping_n_mm_s_per_mm=1.2 * 0.0172)
    assert noises(replace(example, rig=example.rig.but(tissue=damped))).max() > 3


def test_rigs_that_differ_in_their_sensors_alone_share_a_needle(monkeypatch):
    simulated = []

    def counted(setups, inputs, **options):
        simulated.append(len(setups))
        return original(setups, inputs, **options)

    original = module.simulate
    monkeypatch.setattr(module, "simulate", counted)
    ready = prepared(trial(turns(3.0)))
    rigs = [NOMINAL, RigParameters(tip_bias_deg=2.0), RigParameters(damping_scale=1.1)]
    one, biased, other = predict(RIG, ready, rigs)
    assert simulated == [2]
    np.testing.assert_array_equal(biased["tip_angle_deg"], one["tip_angle_deg"] + 2.0)
    np.testing.assert_array_equal(biased["base_torque_n_mm"], one["base_torque_n_mm"])
    assert np.abs(other["tip_angle_deg"] - one["tip_angle_deg"]).max() > 0.1


def test_rigs_side_by_side_read_what_each_reads_alone():
    ready = prepared(trial(turns(3.0), speed=-1.0))
    rigs = [RigParameters(damping_scale=s) for s in (0.9, 1.2)]
    for rig, together in zip(rigs, predict(RIG, ready, rigs), strict=True):
        alone = predict(RIG, ready, [rig])[0]
        for sensor in SENSORS:
            np.testing.assert_array_equal(together[sensor], alone[sensor])


def test_residuals_are_in_sigma_sensor_after_sensor_without_what_is_missing():
    ready = prepared(trial(np.zeros(4)))
    tip = np.array([1.0, np.nan, 2.0, 0.0])
    read = replace(ready, readings={"tip_angle_deg": tip, "base_torque_n_mm": np.ones(4)})
    prediction = Prediction(tip_angle_deg=np.full(4, 0.5), base_torque_n_mm=np.zeros(4))
    expected = [*np.full(4, 1 / TORQUE), 0.5 / TIP, 1.5 / TIP, -0.5 / TIP]
    np.testing.assert_allclose(residuals(read, prediction, NOISE), expected)
    assert residuals(ready, prediction, NOISE).size == 0


def test_residuals_of_several_predictions_are_those_of_each():
    """Whitened together, as coloured noise asks."""
    colour = NoiseColour.of(share=0.8, correlation_time_s=0.05)
    noise = replace(NOISE, colour={"tip_angle_deg": colour})
    (ready,) = problem_of(log_of(NOMINAL, seconds=3.0)).log.trials
    predictions = predict(RIG, ready, [RigParameters(damping_scale=s) for s in (0.9, 1.0, 1.2)])
    together = residuals_of_each(ready, predictions, noise)
    for own, prediction in zip(together, predictions, strict=True):
        np.testing.assert_allclose(own, residuals(ready, prediction, noise), rtol=1e-12)
    assert not np.allclose(together[0], residuals(ready, predictions[0], NOISE))


def test_the_shape_ends_in_the_tip_that_is_predicted():
    ready = prepared(log_of(NOMINAL, seconds=3.0).trials[0])
    run = shape_of(RIG, ready, NOMINAL)
    tip = np.interp(ready.time_s, run.time_s, np.degrees(run.angles_rad[:, -1]))
    predicted = predict(RIG, ready, [NOMINAL])[0]["tip_angle_deg"]
    np.testing.assert_allclose(tip, predicted, atol=1e-6)


def test_a_needle_that_parameters_make_impossible_is_a_simulation_that_failed():
    """A layer a hair thick asks for an element with less inertia than MuJoCo takes."""
    layered = RigParameters(free=FreeLaw(along_depth=AlongDepth(damping=(1.0, 2.0), thickness_mm=1e-4)))
    with pytest.raises(SimulationFailed, match="cannot be built: elements: .* inertia"):
        predict(RIG, prepared(trial(turns())), [NOMINAL, layered])


def test_a_constant_of_the_log_that_makes_it_impossible_is_refused_by_its_name(monkeypatch):
    def refused(*_, **__):
        raise InvalidValue("elements", 9, "a thicker needle")

    monkeypatch.setattr(module, "simulate", refused)
    with pytest.raises(InvalidValue, match="elements"):
        predict(RIG, prepared(trial(turns())), [NOMINAL])
    with pytest.raises(SimulationFailed, match="cannot be built"):
        predict(RIG, prepared(trial(turns())), [NOMINAL, RigParameters(damping_scale=2.0)])
