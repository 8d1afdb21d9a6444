"""The page of a shop of made-up programs."""

from parser.findings.catalogue import Bilingual
from parser.findings.codes import Severity
from parser.findings.findings import Count
from sim.jobs.index import Entry, Row, build_index
from sim.show.index_page import BesideTheIndex, index_page
from sim.show.texts.phrases import same

THIN = Count("3B405", Severity.WARNING, 1)
SQUARE = "M20,20l50,0 0,40 -50,0 0,-40"


def entry(number: int) -> Entry:
    """Programs in turn: two that pass, one that fails, one that cannot be run."""
    file = f"shop/{number // 100:02}/part-{number:04}.3b"
    if number % 4 == 3:
        message = Bilingual(f"no block in part {number}", f"第 {number} 个文件没有程序段")
        found = (Count("3B100", Severity.ERROR, 1),)
        return Entry(file, None, Row("refused", same(f"part-{number:04}.3b"), message, found), from_cache=False)
    row = Row(
        "pass",
        Bilingual(f"Part {number}", f"零件 {number}"),
        time_s=60.0 + number,
        max_um=number % 7 + 0.5,
        picture=SQUARE,
    )
    if number % 4 == 2:
        row = row._replace(
            verdict="fail", drawing_um=87.25, findings=(Count("3B301", Severity.ERROR, number + 1), THIN)
        )
    return Entry(file, f"{number // 100:02}/part #{number}%.3b", row, from_cache=number % 2 == 0)


def shop_page(count: int) -> str:
    entries = [entry(number) for number in range(count)]
    return index_page(build_index(entries), [BesideTheIndex(one.row.picture, one.row.message) for one in entries])
