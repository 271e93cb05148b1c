"""A trial at rest, of which a recording shows what is rough about it and nothing else."""

import numpy as np
import pytest

from validation.logs.roughness.recording import record
from validation.rig.unmodelled.effect import IdealSignals


@pytest.fixture
def recorded(drive, sensors):
    """Records a trial of these ideal signals, 100 s at 100 Hz, with some roughnesses."""

    def run(*roughness, seed=0, trials=1, load=None, **signals):
        motion = drive(lambda time_s: 0 * time_s, dt=0.01, end=100.0, load=load)
        zero = np.zeros(motion.time_s.size)
        shown = {"base_deg": zero, "torque_n_mm": zero, "tip_deg": zero, "speed_mm_s": zero}
        shown |= {name: of(motion.time_s) for name, of in signals.items()}
        ideal = IdealSignals(time_s=motion.time_s, **shown)
        rng = np.random.default_rng(seed)
        return record(rng, sensors, roughness, [motion] * trials, [ideal] * trials)

    return run


@pytest.fixture
def drawn():
    """Draws one roughness again and again until its numbers are as asked for."""

    def draw(make, **numbers):
        for seed in range(400):
            one = make(np.random.default_rng(seed))
            if all(one.numbers[name] == value for name, value in numbers.items()):
                return one
        raise AssertionError(f"no draw has {numbers}")

    return draw
