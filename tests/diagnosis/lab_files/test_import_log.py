"""A lab's files as a log, in one call."""

import numpy as np
import pytest
import yaml
from lab_files import KNOWN, mapping_of, write_csv

from diagnosis.lab_files.import_log import import_log
from models.errors import InvalidValue, OutputExists


@pytest.fixture
def lab(tmp_path):
    """A lab's file, and its mapping."""
    mapping = tmp_path / "mapping.yaml"
    mapping.write_text(yaml.safe_dump(mapping_of(["run.csv"])))
    return write_csv(tmp_path), mapping


def test_the_log_is_what_the_file_was_made_of(lab, tmp_path):
    run, mapping = lab
    log = import_log([run], mapping, tmp_path / "log")
    for name in KNOWN:
        # Nine digits of at most 120 are written.
        np.testing.assert_allclose(log.trials[0][name], KNOWN[name], atol=1e-6, err_msg=name)


def test_a_log_that_exists_is_replaced_by_force_alone(lab, tmp_path):
    run, mapping = lab
    import_log([run], mapping, tmp_path / "log")
    with pytest.raises(OutputExists):
        import_log([run], mapping, tmp_path / "log")
    assert import_log([run], mapping, tmp_path / "log", force=True).trials


def test_what_is_not_confirmed_is_refused_and_nothing_is_written(lab, tmp_path):
    run, mapping = lab
    content = mapping_of(["run.csv"])
    next(iter(content["columns"].values()))["guess"] = True
    mapping.write_text(yaml.safe_dump(content))
    with pytest.raises(InvalidValue, match="guess"):
        import_log([run], mapping, tmp_path / "log")
    assert not (tmp_path / "log").exists()
    assert import_log([run], mapping, tmp_path / "log", accept_guesses=True).trials
