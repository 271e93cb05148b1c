"""An imported log as files."""

import os

import numpy as np
import pytest
from lab_files import KNOWN, RIG, mapping_of, write_csv

from diagnosis.lab_files.mapping import ImportMapping
from diagnosis.lab_files.readers.read import read_lab_files
from diagnosis.lab_files.write_log import imported, log_paths, refuse_to_overwrite, write_log
from diagnosis.log.rig_log import read_rig_log
from models.errors import InvalidValue, OutputExists


def written(tmp_path, **options):
    mapping = ImportMapping(**mapping_of(["run.csv"]))
    files = read_lab_files([write_csv(tmp_path)])
    write_log(mapping, imported(mapping, files), tmp_path / "log", force=False, **options)
    return mapping, tmp_path / "log"


def test_the_log_is_read_back_as_the_trial_that_the_file_was_made_of(tmp_path):
    _, folder = written(tmp_path)
    log = read_rig_log(folder)
    for name in KNOWN:
        # Nine digits of at most 120 are written.
        np.testing.assert_allclose(log.trials[0][name], KNOWN[name], atol=1e-6, err_msg=name)
    assert log.rig.needle.diameter_mm == RIG["needle"]["diameter_mm"]
    assert log.warnings == ()


def test_rig_yaml_says_what_it_was_made_of(tmp_path):
    _, folder = written(tmp_path)
    assert (folder / "rig.yaml").read_text().splitlines()[0].endswith("trial_00.csv from run.csv")


def test_all_files_are_named_before_they_are_written(tmp_path):
    mapping, folder = written(tmp_path)
    assert sorted(log_paths(mapping, folder)) == sorted(folder.iterdir())
    with pytest.raises(OutputExists):
        refuse_to_overwrite(log_paths(mapping, folder), [], force=False)
    refuse_to_overwrite(log_paths(mapping, folder), [], force=True)


@pytest.mark.parametrize("how", ["itself", "symbolic link", "hard link"])
def test_an_input_is_never_an_output_not_even_by_force(tmp_path, how):
    own = tmp_path / "run.csv"
    own.write_text("t,x\n")
    target = own if how == "itself" else tmp_path / "trial_01.csv"
    if how == "symbolic link":
        target.symlink_to(own)
    elif how == "hard link":
        os.link(own, target)
    with pytest.raises(InvalidValue, match="another folder"):
        refuse_to_overwrite([target], [own], force=True)
