"""What is wrong with single readings of a log."""

from dataclasses import replace

from diagnosis.replay.sensing.reading_errors import ReadingJump

JUMP = ReadingJump(trial="one", sensor="tip_angle_deg", time_s=1.0, size=2.0)


def test_a_jump_is_in_the_unit_of_its_column():
    assert JUMP.unit == "deg"
    assert replace(JUMP, sensor="base_torque_n_mm").unit == "N mm"
