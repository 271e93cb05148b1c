"""Processes of this machine: the same rows, whoever computes them and whoever is lost."""

import os
import signal
from functools import partial

import pytest

from studies.campaign import engines
from studies.campaign.campaign import read_campaign
from studies.campaign.cases import pieces
from studies.campaign.engines import EngineFailed, on_this_machine
from studies.campaign.run_case import rows_of


@pytest.fixture
def campaign(campaign_file):
    return read_campaign(campaign_file())


@pytest.fixture
def expected(campaign):
    return {piece: rows_of(campaign, piece) for piece in pieces(campaign)}


@pytest.mark.parametrize("workers", [1, 2])
def test_rows_are_the_same_with_one_worker_and_with_two(campaign, expected, workers):
    assert dict(on_this_machine(workers)(campaign, pieces(campaign))) == expected


def _die_once(mark, campaign, piece):
    if piece.start == 2 and not mark.exists():
        mark.touch()
        os.kill(os.getpid(), signal.SIGKILL)
    return rows_of(campaign, piece)


def _die(campaign, piece):
    os.kill(os.getpid(), signal.SIGKILL)


def test_a_worker_that_dies_loses_nothing(campaign, expected, tmp_path, monkeypatch):
    monkeypatch.setattr(engines, "rows_of", partial(_die_once, tmp_path / "died"))
    assert dict(on_this_machine(2)(campaign, pieces(campaign))) == expected
    assert (tmp_path / "died").exists()


def test_a_piece_that_kills_every_worker_is_an_error_that_says_what_to_do(campaign, monkeypatch):
    monkeypatch.setattr(engines, "rows_of", _die)
    with pytest.raises(EngineFailed, match=r"cases 0 to 1 .*cases_per_piece"):
        list(on_this_machine(2)(campaign, pieces(campaign)))
