"""Results as files: complete or not at all, one set at a time, never over the user's own files."""

from sim.files.claim import claiming as claiming
from sim.files.destination import Destination as Destination
from sim.files.journal import finish_interrupted as finish_interrupted
from sim.files.publish import ResultSet as ResultSet
from sim.files.publish import publishing as publishing
from sim.files.single import write_text as write_text
from sim.files.single import writing as writing
