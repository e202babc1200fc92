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
# Tests of the sources and headers as they are, and those that drive a browser, which hangs under the limits below.
NOT_ASKED = re.compile(r"mutation|installed|report_page|watch\.")
ENVIRONMENT = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "OMP_THREAD_LIMIT": "1"}


class Unit:
    """One test program with all its usual tests, but those that fail without any break."""

    def __init__(self, name, program, arguments, folder, is_gtest):
        self.name, self.program, self.arguments, self.folder, self.is_gtest = name, program, arguments, folder, is_gtest
        self.seconds, self.reached, self.left_out = 0.0, frozenset(), []

    def command(self):
        if not self.is_gtest:
            return [self.program, *self.arguments]
        return [self.program, "--gtest_filter=-" + ":".join(["*Slow*", *self.left_out])]


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
        is_gtest = any(a.startswith("--gtest_filter") for a in arguments)
        name = Path(program).name if is_gtest else test["name"]
        if not NOT_ASKED.match(name) and re.search(pattern, name):
            folder = properties.get("WORKING_DIRECTORY", str(build))
            units.setdefault(name, Unit(name, program, arguments, folder, is_gtest))
    return list(units.values())


def limit(seconds):
    """In the child: what a broken program may use. Where it loops without end, its processor time ends."""
    if seconds:
        resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (FILE_SIZE, FILE_SIZE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def output_of(unit, variables, seconds, options=()):
    """Exit code and output of the tests; the code is None when they took too long: each process may take so many seconds
    of processor time, and all of them ten times as long. None is no limit."""
    scratch = tempfile.mkdtemp(prefix="wheelwright-mutant-")
    environment = {**os.environ, **ENVIRONMENT, "TMPDIR": scratch, **variables}
    process = subprocess.Popen([*unit.command(), *options], cwd=unit.folder, env=environment, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
                               preexec_fn=lambda: limit(seconds), text=True, errors="replace")
    try:
        output, _ = process.communicate(timeout=seconds and 10 * seconds)
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        process.communicate()
        return None, ""
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    return (None if process.returncode in (-signal.SIGXCPU, -signal.SIGKILL) else process.returncode), output


def failed_tests(output):
    return list(dict.fromkeys(a or b for a, b in re.findall(r"^\[  FAILED  \] ([A-Za-z_]\S*?),? |^(?:FAIL|ERROR): (\S+)", output + " ",
                                                            re.MULTILINE)))


def failure_of(unit, variables, seconds):
    """None when all tests pass, otherwise what failed first: a test's name, an exit code, or the time limit."""
    code, output = output_of(unit, variables, seconds, ["--gtest_fail_fast"] if unit.is_gtest else [])
    if code == 0:
        return None
    failed = failed_tests(output)
    return f"{unit.name}: {'time limit' if code is None else failed[0] if failed else f'exit code {code}'}"


def measure_one(unit):
    """Runs a unit with no break: how long it takes and what it reaches. Returns what fails, and leaves it out."""
    with tempfile.NamedTemporaryFile() as shared:
        shared.write(bytes(MOST_MUTANTS))
        shared.flush()
        start = time.monotonic()
        code, output = output_of(unit, {"WHEELWRIGHT_MUTANTS_REACHED": shared.name}, None)
        unit.seconds = time.monotonic() - start
        unit.reached = frozenset(k for k, byte in enumerate(Path(shared.name).read_bytes()) if byte)
    if code == 0:
        return []
    failed = failed_tests(output) if unit.is_gtest else []
    unit.left_out = failed
    if failed and output_of(unit, {}, None)[0] == 0:
        return [f"{unit.name}: {test}" for test in failed]
    unit.reached = frozenset()
    return [f"{unit.name}: all of it"]


def measure(units, mutants, jobs, tell):
    """Runs every unit with no break, and puts the fastest first. Returns the tests that failed: they cannot tell a break
    from none and are not asked."""
    assert max(m.number for m in mutants) < MOST_MUTANTS

    def measure_and_tell(unit):
        failed = measure_one(unit)
        tell(f"{unit.name}: {unit.seconds:.1f} s, reaches {len(unit.reached)} of {len(mutants)} breaks"
             + (f", FAILS WITHOUT ANY BREAK: {', '.join(failed)}" if failed else ""))
        return failed

    with ThreadPoolExecutor(jobs) as pool:
        failures = [test for failed in pool.map(measure_and_tell, units) for test in failed]
    units.sort(key=lambda unit: unit.seconds)
    return failures


def first_to_notice(units, number, budget):
    """What catches a mutant, or None; and how many units reach it. Units that would take more than `budget` seconds
    together are not asked."""
    reaching = [unit for unit in units if number in unit.reached]
    spent = 0.0
    for unit in reaching:
        spent += unit.seconds
        if spent > budget:
            break
        caught = failure_of(unit, {"WHEELWRIGHT_MUTANT": str(number)}, int(20 + 5 * unit.seconds))
        if caught:
            return caught, len(reaching)
    return None, len(reaching)
