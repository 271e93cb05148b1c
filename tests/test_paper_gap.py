"""The published figures as measurements: their spreads, their replay, fits and verdicts."""

import json
import math

import numpy as np
import pytest
from rich.console import Console
from scipy.stats import chi2, t

from diagnosis.effects.effect import Parameter
from diagnosis.paper import study as study_module
from diagnosis.paper import tried
from diagnosis.paper.candidates import CANDIDATES, DAMPING, Candidate
from diagnosis.paper.experiments import settling_s
from diagnosis.paper.figures import Experiment, Figure, Measure, gelatin, plastisol
from diagnosis.paper.fit import Fit, Fitter
from diagnosis.paper.hypothesis import Hypothesis
from diagnosis.paper.judge import Outcome, contradiction, judge, meets
from diagnosis.paper.outlook import prospects
from diagnosis.paper.reach import out_of_reach
from diagnosis.paper.replay import Replay
from diagnosis.paper.rig import STATED, BaseMotion, PaperRig, Shape
from diagnosis.paper.support import (
    chi_square_at,
    damping_share,
    mean_delay_s,
    price,
    scatter_needed,
)
from diagnosis.rig_model import RigModel
from models import published
from models.errors import OutputExists
from models.modes import InsertedNeedle, ramp
from models.needle import NITINOL
from scripts import paper_gap
from studies.crosscheck.paper import integral_deg_s

BETA = 3.45 / 200
MODEL_READING = PaperRig(free_mm=0.0)
SERVO = BaseMotion(shape=Shape.SERVO, time_s=0.11)


def spreads(figures):
    return np.array([f.spread for f in figures])


def test_the_figures_are_the_published_ones_and_none_of_the_compensators():
    values = [f.value for f in plastisol()]
    assert values == [0.37, 0.94, 1.39, 1.63, 0.67, 1.02, 27.0, 37.2]
    assert [f.value for f in gelatin()] == [0.17, 0.32, 0.49, 0.58]


def test_table_ii_spreads_as_it_scatters_about_its_line():
    depth = np.array([25.0, 50.0, 75.0, 100.0])[:, None]
    for figures in (plastisol()[:4], gelatin()):
        values = np.array([f.value for f in figures])
        _, squares, *_ = np.linalg.lstsq(depth, values, rcond=None)
        assert figures[0].spread == pytest.approx(math.sqrt(squares[0] / 3))


def test_tables_iv_and_v_spread_by_a_stated_fraction_and_their_rounding():
    # A last digit of 0.01 s leaves 0.01 / sqrt(12) s.
    assert plastisol(0.05)[4].spread == pytest.approx(math.hypot(0.0335, 0.01 / math.sqrt(12)))
    assert plastisol(0.0)[7].spread == pytest.approx(0.1 / math.sqrt(12))


@pytest.mark.parametrize("depth_mm", [50.0, 100.0])
def test_the_stated_model_gives_what_the_closed_form_gives(depth_mm):
    time = np.arange(0.0, 4.0, 1e-3)
    needle = InsertedNeedle(needle=NITINOL, damping_n_mm_s_per_mm=BETA, inserted_mm=depth_mm)
    exact = needle.respond(time, ramp(time, by=math.radians(90), duration_s=0.3))
    error = 90 - np.degrees(exact.tip_rad)
    figures = [f for f in plastisol() if f.depth_mm == depth_mm]
    damping, settled, integral = Replay()(figures, [MODEL_READING])[:, 0]
    # The discretisation was measured to stay within a twentieth of every spread.
    assert damping == pytest.approx(BETA * depth_mm, abs=figures[0].spread / 20)
    assert settled == pytest.approx(settling_s(time, error), abs=figures[1].spread / 20)
    assert integral == pytest.approx(integral_deg_s(time, error), abs=figures[2].spread / 20)


def test_the_replay_is_fine_enough_where_the_tissue_is_not_linear():
    rigs = [
        PaperRig(model=RigModel(shared=8e-4, damping_scale=0.4), motion=SERVO),
        PaperRig(model=RigModel(kinetic=1e-3, damping_scale=0.3)),
        PaperRig(model=RigModel(exponent=0.65, damping_scale=0.4)),
        PaperRig(model=RigModel(tissue_stiffness=0.004, tissue_time=1.3)),
    ]
    coarse = Replay()(plastisol(), rigs)
    fine = Replay(elements=12, refined=4)(plastisol(), rigs)
    assert np.abs((coarse - fine).T / spreads(plastisol())).max() < 0.05


def test_settling_is_between_samples_and_later_the_farther_it_is_from_settled():
    time = np.array([0.0, 1.0, 2.0])
    assert settling_s(time, np.array([9.0, 5.0, 1.0])) == pytest.approx(1.5)
    assert settling_s(time, np.array([2.0, 1.0, 0.0])) == 0.0
    late, later = (settling_s(time, np.array([9.0, 8.0, end])) for end in (4.0, 5.0))
    assert 2.0 < late < later
    # It counts that the error leaves the band again, on either side.
    assert settling_s(time, np.array([9.0, 0.0, -4.0])) > 2.0


@pytest.mark.parametrize(
    "motion", [BaseMotion(time_s=0.1), BaseMotion(time_s=0.6), BaseMotion(shape=Shape.SERVO, time_s=0.1)]
)
def test_table_v_between_two_depths_knows_nothing_of_the_base(motion):
    """In viscous tissue its difference is the turn times the difference of the delays."""
    figures = [f for f in plastisol() if f.measure is Measure.INTEGRAL]
    shallow, deep = Replay()(figures, [PaperRig(free_mm=0.0, motion=motion)])[:, 0]
    expected = 90 * (mean_delay_s(100, 0) - mean_delay_s(50, 0))
    # The integral ends at 2 s: of the slowest mode exp(-8.2 (2 s - 1 s)) is left by then.
    assert deep - shallow == pytest.approx(expected, rel=2e-3)


def test_the_damping_that_table_v_shows_is_found_again():
    rig = PaperRig(model=RigModel(damping_scale=0.6), free_mm=0.0, motion=SERVO)
    figures = as_published(rig)
    assert damping_share(0.0, figures).value == pytest.approx(0.6, rel=5e-3)
    # What the paper prints is far from the stated damping: by hand (37.2 - 27) / (90 x 0.2).
    share = damping_share(0.0)
    assert share.value == pytest.approx(0.567, abs=1e-3)
    assert share.value + 3 * share.spread < 1.0


def as_published(rig, replay=None):
    """The figures that a rig would have had printed, with the spreads of the real ones."""
    values = (replay or Replay(elements=8, refined=2))(plastisol(), [rig])[:, 0]
    return tuple(
        Figure(**{**vars(f), "value": float(v)}) for f, v in zip(plastisol(), values, strict=True)
    )


class Line:
    """Stands for the replay: every figure is its depth times the damping's scale."""

    def __call__(self, figures, rigs):
        return np.array([[f.depth_mm * rig.model.damping_scale for rig in rigs] for f in figures])


def line_figures(values, spread):
    return tuple(
        Figure(
            source="line",
            experiment=Experiment.SLOW_TURN,
            measure=Measure.DAMPING,
            depth_mm=float(i + 1),
            value=v,
            unit="-",
            spread=spread,
            why="",
        )
        for i, v in enumerate(values)
    )


def fit_line(values, spread):
    hypothesis = Hypothesis(names=(DAMPING.name,), base=PaperRig(), candidates=(DAMPING,))
    return Fitter(line_figures(values, spread), Line()).fit(hypothesis)


def test_a_fit_is_least_squares_and_its_left_out_figures_are_predicted_without_them():
    x, y, sigma = np.arange(1.0, 6.0), np.array([1.1, 1.9, 3.2, 3.9, 5.1]), 0.1
    found = fit_line(y, sigma)
    slope = x @ y / (x @ x)
    # A fit ends within hundredths of a spread: 0.03 of gradient moves chi-square by 1e-3.
    assert found.chi_square == pytest.approx(((slope * x - y) ** 2).sum() / sigma**2, abs=2e-3)
    assert found.freedom == 4
    assert found.p_value == pytest.approx(chi2.sf(found.chi_square, 4))
    for i in range(5):
        others = np.arange(5) != i
        without = x[others] @ y[others] / (x[others] @ x[others])
        # The logarithm of the scale is curved: one step of it is right to second order.
        assert found.left_out[i] == pytest.approx((without * x[i] - y[i]) / sigma, abs=0.03)


def test_intervals_hold_the_truth_as_often_as_they_say():
    rng, found = np.random.default_rng(3), []
    for _ in range(200):
        values = 0.8 * np.arange(1.0, 6.0) + rng.normal(0, 0.1, 5)
        found.append(fit_line(values, 0.1).intervals()[0])
    # Student's t with 4 degrees of freedom where the spread is known is on the safe side of
    # 95 %: 2.776 standard errors hold 99.4 %.
    inside = sum(low <= 0.8 <= high for _, low, high in found)
    assert inside >= 190
    # No wider than that makes them, in the median: then no misfit widens them.
    error = 0.1 / math.sqrt(55)
    width = np.median([high - low for _, low, high in found])
    assert width == pytest.approx(2 * t.ppf(0.975, 4) * error, rel=0.03)


def test_scatter_beyond_the_spreads_widens_the_interval():
    calm, wild = (fit_line(y, 0.1).intervals()[0] for y in ([1, 2, 3, 4], [2, 1, 4, 3]))
    assert wild[2] - wild[1] > 3 * (calm[2] - calm[1])


def test_a_parameter_that_no_figure_shows_keeps_its_whole_range():
    blind = Candidate(
        name="blind",
        place="sensor",
        parameters=(Parameter(name="p", unit="-", low=-1.0, high=2.0, start=(0.5,)),),
        enter=lambda rig, p: rig,
    )
    hypothesis = Hypothesis(names=("blind",), base=PaperRig(), candidates=(DAMPING, blind))
    found = Fitter(line_figures([1.0, 2.0, 3.1], 0.1), Line()).fit(hypothesis)
    assert found.intervals()[1][1:] == pytest.approx((-1.0, 2.0))


def test_parameters_cost_more_the_nearer_they_come_to_the_figures():
    # By hand, n = 8: k = 3 costs 6 + 24 / 4, k = 6 costs 12 + 84 / 1.
    assert price(8)[3] == pytest.approx(12.0)
    assert price(8)[6] == pytest.approx(96.0)
    assert 7 not in price(8)


def fitted(names, z, *, base=MODEL_READING, parameters=0, model=None):
    """A fit to plastisol with given misses, whatever the needle says."""
    figures = plastisol()
    candidate = Candidate(
        name=names[0] if names else "none",
        place="-",
        parameters=(Parameter(name="p", unit="-", low=0.0, high=1.0, start=(0.5,)),) * parameters,
        enter=lambda rig, *p: PaperRig(model=model or RigModel()),
    )
    return Fit(
        hypothesis=Hypothesis(names=names, base=base, candidates=(candidate,)),
        figures=figures,
        x=np.zeros(parameters),
        missed=np.full(8, float(z)),
        jacobian=np.zeros((8, parameters)),
        left_out=np.full(8, float(z)),
    )


def test_the_verdicts_are_none_explained_undecided_and_unknown():
    bad, good = fitted((), 4.0), fitted((), 0.5)
    assert judge([good], [fitted(("a",), 0.1, parameters=2)]).outcome is Outcome.NONE
    assert judge([bad], [fitted(("a",), 3.0, parameters=2)]).outcome is Outcome.UNKNOWN
    one, other = (fitted((n,), 0.8, parameters=2) for n in "ab")
    explained = judge([bad], [one, fitted(("b",), 3.0, parameters=2)])
    assert (explained.outcome, explained.effects) == (Outcome.EXPLAINED, ("a",))
    undecided = judge([bad], [one, other])
    assert (undecided.outcome, undecided.confusable) == (Outcome.UNDECIDED, (("a",), ("b",)))
    assert undecided.effects == ()


def test_a_richer_form_of_an_explanation_does_not_make_it_undecided():
    one, pair = fitted(("a",), 0.8, parameters=1), fitted(("a", "b"), 0.6, parameters=2)
    assert judge([fitted((), 4.0)], [one, pair]).effects == ("a",)


def test_an_explanation_that_asks_too_many_parameters_is_none():
    assert not meets(fitted(("a",), 0.0, parameters=7))
    assert meets(fitted(("a",), 0.0, parameters=5))


def test_the_twist_test_rules_out_another_stiffness_and_a_soft_chuck():
    assert contradiction(fitted(("a",), 0.0)) == ""
    assert "2.48 N mm" in contradiction(fitted(("a",), 0.0, model=RigModel(stiffness_scale=2.0)))
    assert contradiction(fitted(("a",), 0.0, model=RigModel(base_stiffness=1.0)))
    assert not meets(fitted(("a",), 0.0, parameters=1, model=RigModel(stiffness_scale=2.0)))


def test_the_scatter_needed_is_the_one_at_which_chance_is_enough():
    fit = fitted((), 3.0)
    needed = scatter_needed(fit)
    assert needed > 0.05
    assert chi_square_at(fit, 0.05) == pytest.approx(72.0)
    # Table II keeps its own spreads; 9 x 4 of chi-square stays, above any limit for 8 figures.
    assert math.isinf(scatter_needed(fitted((), 4.0)))


@pytest.fixture(scope="module")
def two_effects():
    """Figures of a rig with a servo and shared friction, from a finer needle, unrounded."""
    truth = RigModel(shared=8e-4, damping_scale=0.4)
    return as_published(PaperRig(model=truth, motion=SERVO))


def test_what_made_the_figures_is_found_and_what_did_not_is_not(two_effects):
    replay = Replay()
    fitter = Fitter(two_effects, replay)
    base = tried.READINGS[0]
    pair = fitter.fit(tried.of_plastisol(base, "base_servo", "speed_dependent_friction"))
    # The needle of the figures is finer: a twentieth of a spread each, chi-square below 8 / 400.
    assert pair.chi_square < 0.05
    value, low, high = pair.intervals()[2]
    assert low < 8e-4 < high
    assert value == pytest.approx(8e-4, rel=0.03)
    alone = fitter.fit(tried.of_plastisol(base, "tip_sensor_delay"))
    assert alone.p_value < 1e-6
    # Both settle far sooner than the stated damping lets a needle with 50 mm free: no delay helps.
    assert {f.name for f in out_of_reach(alone, replay)} >= {"Table V, integral, 10 cm"}
    told = prospects([pair, alone], replay)
    assert told[0].apart == 1.0
    assert all(p.apart == 0.0 for p in prospects([pair, pair], replay))


def test_every_candidate_can_be_entered_within_its_bounds():
    for name in CANDIDATES:
        hypothesis = tried.of_plastisol(tried.READINGS[0], name)
        low, high = hypothesis.bounds()
        for start in hypothesis.starts():
            assert np.all((low <= start) & (start <= high)), name
        assert any(hypothesis.rig(start) != PaperRig() for start in hypothesis.starts()), name


def test_no_pair_has_two_motions_of_the_base_or_a_free_length_where_there_is_none():
    alone = [fitted(h.names, 3.0, base=h.base, parameters=2) for h in tried.singles()]
    for pair in tried.pairs(alone):
        assert not {"base_ramp", "base_servo"} <= set(pair.names)
        assert pair.base.free_mm > 0 or "free_length" not in pair.names
        assert len(set(pair.names)) == 2


def test_the_stated_rig_is_the_papers():
    assert STATED.tissue.damping_n_mm_s_per_mm * 200 == published.DAMPING_200_MM.value
    assert PaperRig().free_mm == 50.0
    assert PaperRig().motion.angle_deg(np.array([0.15, 1.0])) == pytest.approx([45.0, 90.0])
    # Critically damped: 1 - 2 / e after one time constant, and never beyond the wish.
    assert SERVO.angle_deg(np.array([0.11]))[0] == pytest.approx(90 * (1 - 2 / math.e))
    assert SERVO.angle_deg(np.linspace(0, 3, 100)).max() <= 90.0


def test_the_command_reports_in_json_and_on_a_page_that_needs_no_network(tmp_path, monkeypatch, capsys):
    base = tried.READINGS[1]
    few = [tried.of_plastisol(base, n) for n in (DAMPING.name, "base_servo", "shear_thinning")]
    pair = tried.of_plastisol(base, "base_servo", "shear_thinning")
    monkeypatch.setattr(tried, "singles", lambda: few)
    monkeypatch.setattr(tried, "pairs", lambda alone: [pair])
    monkeypatch.setattr(study_module, "OF_GELATIN", ("coulomb_friction", "torque_bias"))
    monkeypatch.setattr(study_module, "compensated", lambda: ())
    folder = tmp_path / "out"
    assert paper_gap.run(folder, json_only=True, force=False, console=Console()) == 0
    printed = json.loads(capsys.readouterr().out, parse_constant=pytest.fail)
    assert printed == json.loads((folder / "paper.json").read_text(), parse_constant=pytest.fail)
    plastisol_found, gelatin_found = (printed["materials"][m] for m in ("plastisol", "gelatin"))
    assert (plastisol_found["verdict"], gelatin_found["effects"]) == ("explained", ["coulomb_friction"])
    settled = plastisol_found["figures"][5]["ours"]["50 mm free"]
    assert settled["ratio"] == pytest.approx(settled["value"] / 1.02)
    assert settled["ratio"] == pytest.approx(1.8, abs=0.02)
    page = (folder / "paper.html").read_text()
    assert page.index("explained: the stated model misses") < page.index("How much")
    assert "://" not in page
    assert page.count("data:image/png;base64,") == 3
    with pytest.raises(OutputExists):
        paper_gap.run(folder, json_only=True, force=False, console=Console())
