"""Roughness of the torque: how far it drifts and where from, and what the filter lets pass."""

from itertools import pairwise

import numpy as np
import pytest

from validation.logs.roughness.torque import low_pass_torque, torque_drift
from validation.logs.sensors import TIP, TORQUE


def drifts(recorded, one, trials=4):
    """What the drift adds to the torque of every trial, N mm."""
    pairs = zip(recorded(one, trials=trials), recorded(trials=trials), strict=True)
    return [rough[TORQUE] - clean[TORQUE] for rough, clean in pairs]


@pytest.mark.parametrize("shape", ["line", "walk", "sine"])
def test_a_drift_that_starts_anew_begins_at_zero_and_reaches_1_to_5_sigma(
    drawn, recorded, sensors, shape
):
    one = drawn(torque_drift, shape=shape, goes_on=False)
    found = drifts(recorded, one)
    largest = [np.abs(drift).max() / sensors.noise[TORQUE] for drift in found]
    low, high = one.numbers["largest_sigma"]
    assert 1 <= low <= min(largest) <= max(largest) <= high <= 5
    assert len({round(size, 6) for size in largest}) == 4
    assert all(drift[0] == pytest.approx(0.0, abs=1e-12) for drift in found)


def test_a_drift_that_goes_on_begins_where_it_ended(drawn, recorded, sensors):
    found = drifts(recorded, drawn(torque_drift, shape="line", goes_on=True))
    for before, after in pairwise(found):
        assert after[0] == pytest.approx(before[-1], abs=1e-12)
        assert np.abs(after - after[0]).max() >= sensors.noise[TORQUE] * (1 - 1e-9)


@pytest.mark.parametrize("shape", ["line", "walk", "sine"])
def test_a_drift_is_slow(drawn, recorded, sensors, shape):
    """Within 0.1 s it moves by less than the noise; a walk of 10^4 steps by 5 of its 100 at most."""
    (drift,) = drifts(recorded, drawn(torque_drift, shape=shape), trials=1)
    assert np.abs(drift[10:] - drift[:-10]).max() < sensors.noise[TORQUE]


@pytest.mark.parametrize("seed", range(4))
def test_the_filter_passes_its_cut_off_with_its_gain_and_phase(recorded, seed):
    """At the cut-off a first-order filter has a gain of 1 / sqrt(2) and lags by 45 deg.

    A tone at a tenth of it, as 100 Hz sample that: gain 1 / sqrt(1.01) and lag atan(0.1).
    """
    one = low_pass_torque(np.random.default_rng(seed))
    f = one.numbers["cut_off_hz"]
    assert 2 <= f <= 20
    for ratio in (1.0, 0.1):
        phase = 2 * np.pi * ratio * f
        (columns,) = recorded(one, torque_n_mm=lambda t, w=phase: 1e3 * np.sin(w * t))
        time_s, shown = columns["time_s"][2000:], columns[TORQUE][2000:]
        tones = np.stack([np.sin(phase * time_s), np.cos(phase * time_s)], axis=1)
        in_phase, out_of_phase = np.linalg.lstsq(tones, shown, rcond=None)[0] / 1e3
        # Between samples the signal is taken as straight, which a tone at 20 Hz is to 13 % only.
        slack = (phase * 0.01) ** 2 / 12 + 1e-3
        assert in_phase + 1j * out_of_phase == pytest.approx(1 / (1 + 1j * ratio), abs=slack)


@pytest.mark.parametrize("before", [True, False])
def test_noise_passes_the_filter_or_comes_after_it_with_the_claimed_size(
    drawn, recorded, sensors, before
):
    one = drawn(low_pass_torque, noise_before=before)
    (columns,) = recorded(one)
    torque = columns[TORQUE]
    correlation = torque[1:] @ torque[:-1] / (torque @ torque)
    a = np.exp(-0.01 * 2 * np.pi * one.numbers["cut_off_hz"])
    assert correlation == pytest.approx(a if before else 0.0, abs=0.04)
    assert torque.std() == pytest.approx(sensors.noise[TORQUE], rel=0.1)
    assert (columns[TIP] == recorded()[0][TIP]).all()
