"""JSON that can stand inside a ``<script>`` element whatever the strings in it say."""

import json
from typing import Any

from markupsafe import Markup

_ESCAPED = {ord(character): f"\\u{ord(character):04x}" for character in "<>&\u2028\u2029"}


def script_json(value: Any) -> Markup:
    """JSON of a value for ``<script type="application/json">``: nothing in it ends the element or opens a comment.

    ``<``, ``>``, ``&`` and the line ends U+2028 and U+2029 occur in strings alone, where JSON knows them by number too.
    Raises ValueError on NaN and infinities, which JSON has not.
    """
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return Markup(text.translate(_ESCAPED))  # noqa: S704 - escaped just above
