"""What is wrong with the words of a listing as text, once the family is known that it was written for."""

from parser.findings.findings import file_order
from parser.iso.listing.listing import Listing, Unread
from parser.iso.profiles.profile import Profile
from parser.iso.words.commands import unknown_letters, without_command
from parser.iso.words.numbering import numbering_findings
from parser.iso.words.word_checks import word_findings
from parser.iso.words.word_order import order_findings


def checked(listing: Listing, profile: Profile) -> Listing:
    """The listing with the findings of its text, and with the blocks damaged whose motion is not known by them."""
    letters, unknown = unknown_letters(listing, profile.letters)
    found = [
        *(*listing.findings, *letters, *without_command(listing), *numbering_findings(listing)),
        *order_findings(listing, strict=profile.strict_order),
        *word_findings(listing, profile),
    ]
    is_damaged = listing.blocks.is_damaged.copy()
    is_damaged[unknown] = True
    spans = zip(listing.blocks.first[unknown].tolist(), listing.blocks.past[unknown].tolist(), strict=True)
    unread = [Unread(span, block) for span, block in zip(spans, unknown.tolist(), strict=True)]
    return listing._replace(
        blocks=listing.blocks._replace(is_damaged=is_damaged),
        unread=tuple(sorted([*listing.unread, *unread])),
        findings=tuple(sorted(found, key=file_order)),
    )
