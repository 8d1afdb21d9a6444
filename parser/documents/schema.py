"""JSON schemas of documents, made of their models."""

import json
import types
from collections.abc import Mapping, Sequence
from typing import (
    Annotated,
    Any,
    Final,
    Literal,
    NamedTuple,
    Union,
    get_args,
    get_origin,
    get_type_hints,
    is_typeddict,
)

from parser.documents.fields import Limits

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
