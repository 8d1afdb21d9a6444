"""What all pages share: nothing that a program says becomes a part of the page."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st
from jinja2 import UndefinedError

from parser.findings.catalogue import Bilingual
from sim.show.draw.style import DARK, LIGHT, Paint
from sim.show.html.environment import rendered, script_json, theme_css

EVIL = "</script><script>alert(1)</script><!-- & \u2028\u2029 ]]>"


@given(st.text() | st.just(EVIL))
def test_json_for_a_script_says_the_same_and_never_ends_the_element(text):
    written = script_json({"remark": text, text: 1})
    assert not set("<>&\u2028\u2029") & set(written)
    assert json.loads(written) == {"remark": text, text: 1}


def test_json_for_a_script_refuses_what_json_has_not():
    with pytest.raises(ValueError, match="not JSON compliant"):
        script_json([float("nan")])


def _page(folder, body, **values):
    (folder / "page.html.j2").write_text('{% extends "base.html.j2" %}' + body, encoding="utf-8")
    return rendered(folder, "page.html.j2", **values)


def test_a_page_escapes_values_in_texts_attributes_and_data(tmp_path):
    body = """
        {% block title %}{{ said }}{% endblock %}
        {% block body %}{{ words.both(text) }}<button {{ words.label(text) }}></button>
        <script type="application/json">{{ said | script_json }}</script>{% endblock %}"""
    page = _page(tmp_path, body, said=EVIL + "\"'", text=Bilingual(EVIL, EVIL + "\"'"))
    assert "alert(1)" in page
    assert "<script>alert" not in page
    assert "</script><!--" not in page
    assert '&#34;&#39;"' in page


def test_a_page_holds_its_style_sheets_and_scripts_and_loads_nothing(tmp_path):
    (tmp_path / "own.css").write_text("p > b { }", encoding="utf-8")
    (tmp_path / "other.js").write_text("export const one = 1;", encoding="utf-8")
    (tmp_path / "own.js").write_text('import { one } from "./other.js";\nif (one < 2 && 3 > 2) { }', encoding="utf-8")
    style = '{% block style %}{{ inlined("own.css") }}{% endblock %}'
    page = _page(tmp_path, style + '{% block scripts %}<script>{{ joined("own.js") }}</script>{% endblock %}')
    assert "p > b { }" in page
    assert "if (one < 2 && 3 > 2) { }" in page
    assert "const one = 1;" in page
    assert "import {" not in page
    assert "default-src 'none'" in page
    assert "http://" not in page
    assert "https://" not in page
    assert " src=" not in page


def test_a_value_that_a_template_lacks_is_an_error_and_no_gap(tmp_path):
    with pytest.raises(UndefinedError, match="missing"):
        _page(tmp_path, "{% block body %}{{ missing }}{% endblock %}")


def test_pages_have_the_colours_of_the_pictures_light_and_dark():
    light, dark = theme_css(leans=True).split("@media")
    for paint in Paint:
        assert "--{}: #{:02x}{:02x}{:02x};".format(paint, *LIGHT[paint]) in light
        assert "--{}: #{:02x}{:02x}{:02x};".format(paint, *DARK[paint]) in dark
    assert "prefers-color-scheme: dark" in dark
