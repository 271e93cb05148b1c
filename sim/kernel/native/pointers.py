"""Addresses as pointers, for compiled code: `numbers(address)[i]` and the like."""

from typing import Any

from numba import types
from numba.extending import intrinsic


def _pointer_to(kind: Any) -> Any:
    """An intrinsic that reads an integer address as a pointer to `kind`."""

    @intrinsic
    def pointer(typingctx: Any, address: Any) -> Any:
        def codegen(context: Any, builder: Any, signature: Any, args: Any) -> Any:
            return builder.inttoptr(args[0], context.get_value_type(signature.return_type))

        return types.CPointer(kind)(types.intp), codegen

    return pointer


numbers = _pointer_to(types.float64)
addresses = _pointer_to(types.intp)
flags = _pointer_to(types.boolean)
