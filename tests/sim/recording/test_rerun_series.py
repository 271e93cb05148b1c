"""Lines over time: whole nanoseconds, and values to the last bit."""

import numpy as np
import rerun as rr
from rerun.chunk import RrdReader

from sim.recording.rerun_series import TIMELINE, log_series


def test_times_are_whole_nanoseconds_and_values_are_kept(tmp_path):
    path = tmp_path / "line.rrd"
    time_s, values = np.array([0.0, 0.1 + 0.2, 1e-9]), np.array([np.pi, -0.0, 1e-300])
    stream = rr.RecordingStream("line")
    stream.save(path)
    log_series(stream, "plot/line", "line", time_s, values, [1, 2, 3])
    stream.flush()
    stream.disconnect()
    for chunk in RrdReader(str(path)).stream():
        batch = chunk.to_record_batch()
        if "Scalars:scalars" in batch.schema.names:
            nanoseconds = batch.column(TIMELINE).cast("int64").to_pylist()
            logged = np.concatenate(batch.column("Scalars:scalars").to_pylist())
    by_time = dict(zip(nanoseconds, logged, strict=True))
    assert by_time == {0: np.pi, 300_000_000: 0.0, 1: 1e-300}
