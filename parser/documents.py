"""JSON that drycut writes: models of documents, and the JSON schemas made of them; the border is a `Document`.

Types of the fields of documents: what a value may be, and the limits that a JSON schema states of it.

A document is a `TypedDict`, so that mypy holds what is written against the model. Lengths are µm, times s, angles
degrees, unless the name of a field says otherwise.
"""

import types
from collections.abc import Mapping, Sequence
from typing import (
    Annotated,
    Any,
    Final,
    Literal,
    NamedTuple,
    TypedDict,
    Union,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)


class Limits(NamedTuple):
    """Limits of a value, as pairs of a keyword of JSON Schema and its value."""

    keywords: tuple[tuple[str, Any], ...]


def between(least: float | None, most: float | None) -> Limits:
    """Numbers from `least` to `most`, both allowed; None where there is no limit."""
    return _limits(minimum=least, maximum=most)


def matching(pattern: str) -> Limits:
    """Texts in which a regular expression (ECMA-262) is found."""
    return _limits(pattern=pattern)


def of_length(least: int, most: int | None = None) -> Limits:
    """Lists of so many items."""
    return _limits(minItems=least, maxItems=most)


def one_of(*names: str) -> Limits:
    """Texts that are one of some names."""
    return _limits(enum=names)


def _limits(**keywords: Any) -> Limits:
    return Limits(tuple((name, value) for name, value in keywords.items() if value is not None))


Text = Annotated[str, _limits(minLength=1)]
"""A text that is not empty."""
Slug = Annotated[str, matching("^[a-z][a-z-]*$")]
"""A name of ours, in lower case with hyphens."""
Version = Annotated[str, matching(r"^[0-9]+\.[0-9]+\.[0-9]+")]
Code = Annotated[str, matching("^(3B[1-7]|[A-Z]{2,8}[1-9])[0-9]{2}$")]
"""Code of a finding: of drycut, or of a check of a shop's own."""
Ordinal = Annotated[int, between(1, None)]
"""Number of something that is counted from 1: block, line, column, contour."""
Count = Annotated[int, between(0, None)]
Size = Annotated[float, between(0, None)]
"""A number that is not negative."""
Positive = Annotated[float, _limits(exclusiveMinimum=0)]
Point = Annotated[list[float], of_length(2, 2)]
"""Coordinates x, y."""
StepPoint = Annotated[list[int], of_length(2, 2)]
"""Coordinates x, y in whole steps of 1 µm."""
BlockRange = Annotated[list[Ordinal], of_length(2, 2)]
"""First and last block."""
Ring = Annotated[list[Point], of_length(3)]
"""Corners of a closed polygon."""
Encoding = Annotated[str, one_of("utf-8", "utf-8-sig", "utf-16-le", "utf-16-be", "gb18030", "big5", "latin-1")]
"""Encoding of a program file."""
DIALECT = r"3B|4B|3B\+4B|PMAC|[a-z0-9][a-z0-9_-]*"
"""Names of dialects: in small letters those of ISO, profiles and a shop's own."""
DialectName = Annotated[str, matching(f"^(?:{DIALECT})$")]
"""Dialect of a program, of ISO the profile that it was read by, or a dialect of a shop's own."""
AxisName = Annotated[str, one_of("X", "Y")]
CurveName = Annotated[str, one_of("line", "arc", "jump")]
Sense = Annotated[str, one_of("ccw", "cw")]
SeverityName = Annotated[str, one_of("error", "warning", "note")]
Judgement = Literal["pass", "fail"]
CheckVerdict = Annotated[str, one_of("pass", "fail", "incomplete")]
CheckProgress = Annotated[str, one_of("complete", "incomplete", "not asked")]


class AssumptionEntry(TypedDict):
    """What a program's text leaves open: what it is, what it was taken for, and why."""

    what: Slug
    taken: Text
    why: Text


class BlockCountsEntry(TypedDict):
    """How many blocks were found, read, decoded and stepped."""

    found: Count
    read: Count
    decoded: Count
    stepped: Count


class SaidEntry(TypedDict):
    """A text in both languages."""

    en: str
    zh: str


DRAFT: Final = "https://json-schema.org/draft/2020-12/schema"
_PLAIN: Final = {str: "string", int: "integer", float: "number", bool: "boolean"}

FieldType = Any
"""A type of a field: a class, a union, a literal, an `Annotated`; typing has no name for all of these."""


class Law(NamedTuple):
    """What a field says of others of the same object.

    Attributes
    ----------
    model
        The object.
    field, is_
        The field, and the type of the values of which the law speaks.
    then, otherwise
        What the others are then, and else: of each a type, or a fragment of JSON Schema.
    """

    model: type
    field: str
    is_: FieldType
    then: Mapping[str, FieldType]
    otherwise: Mapping[str, FieldType] = {}


class Document(NamedTuple):
    """A document that drycut writes.

    Attributes
    ----------
    model
        A `TypedDict`, whose field ``schema`` is the name of the document and its version.
    page
        Where it is described key by key: a page of ``docs``.
    laws
        What its fields say of each other.
    """

    model: type
    page: str
    laws: Sequence[Law] = ()

    @property
    def name(self) -> str:
        """Such as ``drycut.report/1``."""
        (name,) = get_args(get_type_hints(self.model)["schema"])
        return str(name)


def document_schema(document: Document) -> dict[str, Any]:
    """JSON schema of a document; objects within others stand under ``$defs``, by the names of their models."""
    models = _Models(document.laws)
    whole = models.whole(document.model)
    return {
        "$schema": DRAFT,
        "title": document.name,
        **whole,
        "description": f"{whole['description']} Key by key: {document.page}.",
        "$defs": models.defs,
    }


def schema_text(document: Document) -> str:
    """The schema as a file has it."""
    import json  # noqa: PLC0415 - a check writes no schema, and is sooner without

    return json.dumps(document_schema(document), indent=1, ensure_ascii=False) + "\n"


class _Models:
    """Schemas of models, each made once.

    Attributes
    ----------
    defs
        Schemas by the names of the models.
    """

    def __init__(self, laws: Sequence[Law]) -> None:
        self._laws = laws
        self._known: dict[str, type] = {}
        self.defs: dict[str, dict[str, Any]] = {}

    def whole(self, model: type) -> dict[str, Any]:
        """Schema of a model."""
        properties = {name: self.field(of) for name, of in get_type_hints(model, include_extras=True).items()}
        laws = [self._law(law) for law in self._laws if law.model is model]
        return {
            **({"description": " ".join(model.__doc__.split())} if model.__doc__ else {}),
            "type": "object",
            "additionalProperties": False,
            "required": list(properties),
            "properties": properties,
            **({"allOf": laws} if laws else {}),
        }

    def field(self, of: FieldType) -> dict[str, Any]:
        """Schema of a field. Raises TypeError for a type that no document has."""
        if of in _PLAIN:
            return {"type": _PLAIN[of]}
        if of is None or of is type(None):
            return {"type": "null"}
        if is_typeddict(of):
            return self._ref(of)
        return self._composed(of, get_origin(of), get_args(of))

    def _composed(self, of: FieldType, origin: FieldType, args: tuple[FieldType, ...]) -> dict[str, Any]:
        if origin is Annotated:
            return self._limited(*args)
        if origin is Literal:
            return {"const": args[0]} if len(args) == 1 else {"enum": list(args)}
        if origin is list:
            return {"type": "array", "items": self.field(args[0])}
        if origin is dict:
            return {"type": "object", **self._names(args[0]), "additionalProperties": self.field(args[1])}
        if origin in (Union, types.UnionType):
            return _any_of([self.field(arg) for arg in args])
        raise TypeError(f"no type of a field: {of}")

    def _limited(self, of: FieldType, limits: Limits) -> dict[str, Any]:
        keywords = {word: list(value) if isinstance(value, tuple) else value for word, value in limits.keywords}
        return keywords if "enum" in keywords else {**self.field(of), **keywords}

    def _names(self, of: FieldType) -> dict[str, Any]:
        return {} if of is str else {"propertyNames": self.field(of)}

    def _ref(self, model: type) -> dict[str, Any]:
        name = model.__name__
        if self._known.setdefault(name, model) is not model:
            raise TypeError(f"two models with the name {name}")
        if name not in self.defs:
            self.defs[name] = {}  # its place in the order of first mention
            self.defs[name] = self.whole(model)
        return {"$ref": f"#/$defs/{name}"}

    def _law(self, law: Law) -> dict[str, Any]:
        parts = {"if": {law.field: law.is_}, "then": law.then, "else": law.otherwise}
        return {word: {"properties": self._fields(fields)} for word, fields in parts.items() if fields}

    def _fields(self, fields: Mapping[str, FieldType]) -> dict[str, Any]:
        return {name: of if isinstance(of, dict) else self.field(of) for name, of in fields.items()}


def _any_of(schemas: Sequence[dict[str, Any]]) -> dict[str, Any]:
    """Either of some; a plain type or null is written as one schema with two types."""
    first, *others = schemas
    if others == [{"type": "null"}] and "type" in first:
        return {**first, "type": [first["type"], "null"]}
    return {"anyOf": list(schemas)}
