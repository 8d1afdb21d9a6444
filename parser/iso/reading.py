"""A text of ISO read: its listing, its family, the rows that it moves, and all that is wrong with it."""

from parser.dialect.reader import BlockCounts, Choices, Reading, ReadText, Spelling
from parser.findings.codes import CODES_OF_ISO, Check
from parser.findings.errors import ProgramError
from parser.findings.findings import Finding, file_order
from parser.geometry.curves import Ints
from parser.iso.family import (
    ToldProfile,
    in_other_distance,
    mode_findings,
    profile_told,
    reread,
)
from parser.iso.listing.lexer import read_listing
from parser.iso.listing.listing import Listing
from parser.iso.marks import mill_code
from parser.iso.numbering import checked
from parser.iso.path.motion import Moved, moved
from parser.iso.planes import with_upper_contour
from parser.iso.trace import Trace
from parser.iso.word_checks import not_simulated
from parser.text.encoding import no_program


def read_iso(text: str, choices: Choices) -> ReadText:
    """What a text says. ProgramError (ISO100) where it holds no block, or those of a mill."""
    listing = read_listing(text)
    if not (len(listing.words.letter) or listing.assignments or listing.statements):
        raise ProgramError(no_program("no-block", language="ISO"))
    mill = mill_code(listing)
    if mill:
        raise ProgramError(mill, excerpt=text[slice(*listing.lines.bounds(mill.line))])
    family = profile_told(listing, choices)
    listing = checked(listing, family.profile)
    taken, path = _as_arcs_agree(listing, family, choices)
    path = with_upper_contour(listing, taken.profile, choices, path)
    besides = not_simulated(listing, taken.profile, lean_is_known=path.lean_is_known)
    reading = _reading(listing, taken, path)._replace(not_simulated=besides.besides)
    of_text = (*listing.findings, *mode_findings(taken, path), *besides.findings)
    findings = (*(_by_row(finding, path.first_row) for finding in of_text), *path.findings, *_without_motion(path))
    ordered = tuple(sorted(findings, key=file_order))
    decoder = Trace(listing, taken.profile, choices)
    return ReadText(listing.lines, reading, {}, path.toolpath, ordered, decoder=decoder)


def _without_motion(path: Moved) -> tuple[Finding, ...]:
    """ISO100 where no block moves the wire."""
    return () if len(path.toolpath) else (no_program("no-motion", language="ISO"),)


def _as_arcs_agree(listing: Listing, family: ToldProfile, choices: Choices) -> tuple[ToldProfile, Moved]:
    """The family with modes in which the radii of arcs agree, where these were assumed, and the path that it makes."""
    path = moved(listing, family.profile, choices)
    turned = in_other_distance(family) if path.agreement.is_neither else None
    if turned:
        other = moved(listing, turned.profile, choices)
        family, path = (turned, other) if other.agreement.is_sure else (family, path)
    taken = reread(family, path.agreement)
    return taken, path if taken.profile == family.profile else moved(listing, taken.profile, choices)


def _reading(listing: Listing, family: ToldProfile, path: Moved) -> Reading:
    n = len(path.toolpath)
    return Reading(
        dialect=family.profile.name,
        counts=BlockCounts(n + len({each.block for each in listing.unread}), n, n),
        damages=path.damages,
        spelling=Spelling(clockwise="G02", counter_clockwise="G03", end="M02", pause="M00", rapid="G00"),
        is_drawing=path.toolpath.compensation is not None,
        not_asked={Check.PRINTED_ENDS: "reason-no-prints", Check.HEADER: "reason-no-header"},
        remarks=listing.remarks,
        assumptions=(*family.assumptions, *path.assumptions),
        codes=CODES_OF_ISO,
        threadings=path.threadings,
    )


def _by_row(finding: Finding, first_row: Ints) -> Finding:
    """A finding at a block of the text as one at the row that the block makes when it first runs, if it makes one."""
    return finding._replace(block=int(first_row[finding.block - 1]) + 1 if finding.block else 0)
