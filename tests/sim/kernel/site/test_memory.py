"""What a contact site remembers, as it lies in the state."""

import numpy as np
import pytest


def test_what_is_remembered_is_recalled(interpreted):
    memory, places = interpreted.memory, interpreted.memory_map
    state = np.full(places.SITE, np.nan)
    new = memory.Memory(dry=0.1, turn=0.2, axial=0.3, phi=0.4, past=0.5)
    memory.remember(state, new, 0.6)
    assert memory.recall(state) == new
    assert state[places.SLIP] == pytest.approx(0.6)
