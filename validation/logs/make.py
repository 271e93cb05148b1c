"""Write rig logs, and their ground truth separately.

    python -m validation.logs.make --out DIR --seed N --count N [--short] [--kinds a b] ...

writes DIR/logs/case_001/{rig.yaml, trial_01.csv, ...} and DIR/answers/answers.json. The same seed
gives the same bytes, and a log depends on nothing but the seed and its number.
"""

import argparse
import json
import math
import signal
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from multiprocessing import Pool
from pathlib import Path
from typing import Any

import numpy as np

from validation.logs.case import ValidationCase, draw_case
from validation.logs.ground_truth import Answer, ground_truth
from validation.logs.roughness.recording import ROUGHNESSES, record
from validation.logs.roughness.roughness import Columns
from validation.logs.schedule import ALL_KINDS, KINDS, ROUGH_SHARES, effects_of, kind_of, roughness_of
from validation.logs.sensors import FINE_TIME, FORMATS, as_csv, measure, rig_yaml
from validation.rig.modelled import MODELLED, WRONG_CONSTANTS
from validation.rig.simulation import compile_kernels
from validation.rig.unmodelled.library import UNMODELLED

MOST_LOGS = 100_000
"""A day of computing, and 40 GB."""
MOST_SEED = 2**63
NAMES: Mapping[str, tuple[str, ...]] = {
    "kinds": ("all", *ALL_KINDS),
    "effects": (*MODELLED, *WRONG_CONSTANTS, *UNMODELLED),
    "roughness": tuple(ROUGHNESSES),
}
"""What `kinds`, `effects` and `roughness` may name."""
Made = Iterable[tuple[str, Answer]]


def make_logs(
    folder: Path,
    *,
    seed: int,
    count: int,
    kinds: Sequence[str] | None = None,
    short: bool = False,
    signature: tuple[float, float] = (1.0, 20.0),
    effects: Sequence[str] | None = None,
    roughness: Sequence[str] | None = None,
    alternatives: bool = False,
    workers: int = 2,
    watched: Callable[[Made], Made] = iter,
) -> None:
    """Write logs and ground truth into a new folder.

    Args:
      kinds: some of `schedule.ALL_KINDS`, or "all"; `schedule.KINDS` by default; in their shares.
      short: three trials of about 40 s in total, at 50 or 100 Hz.
      signature: smallest and largest signature of every effect: rms of the change / sigma.
      effects: draw only these, modelled or unmodelled.
      roughness: for the rough kinds, each of these alone, in turn; by default pairs of all.
      alternatives: add to all answers which wrong effects would nearly explain the gap (slow);
        answers of unmodelled effects always have it.
      workers: number of processes.
      watched: iterates over the logs as they are made, and may show progress.

    Raises:
      FileExistsError: the folder exists.
      ValueError: a kind, effect or roughness is unknown, `count` or `seed` is out of range, or the
        signatures are not in order.
    """
    kinds = ALL_KINDS if kinds and "all" in kinds else kinds or KINDS
    for field, given in (("kinds", kinds), ("effects", effects), ("roughness", roughness)):
        _check(given or (), field)
    if count < 1:
        raise ValueError(f"count: expected at least 1 log, found {count}")
    if count > MOST_LOGS:
        raise ValueError(f"count: expected at most {MOST_LOGS} logs, found {count}")
    if not 0 <= seed < MOST_SEED:
        raise ValueError(f"seed: expected 0 to {MOST_SEED - 1}, found {seed}")
    if not 0 < signature[0] < signature[1] < math.inf:
        found = " ".join(f"{value:g}" for value in signature)
        raise ValueError(f"signature: expected 0 < LOW < HIGH, found {found}")
    (folder / "logs").mkdir(parents=True, exist_ok=False)
    how = {"short": short, "signature": signature, "alternatives": alternatives}
    jobs = [(folder, seed, i, tuple(kinds), (effects, roughness), how) for i in range(count)]
    answers = dict(watched(_made(jobs, workers)))
    (folder / "answers").mkdir()
    text = json.dumps(answers, indent=1, sort_keys=False)
    (folder / "answers" / "answers.json").write_text(text + "\n")


def _check(given: Sequence[str], field: str) -> None:
    for name in given:
        if name not in NAMES[field]:
            raise ValueError(f"{field}: expected some of {', '.join(NAMES[field])}, found {name!r}")


def _made(jobs: list[tuple[Any, ...]], workers: int) -> Iterator[tuple[str, Answer]]:
    if workers == 1:
        yield from map(_make_one, jobs)
        return
    compile_kernels()
    # These end by themselves after their log if this process is killed.
    with Pool(workers, signal.signal, (signal.SIGINT, signal.SIG_IGN)) as pool:
        yield from pool.imap(_make_one, jobs)


def _make_one(job: tuple[Any, ...]) -> tuple[str, Answer]:
    folder, seed, number, kinds, (effects, roughness), how = job
    kind, earlier = kind_of(seed, number, kinds)
    names = effects_of(seed, kind, earlier, effects)
    rng = np.random.default_rng([seed, number])
    rough = roughness_of(seed, kind, earlier, number, roughness)
    case = draw_case(rng, kind, names, roughness=rough, **how)
    name = f"case_{number + 1:03d}"
    _write(rng, folder / "logs" / name, case, FINE_TIME if kind in ROUGH_SHARES else FORMATS)
    return name, ground_truth(kind, case)


def _write(
    rng: np.random.Generator, folder: Path, case: ValidationCase, formats: Mapping[str, str]
) -> None:
    folder.mkdir()
    text = rig_yaml(case.sensors, case.rig, len(case.motions))
    (folder / "rig.yaml").write_text(text)
    for i, columns in enumerate(_recorded(rng, case)):
        (folder / f"trial_{i + 1:02d}.csv").write_text(as_csv(columns, formats))


def _recorded(rng: np.random.Generator, case: ValidationCase) -> list[Columns]:
    if case.roughness:
        return record(rng, case.sensors, case.roughness, case.motions, case.signals)
    trials = zip(case.motions, case.signals, strict=True)
    return [measure(rng, case.sensors, motion, signals) for motion, signals in trials]


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description="write rig logs, and their ground truth separately")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--count", type=int, required=True)
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--kinds", nargs="+", choices=NAMES["kinds"])
    parser.add_argument("--effects", nargs="+")
    parser.add_argument("--roughness", nargs="+", choices=ROUGHNESSES)
    parser.add_argument("--signature", nargs=2, type=float, default=(1.0, 20.0), metavar=("LOW", "HIGH"))
    parser.add_argument(
        "--rivals", action="store_true", dest="alternatives", help="add alternative explanations"
    )
    parser.add_argument("--workers", type=int, default=2)
    given = vars(parser.parse_args())
    make_logs(given.pop("out"), **{**given, "signature": tuple(given["signature"])})


if __name__ == "__main__":
    main()
