"""Protocols that are nearly good; what is read, and is short, is simulated."""

import tempfile
from pathlib import Path

import numpy as np
from fuzz.mutations import changed_bytes, changed_lines, plausible, yaml_values
from fuzz.outcome import outcome
from hypothesis import strategies as st

from sim.experiment import perform
from sim.protocol import read_protocol
from sim.protocol_cost import recorded_bytes

GOOD = """\
name: two-layers
description: A turn in two layers
needle:
  diameter_mm: 0.59
  shear_modulus_gpa: 27.2
  density_g_cm3: 6.45
  tip_drag_n_mm_s_per_rad: 0.01
  curvature_n_mm_per_mm: 0.0001
  curvature_phase_deg: 10
  load_coefficient: 0.01
tissue:
  name: skin over plastisol
  layers:
    - thickness_mm: 15
      interface:
        viscous_n_mm_s_per_mm: 0.01
        kinetic_n_mm_per_mm: 0.002
        static_n_mm_per_mm: 0.003
        stribeck_rad_s: 0.1
    - interface:
        viscous_n_mm_s_per_mm: 0.01725
        exponent: 0.9
        stiffness_n_mm_per_rad_per_mm: 0.02
        time_constant_s: 1.0
  entry_friction_n_mm: 0.05
drive:
  stiffness_n_mm_per_rad: 100
  backlash_deg: 1
  sheath_friction_n_mm_per_mm: 0.0001
discretisation:
  elements: 8
  step_s: 0.01
  presliding_deg: 0.1
free_mm: 80
inserted_mm: 120
through: true
segments:
  - duration_s: 0.1
    turn_deg: 9
  - duration_s: 0.1
    advance_mm: -1
    dither_deg: 1
    dither_hz: 5
"""
_SHORT_BYTES = 3e7  # of a run that is worth its time here
_UNCONVERGED = "steps did not converge"

wrong = st.one_of(
    changed_lines(GOOD, yaml_values).map(str.encode),
    changed_lines(GOOD, plausible).map(str.encode),
    changed_bytes(GOOD.encode()),
    st.sampled_from(["utf-16", "utf-32", "cp037"]).map(GOOD.encode),
)
same = st.sampled_from(
    [
        GOOD.replace("\n", "\r\n").encode(),
        GOOD.encode("utf-8-sig"),
        ("# a comment\n---\n" + GOOD).encode(),
        GOOD.replace("two-layers", "'two-layers'").encode(),
        (GOOD.replace("free_mm: 80\n", "") + "free_mm: 80.0\n").encode(),
    ]
)


def checked(data, *, same=False):
    """Outcome of a protocol."""

    def action():
        with tempfile.TemporaryDirectory(prefix="fuzz-") as folder:
            path = Path(folder, "protocol.yaml")
            path.write_bytes(data)
            protocol = read_protocol(path)
            if same:
                path.write_text(GOOD)
                assert protocol == read_protocol(path)
        return _performed(protocol)

    return outcome(action, names=["protocol.yaml", *_SIMULATION], same=same)


_SIMULATION = ("finite outputs", "elements", "step_s", "landing", "free_mm", "inserted_mm")
"""What an error of a simulation names: the file has been read by then."""


def _performed(protocol):
    setup = protocol.setup()
    steps = protocol.schedule().duration_s / protocol.discretisation.step_s
    if recorded_bytes(steps, setup.nodes_mm.size - 1, len(setup.law)) > _SHORT_BYTES:
        return []
    recording = perform(protocol)
    assert all(np.isfinite(recording[name]).all() for name in recording.names)
    return [_UNCONVERGED] if recording["unconverged_count"][-1] else []
