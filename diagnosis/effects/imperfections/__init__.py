"""Imperfections of a lab's sensors other than noise: a clock that drifts, a low-pass filter.

Each is fitted like an effect if a log needs it, and reported, but a verdict never names it, since it
says nothing about needle, tissue or drive. Beyond the bounds a sensor would be broken.
"""
