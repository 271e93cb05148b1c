"""What sensors of a lab do beside noise: a clock that runs off, a filter.

Each is fitted like an effect where a log asks for it, and told in the report, but a verdict never names
it: it says nothing about needle, tissue or drive. Bounds end where a sensor is broken rather than rough.
"""
