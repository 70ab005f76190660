"""Fixtures of pytest for robot programs: `xr3_server`, `robot` and `monitor`. Each test has a server
of its own, with the byte clock, and a recording; a test that fails shows the last exchanges. pytest
loads this module by itself where the package is installed (pyproject.toml)."""

import hashlib
import re
from pathlib import Path
from typing import Any, Dict, Iterator

import pytest

from xr3.monitor import Monitor
from xr3.program import ServerError
from xr3.robot import Robot
from xr3.server import Server

OPTIONS = ("robot", "workcell", "fault", "clock", "compat", "concurrent_lines", "line_speed", "pty")
MARK = ", ".join(f"{name}=" for name in OPTIONS)
NAME_LENGTH = 100  # characters of a test's name in that of its recording

_server = pytest.StashKey[Server]()
_recording = pytest.StashKey[Path]()
_failed = pytest.StashKey[bool]()


def pytest_addoption(parser: pytest.Parser) -> None:
    group = parser.getgroup("xr3", "the simulated robot xr3")
    group.addoption("--xr3-program", metavar="FILE",
                    help="the program xr3 (default: the variable XR3, else beside Python, else on PATH)")
    group.addoption("--xr3-keep", metavar="FOLDER",
                    help="keep the recordings of all tests in this folder, not only of those that fail")


def pytest_configure(config: pytest.Config) -> None:
    config.addinivalue_line("markers", f"xr3({MARK}): options of xr3 serve for the test's robot")


@pytest.fixture
def xr3_server(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch,
               tmp_path_factory: pytest.TempPathFactory) -> Iterator[Server]:
    """A server for this test alone, an `xr3.Server`. The programs that the test starts find it by
    XR3_HOST, XR3_PORT and XR3_MONITOR_PORT. `@pytest.mark.xr3(robot="adept-one")` chooses its
    options; the clock is `bytes` unless `clock=` says otherwise."""
    node, config = request.node, request.config
    options = _options(node)
    keep = config.getoption("xr3_keep")
    folder = config.invocation_params.dir / keep if keep else tmp_path_factory.getbasetemp() / "xr3"
    recording = node.stash[_recording] = folder / _file_name(node.nodeid)
    folder.mkdir(parents=True, exist_ok=True)
    recording.unlink(missing_ok=True)  # the server would take another name
    try:
        server = Server(program=config.getoption("xr3_program"), record=recording, **options)
    except ServerError as error:
        pytest.fail(str(error), pytrace=False)
    with server:
        node.stash[_server] = server
        _set_environment(monkeypatch, server, options)
        yield server
    del node.stash[_server]
    if not keep and not node.stash.get(_failed, False):
        recording.unlink(missing_ok=True)


@pytest.fixture
def robot(xr3_server: Server) -> Iterator[Robot]:
    """An `xr3.Robot` at the robot port of this test's server, with the arm of its robot."""
    with xr3_server.robot() as connected:
        yield connected


@pytest.fixture
def monitor(xr3_server: Server) -> Iterator[Monitor]:
    """An `xr3.Monitor` at the monitor port of this test's server."""
    with xr3_server.monitor() as connected:
        yield connected


@pytest.hookimpl(hookwrapper=True)
def pytest_runtest_makereport(item: pytest.Item) -> Iterator[None]:
    outcome: Any = yield
    report = outcome.get_result()
    if not report.failed or _server not in item.stash:
        return
    item.stash[_failed] = True
    report.sections.append(("xr3: the last exchanges", _last_exchanges(item.stash[_server])))
    report.sections.append(("xr3: the recording", f"xr3 replay {item.stash[_recording]}"))


def _options(node: pytest.Item) -> Dict[str, Any]:
    """The options of the marks: those of the test before those of its class and its module."""
    options: Dict[str, Any] = {"clock": "bytes"}
    for mark in reversed(list(node.iter_markers("xr3"))):
        wrong = [*map(repr, mark.args), *(f"{name}=" for name in mark.kwargs if name not in OPTIONS)]
        if wrong:
            raise pytest.UsageError(f"{node.nodeid}: the mark xr3 takes {MARK}; "
                                    f"not {', '.join(wrong)}")
        options.update(mark.kwargs)
    return options


def _set_environment(monkeypatch: pytest.MonkeyPatch, server: Server,
                     options: Dict[str, Any]) -> None:
    """The variables by which programs find the robot. A program that asks again without a pause
    suits the byte clock only."""
    pause_ms = 0 if str(options["clock"]).startswith("bytes") else None
    variables = {"XR3_HOST": server.host, "XR3_PORT": server.port, "XR3_PTY": server.pty,
                 "XR3_MONITOR_PORT": server.monitor_port, "XR3_POLL_MS": pause_ms}
    for name, value in variables.items():
        if value is None:
            monkeypatch.delenv(name, raising=False)
        else:
            monkeypatch.setenv(name, str(value))


def _last_exchanges(server: Server) -> str:
    try:
        return "\n".join(server.wires()) or "nothing was sent"
    except OSError as error:
        return f"the server has ended: {error}"


def _file_name(test: str) -> str:
    plain = re.sub(r"[^A-Za-z0-9_.-]+", "-", test)[-NAME_LENGTH:].strip("-")
    return f"{plain}-{hashlib.sha256(test.encode()).hexdigest()[:8]}.xr3rec"
