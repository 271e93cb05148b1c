"""The paper's materials: what follows from its figures, and what it does not state."""

import numpy as np
import pytest

from models import published
from models.errors import UnknownName
from models.lag import lag_deg
from models.materials import (
    MATERIALS,
    slope_per_mm,
    tissue_named,
    tissue_stiffness_n_mm_per_rad_per_mm,
    tissue_time_constant_s,
)
from models.needle import NITINOL


def test_table_ii_gives_the_papers_damping_at_200_mm():
    law = tissue_named("viscous-plastisol").layers[0].interface
    stated = published.DAMPING_200_MM.value
    assert law.viscous_n_mm_s_per_mm * 200 == pytest.approx(stated, rel=1e-3)


def test_every_material_says_what_its_source_does_not_state():
    assert all(tissue.unknown for tissue in MATERIALS.values())


def test_the_slope_is_that_of_least_squares_through_the_origin():
    table = dict(published.STATIC_TORQUE_GELATIN_N_MM)
    depth, torque = 10 * np.array(list(table))[:, None], np.array(list(table.values()))
    slope, *_ = np.linalg.lstsq(depth, torque, rcond=None)
    assert slope_per_mm(table) == pytest.approx(slope[0])


def test_the_stiffness_of_the_tissue_rounds_to_the_printed_one():
    assert round(tissue_stiffness_n_mm_per_rad_per_mm(), 4) == published.TISSUE_SPRING.value
    assert tissue_time_constant_s() == pytest.approx(5.4 / 5.2)


def test_chicken_lags_by_what_figure_3_shows():
    level = tissue_named("chicken").layers[0].interface.shared_n_mm_per_mm
    lag = lag_deg(NITINOL, base_torque_n_mm=100 * level, free_mm=230, inserted_mm=100)
    assert lag == pytest.approx(published.CHICKEN_LAG.value)


def test_an_unknown_tissue_is_answered_with_the_known_ones():
    with pytest.raises(UnknownName, match="porcine-gelatin"):
        tissue_named("jelly")


def test_names_in_the_table_are_the_names_of_the_tissues():
    assert all(name == tissue.name for name, tissue in MATERIALS.items())
