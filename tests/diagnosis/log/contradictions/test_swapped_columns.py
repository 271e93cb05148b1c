"""Two columns that have changed places: refused by their noise, where the claims tell them apart."""

import pytest
from analytic_log import read_rig_log, swapped

from diagnosis.log.contradictions.swapped_columns import refuse_swapped_noise
from diagnosis.log.trial import Trial, UnusableLog


def test_columns_that_scatter_as_each_other_are_refused(log):
    read = read_rig_log(log)
    trial, noise = read.trials[0], read.rig.sensors.by_column()
    refuse_swapped_noise(log, trial, noise)
    changed = Trial(name=trial.name, table=swapped("base_torque_n_mm", "tip_angle_deg")(trial.table))
    with pytest.raises(UnusableLog, match="scatters as rig.yaml claims for the other"):
        refuse_swapped_noise(log, changed, noise)
