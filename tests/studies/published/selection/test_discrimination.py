"""Which experiment separates hypotheses."""

import numpy as np
import pytest
from reference_fits import fit_with

from studies.published.experiments.measurement import Quantity
from studies.published.selection.discrimination import PROPOSED, proposed_experiments


def test_an_experiment_separates_pairs_that_differ_by_more_than_three_standard_deviations():
    def replay(measurements, rigs):
        # Only the held torque differs, by 0, 2.9 and 6 standard deviations.
        rows = np.zeros((len(PROPOSED), 3))
        rows[0] = PROPOSED[0].sigma * np.array([0.0, 2.9, 6.0])
        return rows

    first, *others = proposed_experiments([fit_with((n,), 1.0) for n in "abc"], replay)
    assert first.measurement.quantity is Quantity.HELD_TORQUE
    # 0 to 6 and 2.9 to 6, not 0 to 2.9.
    assert first.separated == pytest.approx(2 / 3)
    assert all(p.separated == 0.0 for p in others)


def test_a_right_and_a_wrong_hypothesis_are_separated_and_one_is_not_from_itself(recovery):
    right, wrong = recovery.right, recovery.wrong
    assert proposed_experiments([right, wrong], recovery.replay)[0].separated == 1.0
    assert all(p.separated == 0.0 for p in proposed_experiments([right, right], recovery.replay))


def test_without_explanations_nothing_is_separated():
    found = proposed_experiments([], lambda measurements, rigs: np.zeros((len(PROPOSED), 0)))
    assert [p.separated for p in found] == [0.0] * len(PROPOSED)
