"""Which findings forbid a made program: warnings too, but none that a comparison with the drawing knows better."""

from types import MappingProxyType
from typing import Any, cast

from parser.findings.findings import Finding, TightCorner
from sim.make.cam.proof_model import Proof
from sim.measure.compare.result import Comparison
from sim.setup.wire import DEFAULT_WIRE

TIGHT = Finding("3B305", MappingProxyType({"radius": 92.0, "offset": 100.0}), fact=TightCorner())
EARLY = Finding("3B406")


def proof(comparison: Any, *findings: Finding) -> Proof:
    return Proof(None, 0.0, None, cast("Comparison | None", comparison), findings, (), (), (), DEFAULT_WIRE)


def test_a_tight_corner_forbids_no_program_whose_edge_was_held_against_its_drawing() -> None:
    assert proof(object(), TIGHT).verdict == "pass"
    assert proof(object(), TIGHT, EARLY).counting == (EARLY,)
    assert proof(None, TIGHT).verdict == "fail"
