"""Kills a command again and again, at random moments, and looks at what it leaves.

    python -m benchmarks.kills --kills 40 --seed 1

An insertion is recorded, then that of another needle over it (`--force`), and the second run is killed
(SIGKILL): in turn at a random moment of the whole run, of the time in which it writes, and of the
millisecond in which its files get their names.
Printed: how often the folder held the old set, the new set or both mixed, as it stood and after the next
reader, and how many dead runs were cleared away.
"""

import argparse
import json
import random
import shutil
import tempfile
import time
from collections import Counter
from multiprocessing import get_context
from multiprocessing.context import ForkProcess
from pathlib import Path

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
_JOURNAL = f"{_PARTS}/journal.json"


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description="kill a command at random moments")
    parser.add_argument("--kills", type=int, default=40)
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
    moments = (("p.yaml", 1.5 * (before_s + writing_s)), (_PARTS, writing_s), (_JOURNAL, 1e-3))
    stood, read = Counter[str](), Counter[str]()
    parts = 0
    for i in range(kills):
        place = folder / str(i)
        shutil.copytree(sets["old"], place)
        running = _begun(place, sets["new"] / "p.yaml")
        seen, within_s = moments[i % len(moments)]
        _wait_for(running, place, seen)
        time.sleep(rng.uniform(0.0, within_s))
        running.kill()
        running.join()
        stood[_which(place, sets)] += 1
        parts += len(list(place.glob(_PARTS)))
        finish_interrupted(place)
        read[_which(place, sets)] += 1
        assert not list(place.glob(_PARTS))
    return {
        "kills": kills,
        "seconds before it writes, and of writing": [round(before_s, 2), round(writing_s, 2)],
        "as it stood": stood,
        "after the next reader": read,
        "dead runs cleared away": parts,
    }


def _lengths_s(place: Path) -> tuple[float, float]:
    began_s = time.monotonic()
    running = _begun(place, place / "p.yaml")
    _wait_for(running, place, _PARTS)
    writes_s = time.monotonic()
    running.join()
    assert running.exitcode == 0
    return writes_s - began_s, time.monotonic() - writes_s


def _wait_for(running: ForkProcess, place: Path, name: str) -> None:
    """Until there is a file of this name; it may come and go between two looks."""
    while running.is_alive() and not list(place.glob(name)):
        pass


def _begun(folder: Path, protocol: Path) -> ForkProcess:
    """The command, in a process that has all modules already."""
    how = {"controller": None, "mjcf": None, "model": None, "force": True}
    how["console"] = Console(quiet=True)
    running = get_context("fork").Process(target=insert.run, args=(str(protocol), folder), kwargs=how)
    running.start()
    return running


def _which(folder: Path, sets: dict[str, Path]) -> str:
    """Of which set the files are; recordings carry the time, so that a new one is like no other."""
    names = [path.name for path in sets["old"].glob("killed.*")]
    found = {"old" if _same(folder, sets["old"], name) else "new" for name in names}
    return found.pop() if len(found) == 1 else "mixed"


def _same(folder: Path, other: Path, name: str) -> bool:
    return (folder / name).exists() and (folder / name).read_bytes() == (other / name).read_bytes()


if __name__ == "__main__":
    main()
