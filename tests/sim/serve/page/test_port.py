"""The port of the server: had again at once after a server that ended, and never shared."""

import socket
import sys

import pytest
from opened_page import opened_page

from sim.serve import listening
from sim.serve.listening import PortError


@pytest.mark.deeper
@pytest.mark.skipif(sys.platform == "win32", reason="there old connections do not hinder")
def test_a_port_can_be_had_at_once_after_its_server_has_ended() -> None:
    with opened_page() as first:
        port = int(first.host.partition(":")[2])
        with socket.create_connection(("127.0.0.1", port), 10.0) as link:
            link.sendall(f"GET {first.path} HTTP/1.1\r\nHost: {first.host}\r\n\r\n".encode())
            assert link.recv(12) == b"HTTP/1.1 200"
            first.ask("close")  # the server closes the connection, which then waits for a minute
            assert first.ended() == 0
            while link.recv(1 << 16):
                pass  # what is left unread would end the connection at once
    with socket.socket() as plain, pytest.raises(OSError, match="in use"):
        plain.bind(("127.0.0.1", port))
    with opened_page(None, "--port", str(port)) as second:
        assert second.host == f"127.0.0.1:{port}"
        assert second.ask("first").status == 200


def test_a_port_that_is_listened_on_is_not_shared() -> None:
    with listening.listening_on(0) as taken:
        port = taken.getsockname()[1]
        with pytest.raises(PortError, match=f"port {port} cannot be listened on"), listening.listening_on(port):
            pass


def test_windows_is_asked_for_a_port_of_our_own(monkeypatch: pytest.MonkeyPatch) -> None:
    asked = []

    class Recorder:
        def setsockopt(self, *told: int) -> None:
            asked.append(told)

    monkeypatch.setattr(listening.socket, "SO_EXCLUSIVEADDRUSE", -5, raising=False)
    monkeypatch.setattr(listening.sys, "platform", "win32")
    listening._claim(Recorder())  # type: ignore[arg-type]
    assert asked == [(socket.SOL_SOCKET, -5, 1)]
