"""The same campaign on a cluster whose workers and scheduler do not last."""

import socket
import subprocess
import sys
from threading import Timer

import pytest
from campaigns import content, environment

from diagnosis.engines.cluster import on_cluster
from diagnosis.engines.engine import EngineFailed, Job
from models.errors import InvalidValue
from studies.campaign.campaign import Campaign
from studies.campaign.cases import pieces
from studies.campaign.run_case import job_of, rows_of

_LONGEST_S = 120.0
_BELOW_EPHEMERAL = range(20_000, 30_000)


def test_a_missing_library_is_named_with_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "distributed", None)
    with pytest.raises(InvalidValue, match="cluster"):
        on_cluster("tcp://127.0.0.1:8786")


def test_a_scheduler_that_is_not_there_is_an_error_after_a_while():
    pytest.importorskip("distributed")
    engine = on_cluster(f"tcp://127.0.0.1:{free_port()}", patience_s=0.1)
    with pytest.raises(EngineFailed, match="--resume"):
        list(engine(Job(function="builtins.sum"), [range(3)]))


def free_port():
    """One that no outgoing connection takes while the scheduler is away."""
    for port in _BELOW_EPHEMERAL:
        with socket.socket() as made:
            try:
                made.bind(("127.0.0.1", port))
            except OSError:
                continue
            return port
    raise OSError("no free port")


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
        return self.start("worker", self.address, *how, "--local-directory", str(self.folder))

    def end(self):
        for process in self.processes:
            process.kill()
            process.wait()


@pytest.fixture
def cluster(tmp_path):
    """Ends after a while, whatever happens: a cluster without workers would wait for ever."""
    pytest.importorskip("distributed")
    made = Cluster(tmp_path)
    guard = Timer(_LONGEST_S, made.end)
    guard.start()
    yield made
    guard.cancel()
    made.end()


@pytest.mark.slow
def test_rows_are_the_same_though_a_worker_is_killed_and_the_scheduler_restarts(cluster):
    campaign = Campaign(**content(samples=30))
    found, news = {}, []
    scheduler = cluster.scheduler()
    workers = [cluster.worker(), cluster.worker()]
    engine = on_cluster(cluster.address, patience_s=60, tell=news.append)
    for piece, rows in engine(job_of(campaign), pieces(campaign)):
        assert piece not in found
        found[piece] = rows
        if len(found) == 3:
            workers[0].kill()
        if len(found) == 6:
            scheduler.kill()
            scheduler.wait()
            scheduler = cluster.scheduler()
            cluster.worker()
    assert sum("lost the scheduler" in told for told in news) == 1
    assert found == {piece: rows_of(campaign, piece) for piece in pieces(campaign)}
