"""The paper's experiments by name.

Non-translating (Figs. 3, 4): 23 cm of shaft between base and tissue. Translating
(Fig. 5): 5 cm at the start, retracting at 2.5 mm/s. Where the paper says only that the
base was turned "quickly" or the needle retracted, the times are assumptions of this project.
"""

from collections.abc import Callable

from models.errors import UnknownName
from models.materials import MATERIALS
from sim.discretisation import Discretisation
from sim.protocol import Protocol, Segment

_FREE_MM = 230.0
_QUICK_S = 0.3
_RETRACT = Segment(duration_s=1.0, advance_mm=-5.0)
_REST = Segment(duration_s=4.0)


def slow_ramp(material: str = "porcine-gelatin", depth_mm: float = 100.0) -> Protocol:
    """Fig. 3: 90 deg over 20 s, hold 10 s, retract 5 mm."""
    return Protocol(
        name=f"fig3-{material}",
        description="Fig. 3: 90 deg over 20 s, held 10 s, retracted 5 mm",
        tissue=material,
        free_mm=_FREE_MM,
        inserted_mm=depth_mm,
        through=True,
        segments=(Segment(duration_s=20, turn_deg=90), Segment(duration_s=10), _RETRACT, _REST),
    )


def reversal(depth_mm: float) -> Protocol:
    """Fig. 4: 90 deg over 20 s, hold 10 s, back over 20 s, hold 10 s, retract 5 mm."""
    return Protocol(
        name=f"fig4-{depth_mm / 10:g}cm",
        description="Fig. 4: a slow turn, hold, reversal and retraction in porcine gelatin",
        tissue="porcine-gelatin",
        free_mm=_FREE_MM,
        inserted_mm=depth_mm,
        through=True,
        segments=(
            Segment(duration_s=20, turn_deg=90),
            Segment(duration_s=10),
            Segment(duration_s=20, turn_deg=-90),
            Segment(duration_s=10),
            _RETRACT,
            _REST,
        ),
    )


def fast_turn(depth_mm: float) -> Protocol:
    """Fig. 5: a fast turn by 90 deg while retracting at 2.5 mm/s in soft plastisol."""
    speed = -2.5
    return Protocol(
        name=f"fig5-{depth_mm / 10:g}cm",
        description="Fig. 5: 90 deg in 0.3 s while the needle slides at 2.5 mm/s",
        tissue="soft-plastisol",
        free_mm=50,
        inserted_mm=depth_mm,
        through=True,
        segments=(
            Segment(duration_s=1.0, advance_mm=speed),
            Segment(duration_s=_QUICK_S, turn_deg=90, advance_mm=speed * _QUICK_S),
            Segment(duration_s=8.0, advance_mm=speed * 8.0),
        ),
    )


def kelvin_voigt(kind: str) -> Protocol:
    """Fig. 8: a fast turn in yielding tissue, soft or a hundred times stiffer."""
    return Protocol(
        name=f"fig8-{kind}",
        description="Fig. 8: 90 deg in 0.3 s, 20 cm deep, 5 cm free, Kelvin-Voigt tissue",
        tissue=f"{kind}-plastisol",
        free_mm=50,
        inserted_mm=200,
        through=True,
        segments=(Segment(duration_s=_QUICK_S, turn_deg=90), Segment(duration_s=8.0)),
    )


def stiction(how: str) -> Protocol:
    """Section II-B3: stiction broken by retracting and reinserting, or by dither."""
    breaking = (
        (_RETRACT, Segment(duration_s=1.0, advance_mm=5.0))
        if how == "retraction"
        else (Segment(duration_s=2.0, dither_deg=30, dither_hz=5),)
    )
    return Protocol(
        name=f"stiction-{how}",
        description=f"Section II-B3: a slow turn in porcine gelatin, then {how}",
        tissue="porcine-gelatin",
        free_mm=_FREE_MM,
        inserted_mm=100,
        through=True,
        segments=(Segment(duration_s=5, turn_deg=90), Segment(duration_s=2), *breaking, _REST),
    )


def insertion() -> Protocol:
    """Figs. 11, 12: 7 cm at 5 mm/s from the surface, half a turn to or fro after each of 4 cm."""
    advance = [Segment(duration_s=2.0, advance_mm=10.0)]
    for turn_deg in (180, -180, 180, -180):
        advance.append(Segment(duration_s=_QUICK_S, turn_deg=turn_deg, advance_mm=5 * _QUICK_S))
        advance.append(Segment(duration_s=2 - _QUICK_S, advance_mm=5 * (2 - _QUICK_S)))
    advance.append(Segment(duration_s=4.0, advance_mm=20.0))
    return Protocol(
        name="insertion",
        description="7 cm into soft plastisol at 5 mm/s, with four half turns, to and fro, on the way",
        tissue="soft-plastisol",
        # The tissue reaches the first centimetres element by element: take small ones.
        discretisation=Discretisation(elements=48),
        free_mm=120,
        inserted_mm=0,
        segments=tuple(advance),
    )


PROTOCOLS: dict[str, Callable[[], Protocol]] = {
    "insertion": insertion,
    **{f"fig3-{m}": (lambda m=m: slow_ramp(m)) for m in MATERIALS},  # type: ignore[misc]
    **{f"fig4-{d / 10:g}cm": (lambda d=d: reversal(d)) for d in (25, 50, 75, 100)},  # type: ignore[misc]
    **{f"fig5-{d / 10:g}cm": (lambda d=d: fast_turn(d)) for d in (50, 100, 200)},  # type: ignore[misc]
    **{f"fig8-{k}": (lambda k=k: kelvin_voigt(k)) for k in ("soft", "hard")},  # type: ignore[misc]
    **{f"stiction-{h}": (lambda h=h: stiction(h)) for h in ("retraction", "dither")},  # type: ignore[misc]
}


def protocol_named(name: str) -> Protocol:
    """One of the paper's experiments.

    Raises:
      UnknownName: lists the known names.
    """
    if name not in PROTOCOLS:
        raise UnknownName("protocol", name, PROTOCOLS)
    return PROTOCOLS[name]()
