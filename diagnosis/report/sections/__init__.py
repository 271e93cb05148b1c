"""The sections of `report.html`, one file each; `html_report` has their order."""
