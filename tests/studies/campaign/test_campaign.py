"""The campaign file."""

import pytest
import yaml

from models.errors import InvalidValue
from sim.paper_protocols import protocol_named
from studies.campaign.campaign import Campaign, Kind, read_campaign


def test_a_file_is_read_and_written_whole(campaign_file):
    campaign = read_campaign(campaign_file())
    assert campaign.kind is Kind.INSERTION
    assert Campaign(**yaml.safe_load(campaign.as_yaml())) == campaign
    assert campaign.as_yaml().splitlines()[0].endswith(campaign.fingerprint)


def test_the_example_is_a_campaign_on_a_protocol_by_name(campaign_file):
    assert read_campaign(campaign_file(base="fig5-10cm")).base == protocol_named("fig5-10cm")


def test_a_protocol_file_is_beside_the_campaign(campaign_file, tmp_path):
    protocol = protocol_named("fig5-10cm").model_dump(mode="json")
    (tmp_path / "own.yaml").write_text(yaml.safe_dump(protocol | {"name": "own"}))
    assert read_campaign(campaign_file(base="own.yaml")).base.name == "own"


def test_the_fingerprint_is_of_everything_but_the_number_of_samples(campaign_file):
    campaign = read_campaign(campaign_file())
    assert read_campaign(campaign_file(), samples=9).samples == 9
    assert campaign.but(samples=9).fingerprint == campaign.fingerprint
    for change in ({"seed": 8}, {"cases_per_piece": 3}, {"name": "other"}):
        assert campaign.but(**change).fingerprint != campaign.fingerprint


def test_logs_are_found_beside_the_campaign(campaign_file, tmp_path):
    for name in ("b", "a", "no-log"):
        (tmp_path / "logs" / name).mkdir(parents=True)
    for name in ("a", "b"):
        (tmp_path / "logs" / name / "rig.yaml").touch()
    path = campaign_file(kind="diagnosis", base=None, vary={}, samples=1, logs=["logs/*"], limit_s=5)
    expected = tuple(str(tmp_path.resolve() / "logs" / name) for name in ("a", "b"))
    assert read_campaign(path).logs == expected
    with pytest.raises(InvalidValue, match="logs"):
        read_campaign(campaign_file(kind="diagnosis", base=None, vary={}, samples=1, logs="none/*"))


@pytest.mark.parametrize(
    ("changes", "named"),
    [
        ({"kind": "insertoin"}, "Campaign.kind"),
        ({"bas": 1}, "did you mean 'base'"),
        ({"base": "fig5-11cm"}, "fig5-10cm"),
        ({"base": None}, "base"),
        ({"samples": 0}, "samples"),
        ({"seed": -1}, "seed"),
        ({"kind": "control"}, "controller"),
        ({"kind": "control", "controller": "magic"}, "least_time"),
        ({"controller": "lqr"}, "controller"),
        ({"limit_s": 3}, "limit_s"),
        ({"kind": "diagnosis"}, "base"),
        ({"vary": {"free_mm": {"grid": [1.0]}}, "samples": 2}, "nothing is drawn"),
        ({"vary": {"free_mm": {"gird": [1.0]}}}, "did you mean 'grid'"),
    ],
)
def test_misuse_names_the_field(campaign_file, changes, named):
    with pytest.raises(InvalidValue, match=named):
        read_campaign(campaign_file(**changes))


@pytest.mark.parametrize("text", ["- 1", "{", "a: b: c"])
def test_what_is_no_mapping_is_refused_by_its_path(tmp_path, text):
    path = tmp_path / "campaign.yaml"
    path.write_text(text)
    with pytest.raises(InvalidValue, match=r"campaign\.yaml"):
        read_campaign(path)
