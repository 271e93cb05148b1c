"""One plain set of sensors, and one small set of logs, that several tests share."""

import json

import pytest

from validation.logs.make import make_logs
from validation.logs.sensors import BASE, TIP, TORQUE, LogSensors

NOISE = {TIP: 0.4, TORQUE: 0.015, BASE: 0.02}


@pytest.fixture
def sensors():
    """Of the noise of a typical rig, without defects."""
    return LogSensors(noise=NOISE, claims=dict.fromkeys(NOISE, 1.0), steps={})


@pytest.fixture(scope="session")
def made(tmp_path_factory):
    """Four logs and their ground truth."""
    folder = tmp_path_factory.mktemp("made") / "set"
    make_logs(folder, seed=3, count=4, short=True, kinds=["none", "single", "off_nominal"], workers=1)
    return folder


@pytest.fixture(scope="session")
def answers(made):
    """The ground truth of these logs."""
    return json.loads((made / "answers" / "answers.json").read_text())
