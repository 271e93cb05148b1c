"""`paper.html`: the study for readers, in one file that opens without a network."""

from diagnosis.report.fallible import Page, drawn, page_of
from diagnosis.report.html_parts import bullets, heading, paragraph, table, warnings
from studies.published.material_study import MaterialStudy
from studies.published.report.insertion_tables import insertion_sentences, insertion_table
from studies.published.report.limitations import limitations
from studies.published.report.pictures import draw_fits, draw_quick_turns, draw_residuals
from studies.published.report.sentences import next_experiment, verdict_sentence
from studies.published.report.tables import (
    TextTable,
    compensator_table,
    figure_table,
    mechanism_table,
    proposed_table,
    text_ranking_table,
    text_table,
)
from studies.published.study import PublishedStudy

_SIGMA = (
    "σ is the standard deviation of a figure. The paper prints none. For Table II it is the scatter of "
    "each column; for Tables IV and V it is assumed to be rounding and 5 % of the figure."
)
_COMPENSATOR = "The paper states neither the compensator's gains nor its motor; those here are our own."
_NEAREST = "The fits to the tables that come nearest to these figures; no fit used these figures:"
_RESIDUALS_ALT = (
    "Bars: simulated minus published over σ for the {count} figures of {material}, for the stated model "
    "and the leading explanations. The stated model is up to {largest:.0f} σ off; 2 σ are shaded."
)
_TURNS_ALT = (
    "Tip and base angle over time in the quick turn at 5 cm and 10 cm, for the stated model and the "
    "leading explanations, with the published settling times."
)
_FITS_ALT = (
    "Bars: rms residual over σ of the hypotheses with the lowest AICc, the accepted ones in red; dots: "
    "the rms residual of each figure left out in turn. The best is at {best:.2f} σ."
)


def page(study: PublishedStudy) -> Page:
    """The whole page."""
    plastisol, gelatin = study.plastisol, study.gelatin
    return page_of(
        "The published figures as a rig",
        [
            heading(verdict_sentence(plastisol), level=1),
            paragraph(_SIGMA),
            *warnings(study.warnings),
            heading("What the figures support"),
            bullets(limitations(study)),
            *_stated_model(plastisol),
            *_mechanisms(plastisol),
            heading("Figures in the paper's text"),
            _table(text_table(plastisol)),
            paragraph(_NEAREST),
            _table(text_ranking_table(plastisol)),
            heading("Steered insertions"),
            bullets(insertion_sentences(study.insertions)),
            _table(insertion_table(study.insertions)),
            heading("Experiments that would separate the explanations"),
            paragraph(next_experiment(study)),
            _table(proposed_table(study)),
            heading("Gelatin"),
            paragraph(verdict_sentence(gelatin)),
            *(_table(t(gelatin)) for t in (figure_table, mechanism_table, text_table)),
            heading("Turns with the torsion compensator"),
            paragraph(_COMPENSATOR),
            _table(compensator_table(study)),
        ],
    )


def _stated_model(study: MaterialStudy) -> list[str]:
    largest = max(float(abs(fit.residual).max()) for fit in study.stated)
    alt = _RESIDUALS_ALT.format(count=len(study.figures), material=study.material, largest=largest)
    return [
        heading("Stated model and published figures"),
        _table(figure_table(study)),
        drawn(draw_residuals, lambda _: alt, study),
        heading("The quick turn"),
        drawn(draw_quick_turns, lambda _: _TURNS_ALT, study),
    ]


def _mechanisms(study: MaterialStudy) -> list[str]:
    best = min(study.fits, key=lambda f: f.aicc).rms_residual
    return [
        heading("Mechanisms that may explain the residual"),
        drawn(draw_fits, lambda _: _FITS_ALT.format(best=best), study),
        _table(mechanism_table(study)),
    ]


def _table(content: TextTable) -> str:
    return table(content.head, content.rows)
