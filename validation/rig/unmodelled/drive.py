"""Effects of the drive that the diagnosis does not model: of chuck, transmission and encoder."""

import math
from dataclasses import replace

import numpy as np

from validation.rig.laws.parameters import LawParameters
from validation.rig.motion import TrialMotion
from validation.rig.unmodelled.effect import Array, IdealSignals, Parameters, UnmodelledEffect, once


def slipping_chuck(law: LawParameters, p: Parameters) -> LawParameters:
    """The chuck slips where its torque would exceed `torque`, and keeps it."""
    return law._replace(grip=p["torque"])


def soft_play(law: LawParameters, p: Parameters) -> LawParameters:
    """Lost motion that a soft insert takes up: angle T / (torque + |T|) at the chuck's torque T."""
    return law._replace(soft_play=math.radians(p["angle"]), soft_torque=p["torque"])


def chuck_jump(motion: TrialMotion, p: Parameters) -> Array:
    """The chuck slips once, by `angle`, at `share` of the time of trial number `trial` (from 0)."""
    return np.asarray(motion.base_deg - p["angle"] * once(motion.time_s, motion.trial, p))


def drive_creep(motion: TrialMotion, p: Parameters) -> Array:
    """A belt creeps: the chuck lags behind the encoder by `rate` deg / s, from zero in each trial."""
    return np.asarray(motion.base_deg - p["rate"] * motion.time_s)


def eccentric_encoder(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The shown base angle errs once per turn: base + amplitude (sin(base + phase) - sin(phase))."""
    error = np.sin(np.radians(signals.base_deg + p["phase"])) - np.sin(np.radians(p["phase"]))
    return replace(signals, base_deg=signals.base_deg + p["amplitude"] * error)


def torque_ripple(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """Cogging of the drive: amplitude sin(teeth * base angle + phase) on the torque."""
    ripple = np.sin(np.radians(p["teeth"] * signals.base_deg + p["phase"]))
    return replace(signals, torque_n_mm=signals.torque_n_mm + p["amplitude"] * ripple)


HERE = ("drive",)
# Between what the encoder reads and what the chuck does, no log tells who errs; nor does a torque sensor
# that errs with the angle differ from a bearing before it.
OR_ITS_SENSOR = ("drive", "sensor")
EFFECTS = {
    "slipping_chuck": UnmodelledEffect(place=HERE, variables=("torque", "event"), law=slipping_chuck),
    "soft_play": UnmodelledEffect(place=HERE, variables=("torque",), law=soft_play),
    "chuck_jump": UnmodelledEffect(place=HERE, variables=("event",), drive=chuck_jump),
    "drive_creep": UnmodelledEffect(place=OR_ITS_SENSOR, variables=("time",), drive=drive_creep),
    "eccentric_encoder": UnmodelledEffect(
        place=OR_ITS_SENSOR, variables=("base_angle",), signals=eccentric_encoder
    ),
    "torque_ripple": UnmodelledEffect(
        place=OR_ITS_SENSOR, variables=("base_angle",), signals=torque_ripple
    ),
}
