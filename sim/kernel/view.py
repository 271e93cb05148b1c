"""Parts of one piece of memory as arrays.

A slice checks and clips its ends, and `reshape` calls a function of its own: at every step that costs
as much as the arithmetic. Here the ends are known to lie within.
"""

from typing import Any

import numba
import numpy as np
from numba import types
from numba.core import cgutils
from numba.extending import intrinsic
from numba.np.arrayobj import make_array, populate_array

from sim.kernel.compiled import Array


@intrinsic
def _compiled_view(typingctx: Any, memory: Any, start: Any, shape: Any) -> Any:
    kind = types.Array(memory.dtype, len(shape), "C")

    def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
        whole = make_array(signature.args[0])(context, builder, args[0])
        extents = cgutils.unpack_tuple(builder, args[2])
        width = context.get_constant(types.intp, memory.dtype.bitwidth // 8)
        strides = [width]
        for extent in reversed(extents[1:]):
            strides.insert(0, builder.mul(strides[0], extent))
        part = make_array(kind)(context, builder)
        data = builder.gep(whole.data, [args[1]])
        populate_array(part, data=data, shape=extents, strides=strides, itemsize=width, meminfo=None)
        return part._getvalue()

    return kind(memory, start, shape), codegen


def _interpreted_view(memory: Array, start: int, shape: tuple[int, ...]) -> Array:
    return memory[start : start + int(np.prod(shape))].reshape(shape)


_interpreted = bool(getattr(numba.config, "DISABLE_JIT", False))
view: Any = _interpreted_view if _interpreted else _compiled_view
"""view(memory, start, shape): values of a flat array from `start` on, as a contiguous array."""
