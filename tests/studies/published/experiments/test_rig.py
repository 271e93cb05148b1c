"""The stated rig."""

from models import published
from studies.published.experiments.rig import STATED, STATED_RIGS, PublishedRig


def test_the_stated_rig_is_the_papers():
    assert STATED.tissue.damping_n_mm_s_per_mm * 200 == published.DAMPING_200_MM.value
    assert STATED.needle.diameter_mm == published.NEEDLE_DIAMETER.value


def test_the_free_length_is_the_set_ups_or_none():
    assert [rig.free_mm for rig in STATED_RIGS] == [50.0, 0.0]
    assert PublishedRig() == STATED_RIGS[0]
