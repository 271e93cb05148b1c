"""Computing time of a step of MuJoCo's own 1-D flex, a rope with the same number of elements.

Its vertices move in space and its edges resist stretching; it has no torsion and does not turn with
the base, so it cannot replace the needle: only the time of its steps is compared, over the duration of
the fast turn and with our default step.
"""

from pathlib import Path

import mujoco
import numpy as np

from benchmarks import report
from benchmarks.methods import rollout_of, setup_of
from benchmarks.tissues import END_S, LENGTH_MM, SMOOTH
from models import units
from models.needle import NITINOL
from sim.kernel.native.callback import install

_ELEMENTS = 16
_XML = """
<mujoco>
  <option timestep="{step_s}" gravity="0 0 0"/>
  <worldbody>
    <flexcomp name="rope" type="grid" dim="1" count="{count} 1 1" spacing="{spacing} 1 1" mass="{mass}"
              radius="{radius}">
      <contact selfcollide="none" contype="0" conaffinity="0"/>
      <edge equality="true"/>
      <pin id="0"/>
    </flexcomp>
  </worldbody>
</mujoco>
"""


def rope(step_s: float) -> mujoco.MjModel:
    """A rope of the needle's length and mass, held at one end."""
    length = LENGTH_MM * units.MM
    xml = _XML.format(
        step_s=step_s,
        count=_ELEMENTS + 1,
        spacing=length / _ELEMENTS,
        mass=NITINOL.mass_kg_per_m * length,
        radius=NITINOL.radius_mm * units.MM,
    )
    return mujoco.MjModel.from_xml_string(xml)


def run(folder: Path) -> list[report.Goal]:
    """Measure, print, write."""
    install()
    setup = setup_of(SMOOTH)
    step_s = setup.discretisation.step_s
    model = rope(step_s)
    data = mujoco.MjData(model)
    steps = round(END_S / step_s)

    def turn_of_rope() -> None:
        mujoco.mj_resetData(model, data)
        mujoco.mj_step(model, data, nstep=steps)

    least = report.least_times_s({"rope": turn_of_rope, "ours": rollout_of(setup)}, turns=7)
    if not np.isfinite(data.qpos).all():
        raise RuntimeError(
            f"expected a stable rope at steps of {step_s} s, found positions that are not finite"
        )
    rows = [{"what": name, "us a step": 1e6 * seconds / steps} for name, seconds in least.items()]
    report.show(f"1-D flex, {_ELEMENTS} elements", rows, folder, "flex")
    name = f"a step of MuJoCo's 1-D flex, n = {_ELEMENTS}"
    ratio = least["rope"] / least["ours"]
    return [report.Goal(name=name, measured=ratio, accuracy="cannot twist")]


if __name__ == "__main__":
    folder_ = report.out_folder(report.parser(__doc__))
    report.show_goals(run(folder_), folder_)
