"""Requests of the page: the texts that one carries, and the answer to one that the page does not send."""

import json
from collections.abc import Awaitable, Callable
from typing import Final, TypeAlias

from starlette.requests import ClientDisconnect, Request
from starlette.responses import Response

Work: TypeAlias = Callable[[Request], Awaitable[Response]]
"""What answers a request."""
BAD: Final = 400
MISSING: Final = 404
NOTHING: Final = 204


class BadRequestError(Exception):
    """A request that the page does not send."""


async def told(request: Request, *names: str) -> dict[str, str]:
    """The texts of a request by their names. BadRequestError where one is missing."""
    try:
        texts = json.loads(await request.body())
    except (ValueError, RecursionError) as error:
        raise BadRequestError from error
    if not isinstance(texts, dict) or not all(isinstance(texts.get(name), str) for name in names):
        raise BadRequestError
    return {name: texts[name] for name in names}


def name_of(work: Work) -> str:
    """Of a request: that of the method that answers it."""
    return str(getattr(work, "__name__", ""))


def guarded(work: Work) -> Work:
    """The same, with an answer to requests that the page does not send."""

    async def answered(request: Request) -> Response:
        try:
            return await work(request)
        except (BadRequestError, ClientDisconnect):
            return Response(status_code=BAD)

    return answered
