"""The rig and its trials."""

from html_outline import HtmlOutline

from diagnosis.report.sections.rig import rig_section


def test_every_constant_of_the_rig_is_there(dry):
    said = "".join(rig_section(dry.found))
    for name, value in {
        "needle.diameter_mm": "0.59",
        "tissue.damping_n_mm_s_per_mm": "0.0172",
        "sensors.tip_angle_noise_deg": "0.25",
        "inertia.tip_kg_m2": "0",
    }.items():
        assert f'<th scope="row">{name}</th><td>{value}</td>' in said


def test_every_trial_is_a_row_with_its_lengths_and_what_it_measured(dry):
    trials = rig_section(dry.found)[-1]
    assert len(HtmlOutline(trials).attributes("tr")) == 1 + len(dry.log.trials)
    assert (
        '<th scope="row">trial_03.csv</th><td>5.0</td><td>500</td><td>100</td><td>50 to 62.48</td>'
        "<td>-2.5</td><td>base_torque_n_mm, tip_angle_deg</td>"
    ) in trials
