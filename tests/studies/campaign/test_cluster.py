"""The same campaign on a cluster whose workers and scheduler do not last."""

import socket
import subprocess
import sys
from threading import Timer

import pytest
from campaigns import environment

from models.errors import EnvironmentMismatch, InvalidValue
from studies.campaign.campaign import read_campaign
from studies.campaign.cases import pieces
from studies.campaign.cluster import on_cluster, rows_on_worker
from studies.campaign.engines import EngineFailed
from studies.campaign.run_case import rows_of

_LONGEST_S = 240.0


@pytest.fixture
def campaign(campaign_file):
    return read_campaign(campaign_file())


def test_a_worker_that_would_compute_something_else_is_refused(campaign):
    piece = range(0, 2)
    assert rows_on_worker(campaign, piece, campaign.fingerprint) == rows_of(campaign, piece)
    with pytest.raises(EnvironmentMismatch, match="same versions"):
        rows_on_worker(campaign, piece, campaign.but(seed=8).fingerprint)


def test_a_missing_library_is_named_with_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InvalidValue, match="cluster"):
        on_cluster("tcp://127.0.0.1:8786")


def test_a_scheduler_that_is_not_there_is_an_error_after_a_while(campaign):
    pytest.importorskip("distributed")
    engine = on_cluster(f"tcp://127.0.0.1:{free_port()}", patience_s=0.1)
    with pytest.raises(EngineFailed, match="--resume"):
        list(engine(campaign, pieces(campaign)))


def free_port():
    with socket.socket() as made:
        made.bind(("127.0.0.1", 0))
        return made.getsockname()[1]


class Cluster:
    """A scheduler and workers, each a process of its own."""

    def __init__(self, folder):
        self.folder, self.port = folder, free_port()
        self.address = f"tcp://127.0.0.1:{self.port}"
        self.processes = []

    def start(self, what, *arguments):
        module = f"distributed.cli.dask_{what}"
        command = [sys.executable, "-m", module, *arguments, "--no-dashboard"]
        log = (self.folder / f"{what}-{len(self.processes)}.txt").open("wb")
        quiet = {"stdout": log, "stderr": log}
        process = subprocess.Popen(command, cwd=self.folder, env=environment(), **quiet)
        self.processes.append(process)
        return process

    def scheduler(self):
        return self.start("scheduler", "--host", "127.0.0.1", "--port", str(self.port))

    def worker(self):
        how = ("--no-nanny", "--nworkers", "1", "--nthreads", "1", "--death-timeout", "600")
        return self.start("worker", self.address, *how)

    def end(self):
        for process in self.processes:
            process.kill()
            process.wait()


@pytest.mark.slow
def test_rows_are_the_same_though_a_worker_is_killed_and_the_scheduler_restarts(campaign_file, tmp_path):
    pytest.importorskip("distributed")
    path = campaign_file(base="fig5-10cm", samples=30, cases_per_piece=2)
    campaign = read_campaign(path)
    cluster, found, news = Cluster(tmp_path), {}, []
    guard = Timer(_LONGEST_S, cluster.end)  # a cluster without workers would wait for ever
    guard.start()
    try:
        scheduler = cluster.scheduler()
        workers = [cluster.worker(), cluster.worker()]
        engine = on_cluster(cluster.address, patience_s=60, tell=news.append)
        for piece, rows in engine(campaign, pieces(campaign)):
            assert piece not in found
            found[piece] = rows
            if len(found) == 3:
                workers[0].kill()
            if len(found) == 6:
                scheduler.kill()
                scheduler.wait()
                scheduler = cluster.scheduler()
                cluster.worker()
    finally:
        guard.cancel()
        cluster.end()
    assert sum("lost the scheduler" in told for told in news) == 1
    assert found == {piece: rows_of(campaign, piece) for piece in pieces(campaign)}
