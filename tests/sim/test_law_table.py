"""Rows of the law table: SI values, ends of layers, and rows that do nothing."""

import numpy as np
import pytest

from models.drive import Drive
from models.needle import NITINOL
from models.tissue import Interface, Layer, Section, Tissue
from sim.kernel import memory_map as column
from sim.law_table import law_table

VISCOUS = Tissue.uniform(viscous_n_mm_s_per_mm=0.02)


def end_mm(row, which, *, free, inserted):
    """Where a row begins (TOP) or ends (END), mm from the chuck."""
    a, b, c = (getattr(column, f"L_{which}_{part}") for part in ("CONST", "FREE", "INSERTED"))
    return 1e3 * row[a] + row[b] * free + row[c] * inserted


def test_values_are_in_si():
    """N mm per mm is N; N mm s / rad per mm is N s / rad."""
    law = Interface(
        viscous_n_mm_s_per_mm=0.02,
        kinetic_n_mm_per_mm=1e-3,
        static_n_mm_per_mm=2e-3,
        stribeck_rad_s=0.1,
        stiffness_n_mm_per_rad_per_mm=0.3,
        time_constant_s=1.5,
    )
    row = law_table(NITINOL, Drive(), Tissue(layers=(Layer(interface=law),)))[0]
    fields = ("VISCOUS", "KINETIC", "STATIC", "STRIBECK", "STIFFNESS", "TIME")
    values = [row[getattr(column, f"L_{field}")] for field in fields]
    assert values == pytest.approx([0.02, 1e-3, 2e-3, 0.1, 0.3, 1.5])


def test_layers_end_where_the_next_begins_whatever_the_lengths():
    layers = (
        Layer(interface=Interface(), thickness_mm=10),
        Layer(interface=Interface(), fraction=0.25),
        Layer(interface=Interface()),
    )
    table = law_table(NITINOL, Drive(), Tissue(layers=layers))
    for free, inserted in ((50.0, 100.0), (80.0, 60.0)):
        lengths = {"free": free, "inserted": inserted}
        tops = [end_mm(row, "TOP", **lengths) for row in table]
        ends = [end_mm(row, "END", **lengths) for row in table]
        assert ends[:-1] == pytest.approx(tops[1:])
        depths = Tissue(layers=layers).boundaries_mm(inserted)
        assert [tops[0], *ends] == pytest.approx(free + depths)


def test_sheath_entry_and_tip_have_rows_of_their_own_where_they_act():
    needle = NITINOL.but(tip_drag_n_mm_s_per_rad=0.3, load_coefficient=0.5)
    table = law_table(
        needle, Drive(sheath_friction_n_mm_per_mm=0.003), VISCOUS.but(entry_friction_n_mm=0.2)
    )
    _, sheath, entry, tip = table
    lengths = {"free": 50.0, "inserted": 100.0}
    assert (end_mm(sheath, "TOP", **lengths), end_mm(sheath, "END", **lengths)) == (0, 50)
    assert sheath[column.L_KINETIC] == pytest.approx(0.003)
    assert (end_mm(entry, "TOP", **lengths), entry[column.L_KINETIC]) == pytest.approx((50, 2e-4))
    assert (end_mm(tip, "TOP", **lengths), tip[column.L_VISCOUS]) == pytest.approx((150, 3e-4))
    assert tip[column.L_LOAD] == 0.5
    assert table[:, column.L_POINT].tolist() == [0, 0, 1, 1]


def test_padding_rows_have_no_friction_and_only_fill_up():
    short, padded = (law_table(NITINOL, Drive(), VISCOUS, rows=rows) for rows in (0, 4))
    assert padded.shape == (4, column.COLUMNS)
    assert np.array_equal(padded[:1], short)
    acting = [column.L_VISCOUS, column.L_KINETIC, column.L_STATIC, column.L_SHARED, column.L_STIFFNESS]
    assert not padded[1:, acting].any()
    assert law_table(NITINOL, Drive(), VISCOUS, rows=1).shape == short.shape


def test_a_table_that_others_may_share_cannot_be_changed():
    with pytest.raises(ValueError, match="read-only"):
        law_table(NITINOL, Drive(), VISCOUS)[0, 0] = 1.0


@pytest.mark.parametrize(("free", "inserted"), [(50.0, 100.0), (80.0, 60.0)])
def test_a_section_of_the_shaft_moves_with_its_tip(free, inserted):
    section = Section(interface=Interface(kinetic_n_mm_per_mm=2e-3), from_tip_mm=10.0, length_mm=30.0)
    row = law_table(NITINOL, Drive(), VISCOUS.but(sections=(section,)))[1]
    ends = [end_mm(row, which, free=free, inserted=inserted) for which in ("TOP", "END")]
    assert ends == pytest.approx([free + inserted - 40.0, free + inserted - 10.0])
    assert row[column.L_KINETIC] == pytest.approx(2e-3)
