"""Where MuJoCo keeps the fields that a compiled callback reads and writes.

A C callback receives `const mjModel*` and `mjData*`. Their byte offsets are
computed from the struct declarations that ship with MuJoCo
(`mujoco.introspect`) under the C alignment rule, and are then checked once
against the addresses that the Python bindings report for the same fields.
"""

import ctypes
from dataclasses import dataclass
from typing import Any

import mujoco
from mujoco.introspect import ast_nodes, structs

from models.errors import EnvironmentMismatch

_SCALARS = {
    "int": ctypes.c_int,
    "char": ctypes.c_char,
    "unsigned char": ctypes.c_ubyte,
    "float": ctypes.c_float,
    "double": ctypes.c_double,
    "size_t": ctypes.c_size_t,
    "uintptr_t": ctypes.c_size_t,
    "uint64_t": ctypes.c_uint64,
    "unsigned int": ctypes.c_uint,
    "mjtNum": ctypes.c_double,
    "mjtSize": ctypes.c_int64,
    "mjtByte": ctypes.c_ubyte,
    "mjtBool": ctypes.c_bool,
}

# Reflected on by the start-up check: pointers whose addresses Python also knows.
_MODEL_FIELDS = (
    "numeric_data",
    "numeric_adr",
    "body_inertia",
    "body_iquat",
    "body_subtreemass",
    "jnt_stiffness",
    "actuator_gear",
    "actuator_gainprm",
    "actuator_forcelimited",
    "actuator_forcerange",
    "sensor_adr",
)
_SIZES = ("nnumeric", "nnumericdata", "nv")
_DATA_FIELDS = ("qpos", "qvel", "ctrl", "userdata", "qfrc_passive", "sensordata")


@dataclass(frozen=True, kw_only=True)
class StructOffsets:
    """Byte offsets of struct fields, by name.

    Attributes:
      model: offsets in `mjModel`, including `timestep` of its options.
      data: offsets in `mjData`.
    """

    model: dict[str, int]
    data: dict[str, int]


def read_struct_offsets() -> StructOffsets:
    """Offsets for the installed MuJoCo, checked against the bindings.

    Raises:
      EnvironmentMismatch: the declarations do not describe the loaded library.
    """
    model_type, data_type = _struct("mjModel"), _struct("mjData")
    model = {name: _offset(model_type, name) for name in (*_MODEL_FIELDS, *_SIZES)}
    model["timestep"] = _offset(model_type, "opt") + _offset(_struct("mjOption"), "timestep")
    data = {name: _offset(data_type, name) for name in (*_DATA_FIELDS, "time")}
    offsets = StructOffsets(model=model, data=data)
    _check(offsets)
    return offsets


def _struct(name: str) -> type[ctypes.Structure]:
    declaration = structs.STRUCTS[name]
    return _fields_to_type(name, declaration.fields)


def _offset(struct: type[ctypes.Structure], name: str) -> int:
    return int(getattr(struct, name).offset)


def _fields_to_type(name: str, fields: Any) -> type[ctypes.Structure]:
    body = [(getattr(f, "name", "") or f"unnamed_{i}", _ctype(f.type)) for i, f in enumerate(fields)]
    return type(name, (ctypes.Structure,), {"_fields_": body})


def _ctype(node: Any) -> Any:
    if isinstance(node, ast_nodes.PointerType):
        return ctypes.c_void_p
    if isinstance(node, ast_nodes.ArrayType):
        inner = _ctype(node.inner_type)
        for extent in reversed(node.extents):
            inner = inner * extent
        return inner
    if isinstance(node, ast_nodes.AnonymousStructDecl):
        return _fields_to_type("anonymous", node.fields)
    if node.name in _SCALARS:
        return _SCALARS[node.name]
    if node.name in structs.STRUCTS:
        return _struct(node.name)
    return ctypes.c_int  # every remaining named type is a C enum


def _check(computed: StructOffsets) -> None:
    """Compare computed pointers with the ones that Python sees."""
    spec = mujoco.MjSpec()
    spec.option.timestep = 0.0123
    spec.nuserdata = 3
    spec.add_numeric(name="probe", data=[1.0, 2.0])
    body = spec.worldbody.add_body(mass=1, inertia=[1, 1, 1])
    joint = body.add_joint(name="probe", type=mujoco.mjtJoint.mjJNT_HINGE)
    spec.add_actuator(name="probe", target=joint.name, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    spec.add_sensor(name="probe", type=mujoco.mjtSensor.mjSENS_USER, dim=1)
    model = spec.compile()
    data = mujoco.MjData(model)
    data.time = 4.5
    for owner, offsets, names in (
        (model, computed.model, _MODEL_FIELDS),
        (data, computed.data, _DATA_FIELDS),
    ):
        for name in names:
            found = ctypes.c_size_t.from_address(owner._address + offsets[name]).value
            _expect(name, found, getattr(owner, name).ctypes.data)
    time = ctypes.c_double.from_address(data._address + computed.data["time"]).value
    step = ctypes.c_double.from_address(model._address + computed.model["timestep"]).value
    count = ctypes.c_int64.from_address(model._address + computed.model["nnumeric"]).value
    values = ctypes.c_int64.from_address(model._address + computed.model["nnumericdata"]).value
    dofs = ctypes.c_int64.from_address(model._address + computed.model["nv"]).value
    scalars: tuple[tuple[str, float, float], ...] = (
        ("time", time, 4.5),
        ("timestep", step, 0.0123),
        ("nnumeric", count, 1),
        ("nnumericdata", values, 2),
        ("nv", dofs, 1),
    )
    for name, value, expected in scalars:
        _expect(name, value, expected)


def _expect(name: str, found: float, expected: float) -> None:
    if found != expected:
        raise EnvironmentMismatch(
            f"MuJoCo {mujoco.__version__} keeps {name!r} elsewhere than its own declarations say "
            f"(found {found}, expected {expected}); install the version named in constraints.txt"
        )
