"""The program `collisions` as such: its commands, its version, its console, its log, and that it can be interrupted."""

from __future__ import annotations

import importlib.metadata
import io
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from program import EXACT, QUICK, collisions, files_in

from labs.cli import main

ENOUGH = 120.0  # s: a run of the program takes some seconds, and longer on a busy machine
PROMPTLY = 30.0  # s: on a busy machine some seconds, and a small part of what the interrupted job would take
START = (
    "import signal, sys; signal.signal(signal.SIGINT, signal.default_int_handler);"  # some shells have it ignored
    " sys.argv[0] = 'collisions'; from labs.cli import main; main()"
)


def test_the_installed_program_is_this_one():
    (script,) = importlib.metadata.entry_points(group="console_scripts", name="collisions")
    assert script.load() is main


def test_help_lists_the_commands_and_an_unknown_command_is_refused():
    for name in ("compare", "report", "engines"):
        assert re.search(rf"\b{name}\b", collisions("--help").text)
        assert collisions(name, "--help").code == 0
    assert collisions("--help").code == 0
    wrong = collisions("compere")
    assert (wrong.code, "No such command 'compere'" in wrong.error) == (2, True)


@pytest.mark.parametrize("command", [("compare",), ("check", "lab.py"), ("grade", ".", "--lab", "impulse")])
def test_a_time_without_end_is_refused_by_the_name_of_its_option(command):
    wrong = collisions(*command, "--seconds", "inf")
    assert (wrong.code, "--seconds" in wrong.error) == (2, True)


def test_the_program_prints_its_version():
    said = collisions("--version")
    assert (said.code, said.output) == (0, f"collisions-lab {importlib.metadata.version('collisions-lab')}\n")


@pytest.mark.usefixtures("one_worker")
@pytest.mark.slow
def test_an_ascii_console_gets_utf_8_and_progress_goes_to_stderr(monkeypatch):
    written = {name: io.BytesIO() for name in ("stdout", "stderr")}
    for name, stream in written.items():
        monkeypatch.setattr(sys, name, io.TextIOWrapper(stream, encoding="ascii", write_through=True))
    monkeypatch.setattr(sys, "argv", ["collisions", "compare", *EXACT])
    with pytest.raises(SystemExit) as ended:
        main()
    assert ended.value.code == 0
    out, errors = (stream.getvalue().decode("utf-8") for stream in written.values())
    assert "2 eⁿ t₁ with t₁ = √(2 h/g)" in out
    assert "1 run, " in errors, "progress goes where errors go"
    assert "run, " not in out


@pytest.mark.usefixtures("one_worker")
def test_verbose_logs_what_is_run():
    assert "started" in collisions("-v", "compare", *EXACT).error
    assert "started" not in collisions("compare", *EXACT).error


# Interrupts


def alive(pid: int) -> bool:
    state = subprocess.run(["ps", "-o", "stat=", "-p", str(pid)], capture_output=True, text=True, check=False).stdout
    return bool(state.strip()) and not state.strip().startswith("Z")


def interrupt(command: list[str], running: Path, workers: int, number: int) -> tuple[int, str, list[int]]:
    """Start the program, interrupt it when its workers have said their numbers; return code, errors and numbers."""
    program = subprocess.Popen([sys.executable, "-c", START, *command], stderr=subprocess.PIPE, text=True)
    try:
        deadline = time.monotonic() + ENOUGH
        while len(os.listdir(running)) < workers:
            assert time.monotonic() < deadline
            assert program.poll() is None, program.stderr.read()
            time.sleep(0.02)
        start = time.monotonic()
        program.send_signal(number)
        _, said = program.communicate(timeout=ENOUGH)
        assert time.monotonic() - start < PROMPTLY
    finally:
        program.kill()
    return program.returncode, said, [int(name) for name in os.listdir(running)]


@pytest.mark.skipif(os.name != "posix", reason="where a process can be interrupted by a signal")
@pytest.mark.parametrize(("command", "number"), [("compare", signal.SIGINT), ("report", signal.SIGTERM)])
@pytest.mark.slow
def test_an_interrupt_ends_the_program_with_130_and_leaves_nothing(command, number, tmp_path, odd):
    running, out = tmp_path / "running", tmp_path / "out"
    running.mkdir()
    out.mkdir()
    (out / "index.html").write_text("an earlier report")
    # Tuned, at 0.01 s, it answers, and its worker waits for another job; stock, it sleeps for longer than any test.
    begun = f"open(os.path.join({str(running)!r}, str(os.getpid())), 'w').close()"
    body = f"{begun}; time.sleep(600 if settings.timestep > 0.01 else 0)"
    engine = ("--engine", odd(body), "--jobs", "2")
    chosen = ["compare", QUICK[0], *engine] if command == "compare" else ["report", "--only", QUICK[0], *engine]
    wish = [*chosen, *(["--out", str(out)] if command == "report" else [])]
    code, said, workers = interrupt(wish, running, 2, number)
    assert code == 130
    assert ("Interrupted by SIGTERM." if number == signal.SIGTERM else "Interrupted.") in said
    assert "The runs that have ended are kept." in said
    assert "Traceback" not in said
    assert len(workers) == 2
    assert not any(map(alive, workers))
    assert files_in(out) == {"index.html": b"an earlier report"}
    assert os.listdir(out) == ["index.html"]
