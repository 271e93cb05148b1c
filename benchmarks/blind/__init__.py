"""A second rig, and a maker of rig logs whose answers are kept apart.

It scores a diagnosis on data whose effect is withheld. To be a fair judge it shares no code with
`sim` or `diagnosis`: its shaft is a chain of finite volumes, marched with BDF2.
"""
