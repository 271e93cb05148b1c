"""Every benchmark, and one table: `python -m benchmarks.run --out DIR`.

Other tables and pictures are written to files. It takes less than ten minutes on an idle machine;
PyElastica and `mujoco.sysid` are skipped if they are not found.
"""

import time
from pathlib import Path

from benchmarks import (
    batches,
    callback,
    control_loop,
    diagnosis,
    fit,
    flex,
    pyelastica,
    report,
    scaling,
    sysid,
    work_precision,
)


def main() -> None:
    """Run all, print, and write CSV and PNG."""
    parser = report.parser(__doc__)
    pyelastica.add_option(parser)
    options = parser.parse_args()
    folder, start = Path(options.out), time.perf_counter()
    with report.files_alone():
        goals = [
            *work_precision.run(folder),
            *callback.run(folder),
            *flex.run(folder),
            *pyelastica.run(folder, options.elastica_python),
            *sysid.run(folder),
            *batches.run(folder),
            *control_loop.run(folder),
            *fit.run(folder),
            *diagnosis.run(folder),
            *scaling.run(folder),
        ]
    report.show_goals(goals, folder)
    report.say(f"{time.perf_counter() - start:.0f} s; tables and pictures in {folder}")


if __name__ == "__main__":
    main()
