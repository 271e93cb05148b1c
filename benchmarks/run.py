"""Every benchmark, and one table of goals: `python -m benchmarks.run --out DIR`.

About eight minutes; PyElastica and `mujoco.sysid` are skipped where they are not found.
"""

import time
from pathlib import Path

from benchmarks import (
    batches,
    callback,
    control_loop,
    diagnosis,
    fit,
    pyelastica,
    report,
    sysid,
    work_precision,
)


def main() -> None:
    """Run all, print, and write CSV and PNG."""
    parser = report.parser(__doc__)
    pyelastica.add_option(parser)
    options = parser.parse_args()
    folder, start = Path(options.out), time.perf_counter()
    goals = [
        *callback.run(folder),
        *batches.run(folder),
        *work_precision.run(folder),
        *control_loop.run(folder),
        *pyelastica.run(folder, options.elastica_python),
        *fit.run(folder),
        *diagnosis.run(folder),
        *sysid.run(folder),
    ]
    report.show_goals(goals, folder)
    report.say(f"{time.perf_counter() - start:.0f} s; tables and pictures in {folder}")


if __name__ == "__main__":
    main()
