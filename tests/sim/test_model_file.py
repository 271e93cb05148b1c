"""A model through an MJCF file: it runs as the one that wrote it, and changes in it count."""

import re
from dataclasses import replace

import numpy as np
import pytest

from models.errors import InvalidValue
from models.needle import NITINOL
from models.tissue import Tissue
from sim.discretisation import Discretisation
from sim.model_file import read_model
from sim.needles.kept import compile_model
from sim.needles.setup import Setup
from sim.schedule import Schedule
from sim.simulation import simulate
from sim.spec import needle_spec


def setup(order=2, **fields):
    return Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(viscous_n_mm_s_per_mm=0.01725),
        discretisation=Discretisation(**({"order": order} | fields)),
        free_mm=0.0,
        inserted_mm=200.0,
    )


def turn(model, made):
    """90 deg in 0.1 s, held until 5 s."""
    time = np.array([0.0, 0.1, 5.0])
    inputs = Schedule(
        time_s=time,
        drive=np.array([0.0, 90.0, 90.0]),
        free_mm=np.zeros(3),
        inserted_mm=np.full(3, 200.0),
        speed_mm_s=np.zeros(3),
    )
    return simulate([made], inputs, models=[model])[0]


def decay_rate(run):
    """Of the lag after 3 s, 1/s: the slowest pole alone."""
    late = run.time_s > 3.0
    return np.polyfit(run.time_s[late], np.log((run.base_deg - run.tip_deg)[late]), 1)[0]


@pytest.mark.parametrize("order", [1, 2])
def test_a_model_through_its_file_runs_as_the_one_that_wrote_it(order, tmp_path):
    made, path = setup(order), tmp_path / "needle.xml"
    path.write_text(needle_spec(made).to_xml())
    ours, theirs = turn(compile_model(made), made), turn(read_model(path, made), made)
    # The file holds six digits: 1e-6 of the 90 deg that they describe, a few times.
    assert np.abs(ours.tip_deg - theirs.tip_deg).max() < 5e-4
    assert np.ptp(ours.tip_deg) > 80


def test_a_stiffness_changed_in_the_file_moves_the_poles(tmp_path):
    made, path = setup(), tmp_path / "needle.xml"
    text = needle_spec(made).to_xml()

    def halved(found):
        return f'{found[1]}"{float(found[2]) / 2}"'

    shaft = re.compile(r'(name="twist_(?:[1-9]|1\d)"[^>]*stiffness=)"([^"]+)"')
    changed, count = shaft.subn(halved, text)
    assert count == 16
    path.write_text(changed)
    ours, theirs = turn(compile_model(made), made), turn(read_model(path, made), made)
    # -pi^2 kappa / (4 beta l^2) halves; the second-order step distorts it by 1e-4 at most
    assert decay_rate(theirs) == pytest.approx(decay_rate(ours) / 2, rel=1e-3)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("not a model", "a MuJoCo model"),
        ("<mujoco/>", "needle insert --mjcf"),
    ],
)
def test_a_file_that_is_not_our_model_is_refused_by_name(tmp_path, text, message):
    path = tmp_path / "other.xml"
    path.write_text(text)
    with pytest.raises(InvalidValue, match=message) as refused:
        read_model(path, setup())
    assert "other.xml" in str(refused.value)


def test_a_model_of_another_number_of_elements_is_refused(tmp_path):
    path = tmp_path / "needle.xml"
    path.write_text(needle_spec(setup(elements=8)).to_xml())
    with pytest.raises(InvalidValue, match="16 elements"):
        read_model(path, setup())


@pytest.mark.parametrize(("free", "inserted"), [(50.0, 200.0), (0.0, 100.0)])
def test_a_model_of_other_lengths_is_refused(tmp_path, free, inserted):
    """Also where the number of nodes is the same."""
    path, made = tmp_path / "needle.xml", setup(elements=15 if free else 16)
    path.write_text(needle_spec(setup()).to_xml())
    other = replace(made, free_mm=free, inserted_mm=inserted)
    assert other.nodes_mm.size == setup().nodes_mm.size
    with pytest.raises(InvalidValue, match="the nodes of the protocol"):
        read_model(path, other)


def test_a_model_of_another_tissue_is_refused(tmp_path):
    path, made = tmp_path / "needle.xml", setup()
    path.write_text(needle_spec(made).to_xml())
    softer = Setup(
        needle=NITINOL,
        tissue=Tissue.uniform(name="softer", viscous_n_mm_s_per_mm=0.01),
        free_mm=0.0,
        inserted_mm=200.0,
    )
    with pytest.raises(InvalidValue, match="the tissue of the protocol, softer"):
        read_model(path, softer)
