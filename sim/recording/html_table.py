"""Results as a notebook shows them: a line and a table, in which all text is escaped."""

from html import escape

import pandas as pd


def html_table(title: str, table: pd.DataFrame) -> str:
    """HTML of a table below a title; numbers with four digits, empty cells for NaN and None."""
    shown = table.to_html(border=0, na_rep="", float_format="{:.4g}".format, escape=True)
    return f"<p>{escape(title)}</p>{shown}"
