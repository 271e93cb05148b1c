"""The published Tables II, IV and V as measurements of a rig (`needle diagnose --paper`).

Packages, each of which imports only those before it:

    experiments   the paper's experiments, its figures, and their replay on the MuJoCo needle
    fitting       mechanisms, hypotheses, and their fits to the figures
    selection     which hypotheses are fitted, and what the fits allow to be concluded
    report        `paper.html` and `paper.json`
"""
