"""Twist of the tissue stays in place while the mesh moves through it.

`sim.kernel.advection` in the interpreter: the same source, nothing to compile.
"""

import numpy as np
import pytest

N = 12


@pytest.fixture
def sites(interpreted):
    """Places of the sites of even elements on 0 to 1 m, (2 N,)."""
    x = np.linspace(0, 1, N + 1)
    xi = (interpreted.mesh.XI_LEFT, interpreted.mesh.XI_RIGHT)
    return np.array([x[e] + f / N for e in range(N) for f in xi])


def advected(interpreted, twist, d, covered=slice(None), *, share=1.0, untwisted=False):
    loads = np.zeros((N, 4))
    loads[covered] = 1.0 / (4 * N)
    state = np.zeros((N, 2, interpreted.memory_map.SITE))
    phi = state[:, :, interpreted.memory_map.PHI]
    phi[:] = twist.reshape(N, 2)
    places, values = np.empty(2 * N + 1), np.empty(2 * N + 1)
    x = np.linspace(0, 1, N + 1)
    interpreted.advection.advect_tissue(d, share, x, loads, state, places, values, untwisted)
    return phi.ravel()


@pytest.mark.parametrize("d", [-0.013, 0.004])
def test_a_parabola_of_twist_is_shifted_exactly_inside(interpreted, sites, d):
    def twist(x):
        return 0.3 + 0.2 * x - 0.5 * x * x

    moved = advected(interpreted, twist(sites), d)
    inside = slice(2, -2)  # at an end the profile runs on straight
    assert moved[inside] == pytest.approx(twist(sites + d)[inside], abs=1e-13)


def test_without_motion_nothing_changes(interpreted, sites):
    # each site is on its own parabola, but for rounding
    assert advected(interpreted, np.sin(sites), 0.0) == pytest.approx(np.sin(sites), abs=1e-14)


def test_tissue_that_the_tip_enters_is_untwisted(interpreted, sites):
    """The needle goes in by more than an element: the last site now lies in fresh tissue."""
    moved = advected(interpreted, np.ones(2 * N), sites[-1] - sites[-2])
    assert moved[0] == pytest.approx(1.0)
    assert moved[-1] < 0.7


def test_in_part_that_part_of_the_twist_is_shifted(interpreted, sites):
    twist = np.sin(3 * sites)
    whole, half = (advected(interpreted, twist, 0.01, share=share) for share in (1.0, 0.5))
    np.testing.assert_allclose(half, 0.5 * (twist + whole), atol=1e-14)


@pytest.mark.parametrize("untwisted", [False, True])
def test_tissue_that_is_dragged_in_is_untwisted(interpreted, sites, untwisted):
    """The profile is level: only at the entry, from which it is shifted away, does it change."""
    moved = advected(interpreted, np.ones(2 * N), -(sites[1] - sites[0]), untwisted=untwisted)
    assert moved[-1] == pytest.approx(1.0)
    assert moved[0] == pytest.approx(0.0 if untwisted else 1.0)


def test_a_site_that_no_tissue_touches_forgets(interpreted):
    loads = np.ones((N, 4))
    loads[:3] = 0.0
    state = np.ones((N, 2, interpreted.memory_map.SITE))
    interpreted.advection.forget_uncovered(loads, state)
    assert np.all(state[:3] == 0.0)
    assert np.all(state[3:] == 1.0)
