"""Play of the chuck from a moment of a trial on."""

import pytest

from diagnosis.replay.free_law import FreeLaw
from diagnosis.replay.free_parts.free_play import FreePlay
from models.drive import Drive

PLAYS = tuple(
    FreePlay(trial=name, play_deg=4.0, from_s=from_s, over_s=0.2)
    for name, from_s in (("a.csv", 3.0), ("b.csv", -0.2))
)
LAW = FreeLaw(plays=PLAYS)


def test_a_trial_has_its_own_alone_from_its_own_moment_on():
    own = LAW.on_trial("a.csv")
    assert own.plays == PLAYS[:1]
    assert LAW.on_trial("c.csv").plays == ()
    loosens = own.begun_at(0.0, 0.0, 4.0).drive(Drive()).loosens
    assert (loosens.play_deg, loosens.from_s, loosens.over_s) == (4.0, 7.0, 0.2)


def test_its_strength_is_its_width_and_of_no_strength_there_is_none():
    assert [play.play_deg for play in LAW.times(0.5).plays] == [2.0, 2.0]
    assert LAW.times(0.0).on_trial("a.csv").drive(Drive()).loosens is None


def test_another_law_leaves_it():
    both = LAW.beside(FreeLaw(asymmetry=0.2))
    assert both.plays == PLAYS
    assert both.asymmetry == pytest.approx(0.2)
