"""The published figures recomputed: audited values, and how settling and integrals are taken."""

import math

import numpy as np
import pytest

from studies.crosscheck import paper


def test_the_audited_figures_are_reproduced():
    found = {c.item: c for c in paper.compare_all()}
    assert found["Table III, inertialess modal, mode 1"].ours == pytest.approx(-4.628, abs=1e-3)
    assert found["Table III, inertialess modal, mode 1"].ratio == pytest.approx(1 / 0.5806, rel=1e-3)
    assert found["k_t per mm"].ours == pytest.approx(5.16e-3, abs=1e-5)
    assert found["b at 200 mm, line through Table II"].ours == pytest.approx(3.4507, abs=1e-4)
    hard = found["Fig. 8, hard: within 3 deg"].ours
    assert hard == pytest.approx(5.07, abs=0.02)
    behind = "integral over 2 s, behind the base"
    assert found[f"Fig. 8, hard: {behind}"].ours == pytest.approx(106, abs=0.5)
    assert found[f"Fig. 8, soft: {behind}"].ours == pytest.approx(57, abs=1)
    assert math.isnan(found["Fig. 8, soft: within 3 deg"].ours)
    item = "Table IV, base only, 10 cm, 50 mm free"
    assert found[item].ours == pytest.approx(1.80, abs=0.01)


def test_lumped_columns_of_table_iii_keep_their_ratio_to_the_continuous_one():
    found = {c.item: c for c in paper.table_iii()}
    for masses in (64, 8):
        for k in range(1, 5):
            x = k * math.pi / (2 * masses)
            ratio = (
                found[f"Table III, lumped, {masses} masses, mode {k}"].ours
                / found[f"Table III, inertialess modal, mode {k}"].ours
            )
            assert ratio == pytest.approx((math.sin(x) / x) ** 2, rel=1e-5)


def test_settling_is_the_last_time_outside_the_band():
    time = [0.0, 1.0, 2.0, 3.0]
    assert paper.settling_s(np.array(time), np.array([9.0, 1.0, 5.0, 0.0])) == 3.0
    assert paper.settling_s(np.array(time), np.zeros(4)) == 0.0
    assert math.isnan(paper.settling_s(np.array(time), np.array([0.0, 0, 0, 9.0])))


def test_the_integral_is_signed_and_ends_after_two_seconds():
    time = np.linspace(0, 4, 4001)
    assert paper.integral_deg_s(time, np.full(4001, 3.0)) == pytest.approx(6.0)
    assert paper.integral_deg_s(time, np.where(time < 1, 3.0, -3.0)) == pytest.approx(0.0, abs=6e-3)
    assert paper.integral_deg_s(time + 7.0, np.full(4001, 3.0), over_s=0.5) == pytest.approx(1.5)
