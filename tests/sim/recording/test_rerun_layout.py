"""The layout of a recording in the viewer."""

from sim.recording.recording import Recording
from sim.recording.rerun_layout import application


def test_recordings_with_other_views_are_another_application(recording):
    """A viewer that has shown the one would show the other in its layout."""
    table = recording.table
    shaftless = table[[c for c in table if not c.startswith("shaft_0")]]
    controlled = table.assign(rate_limited_count=0.0)
    names = {
        application(Recording(table=one, parameters=recording.parameters))
        for one in (table, shaftless, controlled)
    }
    assert len(names) == 3
    assert application(recording) in names
