"""`make fuzz`: many inputs of every family, and figures of what came of them."""

import argparse
import sys
import warnings
from collections import Counter
from concurrent.futures import ProcessPoolExecutor

from fuzz.families import FAMILIES, each_input
from fuzz.outcome import Kind
from rich.console import Console
from rich.table import Table

from sim.simulation import prepare_processes


def run(name, count, random_seed):
    """Outcomes of so many inputs of a family; faults with their input."""
    warnings.simplefilter("ignore")
    found, faults, family = [], [], FAMILIES[name]

    def check(value):
        result = family.checked(value)
        found.append(result)
        if result.kind is Kind.FAULT:
            faults.append((result.said, value))

    each_input(family, check, most=count, random_seed=random_seed)
    return found, faults


def main():
    """The command line; exit code 1 if anything is as it should not be."""
    parser = argparse.ArgumentParser(description="inputs that are wrong, and what came of them")
    parser.add_argument("--inputs", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default="", help="families whose name has this in it")
    parser.add_argument("--processes", type=int, default=2)
    args = parser.parse_args()
    prepare_processes()
    total = sum(family.weight for family in FAMILIES.values())
    counts = {
        name: -(-args.inputs * family.weight // total)
        for name, family in FAMILIES.items()
        if args.only in name
    }
    everything, faults = [], []
    console = Console(markup=False, highlight=False, soft_wrap=True)
    table = Table("family", "inputs", *Kind, "slowest, s", title="Inputs and what came of them")
    with ProcessPoolExecutor(args.processes) as pool:
        done = {name: pool.submit(run, name, count, args.seed) for name, count in counts.items()}
        for name, task in done.items():
            found, wrong = task.result()
            everything += found
            faults += [(name, *fault) for fault in wrong]
            table.add_row(name, *_row(found))
            console.print(name, *_row(found))
    table.add_section()
    table.add_row("all", *_row(everything))
    by_place = {"\n".join(said.splitlines()[-6:]): (name, value) for name, said, value in faults}
    for said, (name, value) in by_place.items():
        console.print(f"\n{name}: {str(value)[:600]!r}\n{said[-2000:]}")
    console.print(table)
    return 1 if faults else 0


def _row(found):
    counts = Counter(one.kind for one in found)
    slowest = max((one.cpu_s for one in found), default=0.0)
    return [str(len(found)), *(str(counts[kind]) for kind in Kind), f"{slowest:.2f}"]


if __name__ == "__main__":
    sys.exit(main())
