"""Make rig logs whose answers are kept apart.

    python -m validation.logs.make --out DIR --seed N --count N [--short] [--kinds a b] ...

writes DIR/logs/case_001/{rig.yaml, trial_01.csv, ...} and DIR/answers/answers.json. The same seed
gives the same bytes, and a case depends on nothing but the seed and its number.
"""

import argparse
import json
from collections.abc import Iterator, Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np
from rich.progress import track

from validation.logs.case import Case, draw_case
from validation.rig.unmodelled import OUTSIDE
from validation.rig.rig import VOCABULARY, Motion
from validation.logs.schedule import KINDS, effects_of, kind_of
from validation.logs.sensors import as_csv, measure, rig_yaml

Answer = dict[str, Any]
VERDICTS = {"none": "none", "outside": "unknown"}


def make_logs(
    folder: Path,
    *,
    seed: int,
    count: int,
    kinds: Sequence[str] | None = None,
    short: bool = False,
    signature: tuple[float, float] = (1.0, 20.0),
    effects: Sequence[str] | None = None,
    rivals: bool = False,
    workers: int = 2,
) -> None:
    """Write logs and answers into a new folder.

    Args:
      kinds: some of `schedule.KINDS`; all by default, in their shares.
      short: three trials of about 40 s in all, at 50 or 100 Hz.
      signature: least and greatest signature of every effect, over the noise.
      effects: only these, of the vocabulary or from outside it.
      rivals: put into all answers what else would nearly explain the gap (slow); those of what is
        outside always have it.
      workers: processes.

    Raises:
      FileExistsError: the folder exists.
      ValueError: a kind or effect is unknown, or the signatures are not in order.
    """
    _check(kinds or KINDS, KINDS, "kinds")
    _check(effects or (), (*VOCABULARY, *OUTSIDE), "effects")
    if not 0 < signature[0] < signature[1]:
        raise ValueError(f"signature: {signature}; expected 0 < low < high")
    (folder / "logs").mkdir(parents=True, exist_ok=False)
    how = {"short": short, "signature": signature, "rivals": rivals}
    jobs = [(folder, seed, i, tuple(kinds or KINDS), effects, how) for i in range(count)]
    answers = dict(track(_made(jobs, workers), description="logs", total=count))
    (folder / "answers").mkdir()
    text = json.dumps(answers, indent=1, sort_keys=False)
    (folder / "answers" / "answers.json").write_text(text + "\n")


def _check(given: Sequence[str], known: Sequence[str], field: str) -> None:
    for name in given:
        if name not in known:
            raise ValueError(f"{field}: {name!r}; expected some of {', '.join(known)}")


def _made(jobs: list[tuple[Any, ...]], workers: int) -> Iterator[tuple[str, Answer]]:
    if workers == 1:
        yield from map(_make_one, jobs)
        return
    with ProcessPoolExecutor(workers) as pool:
        yield from pool.map(_make_one, jobs)


def _make_one(job: tuple[Any, ...]) -> tuple[str, Answer]:
    folder, seed, number, kinds, effects, how = job
    kind, earlier = kind_of(seed, number, kinds)
    names = effects_of(seed, kind, earlier, effects)
    rng = np.random.default_rng([seed, number])
    case = draw_case(rng, kind, names, **how)
    name = f"case_{number + 1:03d}"
    _write(rng, folder / "logs" / name, case)
    return name, _answer(kind, case)


def _write(rng: np.random.Generator, folder: Path, case: Case) -> None:
    folder.mkdir()
    text = rig_yaml(case.sensors, case.rig, len(case.motions))
    (folder / "rig.yaml").write_text(text)
    for i, (motion, trace) in enumerate(zip(case.motions, case.traces, strict=True)):
        columns = measure(rng, case.sensors, motion, trace)
        (folder / f"trial_{i + 1:02d}.csv").write_text(as_csv(columns))


def _answer(kind: str, case: Case) -> Answer:
    signatures = dict(sorted(case.signatures.items(), key=lambda item: -item[1]))
    answer: Answer = {
        "verdict": VERDICTS.get(kind, "explained"),
        "effects": [name for name in signatures if name in case.rig.effects],
        "parameters": {name: dict(p) for name, p in {**case.rig.effects, **case.rig.outside}.items()},
        "kind": kind,
        "signature": {name: round(value, 3) for name, value in signatures.items()},
        "gap": round(case.gap, 3),
    }
    if case.rig.outside:
        answer["outside"] = next(iter(case.rig.outside))
    if case.rivals.alone:
        best = dict(list(case.rivals.alone.items())[:3])
        answer["rivals"] = {name: round(value, 3) for name, value in best.items()}
        answer["rival_pair"] = [*case.rivals.pair, round(case.rivals.pair_residual, 3)]
    trials = [_trial(motion) for motion in case.motions]
    answer["details"] = {
        **case.sensors.details(),
        "rate_hz": case.plan.rate_hz,
        "growing": any(trial["growing"] for trial in trials),
        "trials": trials,
    }
    return answer


def _trial(motion: Motion) -> dict[str, Any]:
    return {
        "duration_s": round(float(motion.time_s[-1]), 2),
        "depth_mm": [round(float(depth), 1) for depth in motion.inserted_mm[[0, -1]]],
        "sliding": bool(np.any(motion.speed_mm_s)),
        "growing": motion.growing,
        "loaded": motion.tip_torque_n_mm is not None,
    }


def main() -> None:
    """The command line."""
    parser = argparse.ArgumentParser(description="make rig logs whose answers are kept apart")
    parser.add_argument("--out", type=Path, required=True)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--count", type=int, required=True)
    parser.add_argument("--short", action="store_true")
    parser.add_argument("--kinds", nargs="+", choices=KINDS)
    parser.add_argument("--effects", nargs="+")
    parser.add_argument("--signature", nargs=2, type=float, default=(1.0, 20.0), metavar=("LOW", "HIGH"))
    parser.add_argument("--rivals", action="store_true")
    parser.add_argument("--workers", type=int, default=2)
    given = vars(parser.parse_args())
    make_logs(given.pop("out"), **{**given, "signature": tuple(given["signature"])})


if __name__ == "__main__":
    main()
