"""`needle control` runs independent parts, over processes, and keeps every result in order."""

from concurrent.futures import ThreadPoolExecutor
from functools import partial

import pytest

from studies.control import study
from studies.control.robustness import plants


def test_parts_come_back_in_order_with_a_pool_and_without():
    stages = {"one": [partial(pow, 2, n) for n in range(5)], "two": [partial(abs, -3)]}
    expected = {"one": [1, 2, 4, 8, 16], "two": [3]}
    announced = []
    with ThreadPoolExecutor(2) as pool:
        assert study.collected(stages, pool, lambda stage, _: announced.append(stage)) == expected
    assert study.collected(stages, None, lambda stage, _: announced.append(stage)) == expected
    assert announced == [*["one"] * 5, "two"] * 2


def test_the_share_that_is_told_rises_from_0_through_all_stages():
    stages = {name: [int, int] for name in study.stage_parts()}
    shares = []
    study.collected(stages, None, lambda _, share: shares.append(share))
    assert shares[0] == 0.0
    assert shares == sorted(set(shares))
    assert shares[-1] < 1.0


def test_what_a_part_raises_reaches_the_caller():
    with pytest.raises(ZeroDivisionError):
        study.collected({"one": [partial(divmod, 1, 0)]}, None, lambda *_: None)


def test_every_rig_is_a_part_and_all_stages_become_the_study(monkeypatch):
    """The parts themselves have tests of their own."""
    assert len(study.stage_parts()["robustness"]) > len(plants())
    steering = {f"steering {i}": [partial(str, i)] for i in range(5)}
    monkeypatch.setattr(
        study,
        "stage_parts",
        lambda: {
            "tables": [partial(list, "iv")],
            "robust": [partial(list, "a"), partial(list, "b")],
            **steering,
        },
    )
    monkeypatch.setattr(study.SteeringStudy, "of_parts", lambda *parts: parts)
    made = study.run_study(workers=1)
    assert (made.tables, made.robustness) == (["i", "v"], ["a", "b"])
    assert made.steering == tuple([str(i)] for i in range(5))
