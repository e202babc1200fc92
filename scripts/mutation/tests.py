"""The test programs: which places of the mutated sources each of them reaches, how long it takes, and whether it
notices a break."""

import json
import os
import re
import resource
import shutil
import signal
import subprocess
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

MOST_MUTANTS = 4096  # as in mutants.h
MEMORY, FILE_SIZE = 8 << 30, 1 << 30
NOT_OF_A_COPY = ("mutation", "installed")  # tests of the sources and of the headers as they are
ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OMP_THREAD_LIMIT": "1"}


class Unit:
    """One test program with all its usual tests."""

    def __init__(self, name, command, folder):
        self.name, self.command, self.folder = name, command, folder
        self.seconds, self.reached = 0.0, frozenset()


def units_of(build, pattern):
    """The programs behind the usual tests of ctest, each once; of them those whose name matches."""
    listing = json.loads(subprocess.run(["ctest", "--test-dir", build, "--show-only=json-v1"], capture_output=True,
                                        text=True, check=True).stdout)
    units = {}
    for test in listing["tests"]:
        properties = {p["name"]: p["value"] for p in test["properties"]}
        if "slow" in properties.get("LABELS", []) or "command" not in test:
            continue
        program, *arguments = test["command"]
        if any(a.startswith("--gtest_filter") for a in arguments):
            arguments = ["--gtest_filter=-*Slow*", "--gtest_fail_fast"]
            name = Path(program).name
        else:
            name = test["name"]
        if name not in NOT_OF_A_COPY and re.search(pattern, name):
            folder = properties.get("WORKING_DIRECTORY", str(build))
            units.setdefault(name, Unit(name, [program, *arguments], folder))
    return list(units.values())


def limit():
    """In the child: what a broken program may use."""
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_SIZE, FILE_SIZE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(unit, variables, time_limit):
    """None when all tests pass, otherwise what failed: a test's name, an exit code, or the time limit."""
    scratch = tempfile.mkdtemp(prefix="wheelwright-mutant-")
    environment = {**os.environ, **ENVIRONMENT, "TMPDIR": scratch, **variables}
    process = subprocess.Popen(unit.command, cwd=unit.folder, env=environment, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                               preexec_fn=limit, text=True, errors="replace")
    try:
        output, _ = process.communicate(timeout=time_limit)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return f"{unit.name}: time limit"
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    if process.returncode == 0:
        return None
    failed = re.search(r"^\[  FAILED  \] (\S+)|^(?:FAIL|ERROR): (\S+)", output, re.MULTILINE)
    test = failed and (failed[1] or failed[2])
    return f"{unit.name}: {test or f'exit code {process.returncode}'}"


def measure(units, mutants, jobs, tell):
    """Runs every unit with no break: fails when one fails. Fastest first afterwards."""
    assert max(m.number for m in mutants) < MOST_MUTANTS

    def measure_one(unit):
        with tempfile.NamedTemporaryFile() as shared:
            shared.write(bytes(MOST_MUTANTS))
            shared.flush()
            start = time.monotonic()
            failed = run(unit, {"WHEELWRIGHT_MUTANTS_REACHED": shared.name}, None)
            unit.seconds = time.monotonic() - start
            unit.reached = frozenset(k for k, byte in enumerate(Path(shared.name).read_bytes()) if byte)
        tell(f"{unit.name}: {unit.seconds:.1f} s, reaches {len(unit.reached)} of {len(mutants)} breaks")
        return failed

    with ThreadPoolExecutor(jobs) as pool:
        failures = [failed for failed in pool.map(measure_one, units) if failed]
    if failures:
        raise RuntimeError(f"tests fail without any break: {'; '.join(failures)}")
    units.sort(key=lambda unit: unit.seconds)


def first_to_notice(units, number, budget):
    """What catches a mutant, or None; and how many units reach it. Units that would take more than `budget` seconds
    together are not asked."""
    reaching = [unit for unit in units if number in unit.reached]
    spent = 0.0
    for unit in reaching:
        spent += unit.seconds
        if spent > budget:
            break
        caught = run(unit, {"WHEELWRIGHT_MUTANT": str(number)}, 20 + 5 * unit.seconds)
        if caught:
            return caught, len(reaching)
    return None, len(reaching)
