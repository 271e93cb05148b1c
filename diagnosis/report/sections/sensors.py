"""The sensors: their noise, what they do beside it, and the numerical error of the replay."""

from diagnosis.report import html_parts as html
from diagnosis.report.sensors import imperfections
from diagnosis.report.sentences.residual import replay_quality
from diagnosis.result import Diagnosis


def sensors_section(found: Diagnosis) -> list[str]:
    """Everything under this heading."""
    beside = imperfections(found) or _nothing_beside_noise(found)
    return [
        html.heading("Sensors and numerical error"),
        html.paragraph(f"{beside}."),
        html.bullets(replay_quality(found)),
    ]


def _nothing_beside_noise(found: Diagnosis) -> str:
    if found.noise.notes:
        return "No fault of the sensors but their noise had to be allowed for; of that the warnings tell"
    return "The sensors show noise alone; no other fault had to be allowed for"
