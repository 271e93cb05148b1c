"""Campaign files in a folder of the test."""

import pytest
import yaml
from campaigns import content, posterior


@pytest.fixture
def campaign_file(tmp_path):
    """Writes a campaign file and returns its path."""

    def write(**changes):
        path = tmp_path / "campaign.yaml"
        path.write_text(yaml.safe_dump(content(**changes)))
        return path

    return write


@pytest.fixture
def posterior_file(campaign_file):
    """Writes a campaign over a posterior, of four rigs, and returns its path."""

    def write(**changes):
        many = {"kind": "posterior", "posterior": posterior(), "vary": {}, "samples": 4}
        return campaign_file(**many | changes)

    return write
