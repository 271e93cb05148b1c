"""Rows of results."""

import numpy as np
import pytest

from sim.experiment import perform
from studies.campaign.campaign import Campaign, read_campaign
from studies.campaign.cases import cases_of
from studies.campaign.run_case import rows_of
from studies.control.closed_loop_run import perform_closed_loop
from tests.diagnosis_fixtures import ROOT  # noqa: F401
