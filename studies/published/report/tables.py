"""The findings as tables: rows of text, the head first."""

from collections.abc import Sequence

from studies.published.experiments.figures import Figure
from studies.published.fitting.fit import Fit, rms
from studies.published.report.sentences import parameters, shown, title
from studies.published.selection.verdict import contradiction, still_open
from studies.published.study import Case, Study

_MOST_PAIRS = 12


def figure_rows(case: Case) -> list[list[str]]:
    """Published, ours and ratio of every figure, in every reading."""
    head = ["figure", "published", "spread"]
    for fit in case.stated:
        head += [f"ours{_reading(fit, case, before=', ')}", "ratio", "spreads"]
    rows = [head]
    for i, figure in enumerate(case.figures):
        row = [figure.name, f"{figure.value:g} {figure.unit}", f"{figure.spread:.2g}"]
        for fit in case.stated:
            ours = float(fit.predicted[i])
            row += [shown(figure, ours), f"{ours / figure.value:.2f}", f"{fit.missed[i]:+.1f}"]
        rows.append(row)
    return rows


def _reading(fit: Fit, case: Case, *, before: str = "") -> str:
    """The reading of a fit, where there is more than one."""
    return before + fit.hypothesis.reading if len(case.stated) > 1 else ""


def candidate_rows(case: Case) -> list[list[str]]:
    """Every single candidate and the best pairs, in the order of AICc."""
    head = [
        "candidate",
        "reading",
        "values (95 %)",
        "gap",
        "left out",
        "p",
        "AICc",
        "still open",
        "cannot",
    ]
    alone = [f for f in case.fits if len(f.hypothesis.names) == 1]
    both = [f for f in case.fits if len(f.hypothesis.names) > 1][:_MOST_PAIRS]
    return [head, *(_candidate_row(fit, case) for fit in (*alone, *both))]


def _candidate_row(fit: Fit, case: Case) -> list[str]:
    values = [
        f"{candidate} {name} {p['value']:.3g} ({p['low']:.3g} to {p['high']:.3g}) {p['unit']}"
        for candidate, of in parameters(fit).items()
        for name, p in of.items()
    ]
    before = next(s.gap for s in case.stated if s.hypothesis.base == fit.hypothesis.base)
    mark = " *" if fit in case.verdict.accepted else ""
    return [
        title(fit.hypothesis.names) + mark,
        _reading(fit, case),
        "; ".join(value.removesuffix(" -") for value in values),
        f"{before:.1f} to {fit.gap:.2f}",
        f"{rms(fit.left_out):.2f}",
        f"{fit.p_value:.2g}",
        f"{fit.aicc:.1f}",
        _short(still_open(fit)),
        contradiction(fit) or _short(case.beyond.get(fit.hypothesis, ())),
    ]


def _short(figures: Sequence[Figure]) -> str:
    """Figures by table and depth."""
    return ", ".join(f"{f.source.removeprefix('Table ')} {f.depth_mm / 10:g} cm" for f in figures)


def word_rows(case: Case) -> list[list[str]]:
    """What the text says, beside the stated rig and the accepted explanations."""
    fits = case.verdict.accepted or (case.verdict.best,)
    names = [title(f.hypothesis.names) + _reading(f, case, before=", ") for f in fits]
    rows = [["in words", "published", "stated", *names]]
    for said in case.in_words:
        values = [shown(said.figure, v) for v in (said.stated, *said.predicted)]
        rows.append([said.figure.name, f"about {said.figure.value:g} {said.figure.unit}", *values])
    return rows


def prospect_rows(study: Study) -> list[list[str]]:
    """Further experiments under each accepted explanation."""
    fits = study.plastisol.verdict.accepted
    names = [f"{title(f.hypothesis.names)}, {f.hypothesis.reading}" for f in fits]
    rows = [["experiment", "measured", "tells apart", *names]]
    for p in study.prospects:
        rows.append(
            [
                f"{p.figure.experiment.value}, {p.figure.depth_mm / 10:g} cm",
                f"{p.figure.measure.value}, {p.figure.unit}",
                f"{100 * p.apart:.0f} % of pairs",
                *(shown(p.figure, v) for v in p.predicted),
            ]
        )
    return rows


def compensator_rows(study: Study) -> list[list[str]]:
    """The compensator's columns beside ours."""
    rows = [["figure", "reading", "published", "ours", "ratio"]]
    for c in study.compensated:
        printed = f"{c.published:g} {c.unit}"
        rows.append([c.name, c.reading, printed, f"{c.ours:.3g}", f"{c.ours / c.published:.2f}"])
    return rows
