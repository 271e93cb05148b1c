"""Effects of the sensors of tip and torque that the diagnosis does not model."""

from dataclasses import replace

import numpy as np

from validation.rig.filters import followed_with_play, low_passed
from validation.rig.unmodelled.effect import IdealSignals, Parameters, UnmodelledEffect, once


def tip_sensor_lag(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The tip sensor is a first-order low pass: time_constant * d(shown)/dt = tip - shown."""
    shown = low_passed(signals.tip_deg, float(signals.time_s[1]), p["time_constant"])
    return replace(signals, tip_deg=shown)


def tip_sensor_cubic(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The tip sensor shows tip + cubic * (tip / 180 deg)^3."""
    return replace(signals, tip_deg=signals.tip_deg + p["cubic"] * (signals.tip_deg / 180) ** 3)


def tip_sensor_periodic(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The tip sensor errs with the orientation: tip + amplitude sin(cycles * tip + phase)."""
    error = np.sin(np.radians(p["cycles"] * signals.tip_deg + p["phase"]))
    return replace(signals, tip_deg=signals.tip_deg + p["amplitude"] * error)


def tip_sensor_play(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The tip sensor is coupled with a play of `width` deg, and starts in the middle of it."""
    return replace(signals, tip_deg=followed_with_play(signals.tip_deg, p["width"] / 2))


def tip_sensor_jump(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The tip sensor shifts once, by `angle`, at `share` of the time of trial `trial` (from 0)."""
    shift = p["angle"] * once(signals.time_s, signals.trial, p)
    return replace(signals, tip_deg=signals.tip_deg + shift)


def torque_drift(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The torque sensor drifts linearly in time, `rate` N mm / s, from zero in each trial."""
    return replace(signals, torque_n_mm=signals.torque_n_mm + p["rate"] * signals.time_s)


def one_sided_torque_gain(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The torque sensor's gain is 1 + share for positive torque, 1 for negative."""
    more = p["share"] * np.maximum(signals.torque_n_mm, 0.0)
    return replace(signals, torque_n_mm=signals.torque_n_mm + more)


def axial_crosstalk(signals: IdealSignals, p: Parameters) -> IdealSignals:
    """The torque sensor also feels the axial motion: torque + gain * speed."""
    return replace(signals, torque_n_mm=signals.torque_n_mm + p["gain"] * signals.speed_mm_s)


HERE = ("sensor",)
EFFECTS = {
    # What it lags by is time_constant * the rate that it shows.
    "tip_sensor_lag": UnmodelledEffect(
        place=HERE, variables=("history", "rate"), signals=tip_sensor_lag
    ),
    "tip_sensor_cubic": UnmodelledEffect(place=HERE, variables=("tip_angle",), signals=tip_sensor_cubic),
    "tip_sensor_periodic": UnmodelledEffect(
        place=HERE, variables=("tip_angle",), signals=tip_sensor_periodic
    ),
    "tip_sensor_play": UnmodelledEffect(
        place=HERE, variables=("history", "direction"), signals=tip_sensor_play
    ),
    "tip_sensor_jump": UnmodelledEffect(place=HERE, variables=("event",), signals=tip_sensor_jump),
    "torque_drift": UnmodelledEffect(place=HERE, variables=("time",), signals=torque_drift),
    "one_sided_torque_gain": UnmodelledEffect(
        place=HERE, variables=("torque",), signals=one_sided_torque_gain
    ),
    "axial_crosstalk": UnmodelledEffect(place=HERE, variables=("axial_speed",), signals=axial_crosstalk),
}
