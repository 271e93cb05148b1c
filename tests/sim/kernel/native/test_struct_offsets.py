"""Offsets of MuJoCo's structs agree with its bindings, and wrong ones are noticed."""

from dataclasses import replace

import pytest

from models.errors import EnvironmentMismatch
from sim.kernel.native import struct_offsets


def test_offsets_of_mujocos_structs_agree_with_the_bindings():
    offsets = struct_offsets.read_struct_offsets()  # raises where they do not
    assert offsets.data["qpos"] != offsets.data["qvel"]


@pytest.mark.parametrize("pair", [("qpos", "qvel"), ("ctrl", "userdata")])
def test_exchanged_offsets_are_refused_by_the_name_of_the_field(pair):
    good = struct_offsets.read_struct_offsets()
    first, second = pair
    wrong = good.data | {first: good.data[second], second: good.data[first]}
    with pytest.raises(EnvironmentMismatch, match=rf"'{first}'.*constraints\.txt"):
        struct_offsets._check(replace(good, data=wrong))
