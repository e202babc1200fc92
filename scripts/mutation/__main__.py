"""The command line of scripts/mutate."""

import argparse
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from . import build, tests
from .mutants import StaleList, choose, kept_mutants, shuffled_candidates

ROOT = Path(__file__).resolve().parents[2]
LEAST_CAUGHT = 0.85  # of the random breaks


def parsed(arguments):
    parser = argparse.ArgumentParser(
        prog="scripts/mutate",
        description="Breaks the sources in one place at a time and runs the usual tests until one fails: the breaks "
        "of tests/mutations and random ones of signs, comparisons, indices and axes. One build of a copy holds them "
        "all; a variable of the environment picks one. Fails when a break of the list does not fit the sources or is "
        f"not caught, or when fewer than {100 * LEAST_CAUGHT:.0f} %% of the random ones are caught.")
    parser.add_argument("--list", action="store_true", help="name the breaks and run nothing")
    parser.add_argument("--only", metavar="NAME", action="append", default=[],
                        help="only this break, as --list names it, e.g. k7 or r12; may be repeated")
    parser.add_argument("--random", type=int, default=200, metavar="N", help="random breaks (%(default)s)")
    parser.add_argument("--sample", type=int, metavar="N", help="N of all breaks, evenly chosen")
    parser.add_argument("--seed", type=int, default=1, help="of the random breaks (%(default)s)")
    parser.add_argument("--jobs", type=int, default=2, help="tests at a time (%(default)s)")
    parser.add_argument("--tests", default="", metavar="REGEX", help="build and run only these test programs")
    parser.add_argument("--budget", type=float, default=float("inf"), metavar="SECONDS",
                        help="of the tests asked about one break, fastest first; what they do not notice counts as a "
                        "survivor (all tests that reach it)")
    parser.add_argument("--report", type=Path, metavar="FILE", help="write the report to this file too")
    parser.add_argument("--folder", type=Path, default=ROOT / "build/mutants", metavar="DIR",
                        help="of the copy and its build (build/mutants)")
    return parser.parse_args(arguments)


def tell(text):
    print(f"{time.strftime('%H:%M:%S')} {text}", file=sys.stderr, flush=True)


def sampled(mutants, options):
    if options.only:
        unknown = set(options.only) - {m.name for m in mutants}
        if unknown:
            raise SystemExit(f"scripts/mutate: no break {', '.join(sorted(unknown))}; see --list")
        return [m for m in mutants if m.name in options.only]
    if options.sample and options.sample < len(mutants):
        return [mutants[k * len(mutants) // options.sample] for k in range(options.sample)]
    return mutants


def try_all(chosen, units, jobs, budget):
    """(mutant, what caught it or None, number of programs that reach it), in the order of the mutants."""
    done = 0

    def attempt(mutant):
        nonlocal done
        caught, reaching = tests.first_to_notice(units, mutant.number, budget)
        done += 1
        tell(f"{done}/{len(chosen)} {mutant.name} {mutant.place()} {caught or 'SURVIVED'}")
        return mutant, caught, reaching

    with ThreadPoolExecutor(jobs) as pool:
        return list(pool.map(attempt, chosen))


def report(results, failures, options, seconds):
    """The text, and whether all is as it must be. `failures` are of the tests that fail without any break."""
    kept = [r for r in results if r[0].name.startswith("k")]
    chance = [r for r in results if r[0].name.startswith("r")]
    survivors = [r for r in results if not r[1]]
    lines = [f"# Breaks of the sources and the tests that notice them (seed {options.seed}, {seconds / 60:.0f} min)", ""]
    for title, group in (("of the list", kept), ("at random", chance)):
        caught = sum(1 for r in group if r[1])
        if group:
            lines.append(f"{title}: {caught} of {len(group)} caught ({100 * caught / len(group):.1f} %)")
    lines += [f"not asked, fails without any break: {failure}" for failure in failures]
    lines += ["", f"## Survivors: {len(survivors)}", ""]
    for mutant, _, reaching in survivors:
        lines.append(f"{mutant.name} {mutant.place()}: {mutant.change()}")
        lines.append(f"    {mutant.reason or mutant.site.kind}; reached by {reaching} test programs")
    lines += ["", "## Caught", ""]
    for mutant, caught, _ in results:
        if caught:
            lines.append(f"{mutant.name} {mutant.place()}: {mutant.change()}")
            lines.append(f"    {caught}")
    rate = sum(1 for r in chance if r[1]) / len(chance) if chance else 1
    good = all(r[1] for r in kept) and rate >= LEAST_CAUGHT
    return "\n".join(lines) + "\n", good


def main():
    options = parsed(None)
    start = time.monotonic()
    texts = build.read_sources(ROOT)
    try:
        kept = kept_mutants(ROOT / "tests/mutations", texts)
    except StaleList as problem:
        print(f"scripts/mutate: tests/mutations does not fit the sources:\n{problem}", file=sys.stderr)
        return 1
    candidates = shuffled_candidates(texts, options.seed)

    def chosen(refused):
        return choose(candidates, options.random, kept, refused)

    if options.list:
        for mutant in [*kept, *chosen(set())]:
            print(f"{mutant.name} {mutant.place()}: {mutant.change()}")
        return 0
    mutants = build.make(ROOT, options.folder, texts, kept, candidates, chosen,
                         build.targets_for(ROOT, options.tests), options.jobs, tell)
    units = tests.units_of(options.folder / "build", options.tests)
    failures = tests.measure(units, mutants, options.jobs, tell)
    results = try_all(sampled(mutants, options), units, options.jobs, options.budget)
    text, good = report(results, failures, options, time.monotonic() - start)
    print(text)
    if options.report:
        options.report.write_text(text)
    return 0 if good else 1
