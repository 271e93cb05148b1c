"""Campaign files in a folder of the test."""

import pytest
import yaml
from campaigns import content


@pytest.fixture
def campaign_file(tmp_path):
    """Writes a campaign file and returns its path."""

    def write(**changes):
        path = tmp_path / "campaign.yaml"
        path.write_text(yaml.safe_dump(content(**changes)))
        return path

    return write
