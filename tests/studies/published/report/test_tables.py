"""The findings as tables."""

import pytest

from studies.published.report.tables import (
    accepted_table,
    compensator_table,
    figure_table,
    mechanism_table,
    proposed_table,
    text_ranking_table,
    text_table,
)


def test_every_table_has_as_many_cells_in_each_row_as_columns(study):
    tables = [proposed_table(study), compensator_table(study), text_ranking_table(study.plastisol)]
    for material in (study.plastisol, study.gelatin):
        tables += [
            make(material) for make in (figure_table, mechanism_table, accepted_table, text_table)
        ]
    for table in tables:
        assert table.rows
        assert {len(row) for row in table.rows} == {len(table.head)}


def test_published_and_simulated_stand_beside_each_other_for_each_free_length(study):
    table = figure_table(study.plastisol)
    row = dict(zip(table.head, table.rows[5], strict=False))
    assert (row["figure"], row["published"]) == ("Table IV, settling, 10 cm", "1.02 s")
    assert float(row["simulated, 50 mm free"]) == pytest.approx(1.84)
    assert float(row["simulated, no free length"]) == pytest.approx(0.954)


def test_accepted_mechanisms_have_a_star_and_their_values(study):
    starred = [row[0] for row in mechanism_table(study.plastisol).rows if row[0].endswith("*")]
    assert starred == ["base_servo and shear_thinning *"]
    (accepted,) = accepted_table(study.plastisol).rows
    assert "base_servo time 0.1" in accepted[2]


def test_the_values_can_be_left_out(study):
    full, short = mechanism_table(study.plastisol), mechanism_table(study.plastisol, with_values=False)
    assert set(full.head) - set(short.head) == {"values (95 %)"}
    assert short.rows[0] == (*full.rows[0][:2], *full.rows[0][3:])


def test_the_compensators_figures_are_printed_with_their_ratio(study):
    assert compensator_table(study).rows == (
        ("Table IV, feedback, 5 cm", "no free length", "0.5 s", "0.25", "0.50"),
    )


def test_fits_are_ranked_by_the_figures_that_none_of_them_used(study):
    table = text_ranking_table(study.plastisol)
    misses = [float(row[-2]) for row in table.rows]
    assert misses == sorted(misses)
    assert len(table.rows) == len(study.plastisol.fits)
    assert {row[0] for row in table.rows} == {"base_servo", "base_servo and shear_thinning *"}
