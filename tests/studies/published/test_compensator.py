"""The compensator's columns beside ours."""

from types import SimpleNamespace

from models import published
from studies.published import compensator
from studies.published.compensator import compensator_figures
from studies.published.experiments.rig import WITHOUT_FREE_LENGTH


def test_every_figure_of_the_compensator_stands_beside_its_own_turn(monkeypatch):
    # A turn that settles in its depth in s, with an integral of ten times as much; feedback halves both.
    def turn(controller, *, depth_cm, free_mm, tissue):
        assert (free_mm, tissue.name) == (0.0, "viscous-plastisol")
        return SimpleNamespace(run=depth_cm / (2 if controller == "feedback" else 1))

    monkeypatch.setattr(compensator, "turn", turn)
    monkeypatch.setattr(compensator, "response_metrics", lambda settles: (settles, 10 * settles))
    found = {f.name: f for f in compensator_figures([WITHOUT_FREE_LENGTH])}
    assert len(found) == 8
    settling = found["Table IV, feedback, 10 cm"]
    assert (settling.published, settling.simulated) == (published.TABLE_IV_SETTLE_S[10][2], 5.0)
    integral = found["Table V, feedforward, 5 cm"]
    assert (integral.published, integral.simulated) == (published.TABLE_V_INTEGRAL_DEG_S[5][1], 50.0)
    assert (integral.unit, integral.free_length) == ("s deg", "no free length")
