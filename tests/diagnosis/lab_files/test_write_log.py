"""An imported log as files."""

import numpy as np
import pytest
from lab_files import KNOWN, RIG, mapping_of, write_csv

from diagnosis.lab_files.mapping import ImportMapping
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.lab_files.write_log import imported, log_paths, read_back, write_log
from diagnosis.log.rig_log import read_rig_log
from diagnosis.log.trial import UnusableLog
from models.errors import OutputExists
from sim.files import Destination


def written(tmp_path, **changes):
    mapping = ImportMapping(**mapping_of(["run.csv"], **changes))
    files = read_lab_files([write_csv(tmp_path)])
    write_log(mapping, imported(mapping, files), Destination(folder=tmp_path / "log"))
    return mapping, tmp_path / "log"


def test_the_log_is_read_back_as_the_trial_that_the_file_was_made_of(tmp_path):
    _, folder = written(tmp_path)
    log = read_rig_log(folder)
    for name in KNOWN:
        # Nine digits of at most 120 are written.
        np.testing.assert_allclose(log.trials[0][name], KNOWN[name], atol=1e-6, err_msg=name)
    assert log.rig.needle.diameter_mm == RIG["needle"]["diameter_mm"]
    assert log.warnings == ()


def test_the_inertia_of_the_mapping_is_that_of_the_rig(tmp_path):
    _, folder = written(tmp_path, inertia={"base_kg_m2": 2e-6})
    assert read_rig_log(folder).rig.inertia.base_kg_m2 == 2e-6


def test_rig_yaml_says_what_it_was_made_of(tmp_path):
    _, folder = written(tmp_path)
    assert (folder / "rig.yaml").read_text().splitlines()[0].endswith("trial_00.csv from run.csv")


def test_all_files_are_named_before_they_are_written(tmp_path):
    mapping, folder = written(tmp_path)
    assert sorted(log_paths(mapping, folder)) == sorted(folder.iterdir())
    with pytest.raises(OutputExists):
        written(tmp_path)


def test_a_log_that_would_be_refused_is_read_back_before_it_is_written(tmp_path):
    content = mapping_of(["run.csv"])
    files = read_lab_files([write_csv(tmp_path)])
    mapping = ImportMapping(**content)
    assert len(read_back(mapping, imported(mapping, files)).trials) == 1
    column = content["columns"]["base_torque_n_mm"]
    column["sign"] = -column.get("sign", 1)
    mapping = ImportMapping(**content)
    with pytest.raises(UnusableLog, match="nothing was written.*sign.*trial_00.csv: base_torque_n_mm"):
        read_back(mapping, imported(mapping, files))
