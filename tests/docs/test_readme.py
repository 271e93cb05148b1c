"""The Python of the README runs as written."""

from pathlib import Path

import numpy as np

README = (Path(__file__).parents[2] / "README.md").read_text()


def test_the_python_of_the_readme_gives_the_lag_of_the_tip():
    """With fewer elements than written, which changes the cost alone."""
    code = README.split("```python\n")[1].split("```")[0]
    assert code.count('"elements": 32') == 1
    names = {}
    exec(code.replace('"elements": 32', '"elements": 4'), names)
    lag = names["lag"]
    # The tip follows a fast turn of 90 deg late, and has caught up when the run ends.
    assert np.max(lag) > 1.0
    assert abs(lag[-1]) < 0.1 * np.max(lag)
