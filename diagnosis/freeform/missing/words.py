"""Words for places and variables, and what shows a law of each by itself."""

from diagnosis.effects.effect import Place

PLACES = {
    Place.INTERFACE: "between shaft and tissue",
    Place.TISSUE: "in the tissue",
    Place.DRIVE: "at the drive",
    Place.NEEDLE: "in the needle or at its tip",
    Place.SENSOR: "in a sensor",
    Place.PARAMETERS: "in the constants of the rig",
}
VARIABLES = {
    "time": "the time",
    "event": "an event",
    "base_angle": "the angle of the base",
    "tip_angle": "the angle of the tip",
    "rate": "the rate of turning",
    "direction": "the direction of turning",
    "axial_speed": "the axial speed",
    "depth": "the inserted length",
    "torque": "the torque",
    "position": "the place along the shaft",
    "history": "what happened before",
}
_CHECKS = {
    "time": "repeat one slow turn at the beginning of a trial, at its end, and in the last trial",
    "event": "look up what was done at that time, and repeat the trial: what the motion causes comes "
    "again, what was done to the rig stays",
    "base_angle": "turn slowly through whole turns with the needle out of the tissue: what comes from "
    "the drive remains",
    "tip_angle": "turn slowly through two whole turns at one depth, forwards and backwards: what "
    "depends on the angle of the tip comes again after each turn",
    "rate": "turn at four steady rates, a few turns each, at one depth",
    "direction": "turn at one steady rate, a few turns forwards, then as many backwards",
    "axial_speed": "slide the needle in and out at three speeds without turning it",
    "depth": "repeat one turn at four depths",
    "torque": "load the needle by known torques at rest, and read angle and torque",
    "position": "repeat one turn at depths that grow in equal steps: each step adds a part of the shaft",
    "history": "repeat one turn after rests of different length, and after different numbers of turns",
}
_OF_SENSOR = {
    "tip_angle": "turn the tip in known steps, by hand or against a second sensor, and compare",
    "time": "read the sensor at rest, without a load, before and after each trial",
    "history": "read the sensor at rest, without a load, before and after each trial, and after turns "
    "both ways",
}
_LENGTHS = "measure how much of the shaft is free and inserted, at both ends of the travel, by a ruler"
_WHILE_TURNING = "turn at one steady rate while sliding the needle in and out at three speeds"
"""Of the axial speed, for what acts about the axis: without turning, sensors alone show it."""


_CLOCKS = "compare the clocks and sampling rates of all instruments, over minutes"


def check_of(place: Place, variable: str, *, of_a_clock: bool = False) -> str:
    """What shows a law of a variable by itself, as an order.

    Args:
      of_a_clock: whether what is off is a time.
    """
    if of_a_clock:
        return _CLOCKS
    if place is Place.SENSOR:
        return _OF_SENSOR.get(variable, _CHECKS[variable])
    if place is Place.PARAMETERS and variable == "depth":
        return _LENGTHS
    return _WHILE_TURNING if variable == "axial_speed" else _CHECKS[variable]
