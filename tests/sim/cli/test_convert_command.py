"""``drycut convert`` as a user meets it: files, exit codes, messages in both languages, bad use."""

import re
from pathlib import Path

import pytest
from command import run_inside
from places import ROOT
from twins import BLOCKS_3B, TWIN_3B, TWIN_ISO, motion

from sim.show.texts.texts import texts

OPEN = "B9000B0B9000GXL1\nB0B9000B9000GYL2\nB9000B0B9000GXL3\nB0B8000B8000GYL4\nDD\n"
HOLE = (
    "%\nN10 G92 X0 Y0\nN20 G60 G38 G41 D0\nN30 G01 X5. Y0.\nN40 G03 X5. Y0. I0. J0.\nN50 G40 G01 X0. Y0.\nN60 M02\n%\n"
)


@pytest.fixture
def iso(tmp_path: Path) -> Path:
    path = tmp_path / "part.iso"
    path.write_text(TWIN_ISO, encoding="utf-8")
    return path


def run(*arguments: object) -> tuple[int, str, str]:
    done = run_inside("convert", *arguments)
    return done.returncode, done.stdout.decode(), done.stderr.decode()


def test_the_suffix_says_the_language(iso: Path) -> None:
    out = iso.with_suffix(".3b")
    code, said, _ = run(iso, "-o", out)
    assert code == 0
    assert "written: 9 lines, 3 arcs" in " ".join(said.split())  # folders have long names
    assert "at most 0.575 µm off" in said
    assert motion(out.read_text(encoding="utf-8")) == motion(BLOCKS_3B)


def test_it_comes_back_in_another_dialect(iso: Path) -> None:
    out = iso.with_suffix(".3b")
    out.write_text(TWIN_3B, encoding="utf-8")
    back = iso.with_suffix(".nc")
    assert run(out, "-o", back, "--dialect", "robofil", "--number-step", "5", "--crlf")[0] == 0
    assert back.read_bytes().startswith(b"%\r\n(robofil, mm, absolute, centres absolute)\r\nN5 G60 G90 G92 X115.000 ")


def test_to_goes_before_the_suffix(iso: Path) -> None:
    out = iso.with_suffix(".txt")
    assert run(iso, "-o", out, "--to", "4b")[0] == 0
    assert "GYDNR1" in out.read_text(encoding="utf-8")


def test_a_register_is_told_and_worked_in(tmp_path: Path) -> None:
    path, out = tmp_path / "hole.iso", tmp_path / "hole.3b"
    path.write_text(HOLE, encoding="utf-8")
    code, said, _ = run(path, "-o", out)
    assert (code, out.exists()) == (1, False)
    assert "ISO500" in said
    assert run(path, "-o", out, "--offset", "D0=0.1mm")[0] == 0
    assert "B4900B0B19600GYNR1" in out.read_text(encoding="utf-8")


def test_values_that_stay_in_the_table_are_told_as_options(tmp_path: Path) -> None:
    path, out = tmp_path / "hole.iso", tmp_path / "again.iso"
    path.write_text(HOLE, encoding="utf-8")
    code, said, _ = run(path, "-o", out, "--offset", "D0=0.1mm", "--dialect", "fanuc")
    assert code == 0
    assert "check it with --offset D1=0.1mm" in " ".join(said.split())
    assert run_inside("check", out, "--offset", "D1=0.1mm").returncode == 0


def test_an_offset_is_worked_into_3b(tmp_path: Path) -> None:
    path, out = tmp_path / "hole.3b", tmp_path / "cut.3b"
    path.write_text("B5000B0B5000GXL1\nB5000B0B20000GYNR1\nB5000B0B5000GXL3\nDD\n", encoding="utf-8")
    assert run(path, "-o", out, "--offset", "0.1mm", "--side", "left", "--form", "detailed")[0] == 0
    text = out.read_text(encoding="utf-8")
    assert "Offset F= 0.10000 ," in text
    assert motion(text)[1].replace(" ", "") == "B4900B0B19600GYNR1"


def test_nothing_is_written_where_it_is_refused(tmp_path: Path) -> None:
    path, out = tmp_path / "damaged.3b", tmp_path / "damaged.iso"
    path.write_text(OPEN.replace("B9000", "B9O00", 1), encoding="utf-8")
    out.write_text("as it was", encoding="utf-8")
    code, said, _ = run(path, "-o", out)
    assert code == 1
    assert out.read_text(encoding="utf-8") == "as it was"
    assert "3B106" in said
    assert "not converted: mend its errors first" in " ".join(said.split())


@pytest.mark.parametrize("lang", ["en", "zh"])
def test_messages_are_in_both_languages_and_fit_the_terminal(iso: Path, lang: str) -> None:
    _, said, _ = run(iso, "-o", iso.with_suffix(".3b"), "--lang", lang)
    assert ("已回读并检查" in said) is (lang == "zh")
    name = str(iso.with_suffix(".3b"))
    assert all(len(line) <= 100 for line in said.splitlines() if name not in line)


@pytest.mark.parametrize(
    ("options", "told"),
    [
        (("-o", "part.foo"), "--to"),
        (("-o", "part.3b", "--tape"), "--tape is for ISO"),
        (("-o", "b.iso", "--form", "detailed"), "--form is for 3B and 4B"),
        (("-o", "part.3b", "--compensation", "kept"), "3B carries none"),
        (("-o", "b.iso", "--dialect", "klingon"), "klingon"),
        (("-o", "b.iso", "--dialect", "classroom", "--unit", "um"), "classroom"),
        (("-o", "part.3b", "--side", "left"), "belong together"),
        (("-o", "part.iso"), "is the program itself"),
    ],
)
def test_bad_use_ends_with_2_and_one_line(iso: Path, options: tuple[str, ...], told: str) -> None:
    named = [str(iso.parent / one) if one.endswith((".3b", ".iso", ".foo")) else one for one in options]
    code, said, error = run(iso, *named)
    assert code == 2
    assert said == ""
    assert told in error
    assert iso.read_text(encoding="utf-8") == TWIN_ISO


def test_a_file_that_is_no_program_is_bad_use(tmp_path: Path) -> None:
    path = tmp_path / "letter.iso"
    path.write_text("Dear customer\n", encoding="utf-8")
    code, _, error = run(path, "-o", tmp_path / "letter.3b")
    assert code == 2
    assert "letter.iso" in error


def test_every_loss_and_refusal_has_its_words() -> None:
    code = "".join(
        path.read_text(encoding="utf-8")
        for folder in ("sim/make", "parser/write")
        for path in sorted((ROOT / folder).glob("*.py"))
    )
    named = {f"lost-{name}" for name in re.findall(r'(?:Loss|_named|_of)\(\s*"([a-z-]+)"', code)}
    named |= {f"lost-{name}" for name in re.findall(r'"(offsets-[a-z-]+)"', code)}
    named |= {f"refused-{name}" for name in re.findall(r'Refused\(\s*"([a-z-]+)"', code)}
    differs = re.search(r"def _differs.*?^def ", code, re.DOTALL | re.MULTILINE)
    assert differs is not None
    named |= {"differs-turns"} | {f"differs-{name}" for name in re.findall(r'"([a-z]+)"', differs[0])}
    assert len(named) > 20
    assert named == {name for name in texts("convert") if name.startswith(("lost-", "refused-", "differs-"))}


@pytest.mark.parametrize(("lang", "told"), [("en", "readas:dialect"), ("zh", "按以下约定读入：系统")])
def test_what_was_assumed_to_read_it_is_said(iso: Path, lang: str, told: str) -> None:
    code, out, _ = run(iso, "-o", iso.with_suffix(".3b"), "--lang", lang)
    assert code == 0
    assert told in "".join(out.split())
    code, out, _ = run(iso.with_suffix(".3b"), "-o", iso.with_name("again.iso"), "--lang", lang)
    assert code == 0
    assert told not in "".join(out.split())


LOWER = "B0B5000B5000GYL2\nB9000B0B9000GXL1\nB0B8000B8000GYL2\nB9000B8000B9000GXL3\nB0B5000B5000GYL4\nDD\n"
UPPER = "B0B6000B6000GYL2\nB7000B0B7000GXL1\nB0B6000B6000GYL2\nB7000B6000B7000GXL3\nB0B6000B6000GYL4\nDD\n"


def test_two_files_become_one_and_two_again(tmp_path: Path) -> None:
    (tmp_path / "low.3b").write_text(LOWER, "ascii")
    (tmp_path / "high.3b").write_text(UPPER, "ascii")
    one = tmp_path / "part.iso"
    code, said, _ = run(tmp_path / "low.3b", "--upper", tmp_path / "high.3b", "-o", one)
    assert code == 0, said
    assert one.read_text("ascii").count(" : ") == 5
    code, said, _ = run(one, "--dialect", "fast-wire", "-o", tmp_path / "back.3b")
    assert code == 0, said
    assert "back-upper.3b;runbothwith--upper" in "".join(said.split())  # folders have long names
    for written, text in (("back.3b", LOWER), ("back-upper.3b", UPPER)):
        assert motion((tmp_path / written).read_text("ascii")) == motion(text)


def test_the_upper_file_never_takes_the_place_of_a_source(tmp_path: Path) -> None:
    (tmp_path / "part.3b").write_text(LOWER, "ascii")
    (tmp_path / "part-upper.3b").write_text(UPPER, "ascii")
    sources = (tmp_path / "part.3b", "--upper", tmp_path / "part-upper.3b")
    code, _, told = run(*sources, "-o", tmp_path / "part.3b")
    assert (code, "is the program itself" in " ".join(told.split())) == (2, True)
    (tmp_path / "in.3b").write_text(LOWER, "ascii")
    code, _, told = run(tmp_path / "in.3b", *sources[1:], "-o", tmp_path / "part.3b")
    assert (code, (tmp_path / "part-upper.3b").read_text("ascii")) == (2, UPPER)
