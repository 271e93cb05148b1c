"""The record of what is reported in addition to a verdict."""

import re
from dataclasses import fields

from diagnosis.assessment.assessment import Assessment


def test_the_docstring_says_what_each_field_is():
    told = {
        name
        for line in re.findall(r"^ {6}(\w[\w, ]*):", Assessment.__doc__, re.M)
        for name in line.split(", ")
    }
    assert {f.name for f in fields(Assessment)} - {"warnings"} == told
