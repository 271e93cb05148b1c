"""Kills a command repeatedly at random times, and checks the files that it leaves.

    python -m benchmarks.kills --kills 60 --seed 1

An insertion is recorded, then that of another needle over it (`--force`), and the second run is killed
(SIGKILL): in turn at a random moment of the whole run, of the time in which it writes, and of the time
that is aimed at, from the decision (its journal is there) until all files have their names.
Printed for each of these: how often the folder held the old set, the new set or both mixed, as it stood
and after the next reader, how many runs died after their decision, and how many dead runs were cleared
away.
"""

import argparse
import io
import json
import os
import random
import shutil
import tempfile
import time
from collections import Counter
from collections.abc import Callable
from contextlib import redirect_stderr
from itertools import cycle
from multiprocessing import get_context
from multiprocessing.context import ForkProcess
from pathlib import Path
from typing import Any

from rich.console import Console

from scripts import insert
from sim.files import finish_interrupted
from sim.simulation import prepare_processes

_PROTOCOL = """\
name: killed
needle: {needle}
tissue: viscous-plastisol
free_mm: 50
inserted_mm: 50
segments: [{{duration_s: 1, turn_deg: 90}}]
"""
_PARTS = ".needle-part-*"
_JOURNAL = "journal.json"


_NAMING_S = 0.01  # from the decision until files have their names and the folder is on the disk


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description="kill a command at random moments")
    parser.add_argument("--kills", type=int, default=60)
    parser.add_argument("--seed", type=int, default=1)
    given = parser.parse_args()
    prepare_processes()
    with tempfile.TemporaryDirectory() as folder:
        found = _measured(Path(folder), given.kills, random.Random(given.seed))
    print(json.dumps(found, indent=1))


def _measured(folder: Path, kills: int, rng: random.Random) -> dict[str, object]:
    sets = {"old": folder / "old", "new": folder / "new"}
    for place, needle_name in zip(sets.values(), ("nitinol-0.59", "nitinol-1.27"), strict=True):
        place.mkdir()
        (place / "p.yaml").write_text(_PROTOCOL.format(needle=needle_name), encoding="utf-8")
        before_s, writing_s = _lengths_s(place)
    moments: dict[str, tuple[Callable[[ForkProcess, Path], None], float]] = {
        "of the whole run": (lambda *_: None, 1.5 * (before_s + writing_s)),
        "while it writes": (_wait_until_it_writes, writing_s),
        "after its decision": (_wait_until_decided, _NAMING_S),
    }
    found = {name: Counter[str]() for name in moments}
    for i, (name, (wait, within_s)) in zip(range(kills), cycle(moments.items()), strict=False):
        place = folder / str(i)
        shutil.copytree(sets["old"], place)
        running = _begun(place, sets["new"] / "p.yaml")
        wait(running, place)
        time.sleep(rng.uniform(0.0, within_s))
        running.kill()
        running.join()
        found[name] += _left(place, sets)
    lengths = {"s before it writes": round(before_s, 2), "s of writing": round(writing_s, 2)}
    return {"kills": kills, **lengths, **found}


def _left(place: Path, sets: dict[str, Path]) -> Counter[str]:
    """What a killed run has left, as it stands and after the next reader."""
    parts = list(place.glob(_PARTS))
    decided = any((part / _JOURNAL).exists() for part in parts)
    told = {"dead runs cleared away": len(parts), "of them decided": int(decided)}
    told[f"stood: {_which(place, sets)}"] = 1
    finish_interrupted(place)
    told[f"read: {_which(place, sets)}"] = 1
    assert not list(place.glob(_PARTS))
    return Counter(told)


def _lengths_s(place: Path) -> tuple[float, float]:
    """Time until a run begins to write, and time of writing, s."""
    began_s = time.monotonic()
    running = _begun(place, place / "p.yaml")
    _wait_until_it_writes(running, place)
    writes_s = time.monotonic()
    running.join()
    assert running.exitcode == 0
    return writes_s - began_s, time.monotonic() - writes_s


def _wait_until_it_writes(running: ForkProcess, place: Path) -> None:
    while running.is_alive() and not list(place.glob(_PARTS)):
        pass


def _wait_until_decided(running: ForkProcess, place: Path) -> None:
    """Poll for the journal, which exists for some milliseconds only."""
    _wait_until_it_writes(running, place)
    journal = str(next(place.glob(_PARTS), place) / _JOURNAL)
    while not os.path.exists(journal) and running.is_alive():
        pass


def _begun(folder: Path, protocol: Path) -> ForkProcess:
    """The command, in a process that has all modules already."""
    how = {"controller": None, "mjcf": None, "model": None, "force": True}
    how["console"] = Console(quiet=True)
    running = get_context("fork").Process(target=_silently, args=(str(protocol), folder), kwargs=how)
    running.start()
    return running


def _silently(*given: Any, **how: Any) -> None:
    with redirect_stderr(io.StringIO()):
        insert.run(*given, **how)


def _which(folder: Path, sets: dict[str, Path]) -> str:
    """Of which set the files are; recordings carry the time, so that a new one is like no other."""
    names = [path.name for path in sets["old"].glob("killed.*")]
    found = {"old" if _same(folder, sets["old"], name) else "new" for name in names}
    return found.pop() if len(found) == 1 else "mixed"


def _same(folder: Path, other: Path, name: str) -> bool:
    return (folder / name).exists() and (folder / name).read_bytes() == (other / name).read_bytes()


if __name__ == "__main__":
    main()
