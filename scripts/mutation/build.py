"""The mutated copy of the sources: written, compiled, and rid of the breaks that do not compile."""

import hashlib
import json
import re
import subprocess

SOURCES = "src/wheelwright"


def tracked_files(root):
    listing = subprocess.run(["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"], cwd=root,
                             capture_output=True, check=True, text=True)
    return sorted({name for name in listing.stdout.split("\0") if name and (root / name).is_file()})


def read_sources(root):
    """File -> text."""
    return {str(path.relative_to(root)): path.read_text() for path in sorted((root / SOURCES).rglob("*"))
            if path.suffix in (".cc", ".h")}


def mutated(text, mutants):
    """The file with all its mutants, none of them active."""
    for mutant in sorted(mutants, key=lambda m: -m.site.begin):
        site = mutant.site
        text = text[:site.begin] + site.guarded.replace("@", str(mutant.number)) + text[site.end:]
    return text


def targets_for(root, pattern):
    """The program, and the test programs that match."""
    if not pattern:
        return ["wheelwright", "tests/all"]
    return ["wheelwright", *sorted(p.stem for p in (root / "tests").glob("*_test.cc") if re.search(pattern, p.stem))]


def write_if_changed(path, content, mode):
    """Does not touch files that are as they should be, so that they are not compiled again."""
    if not path.exists() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    path.chmod(mode)


def write_copy(root, copy, texts, mutants):
    by_file = {}
    for mutant in mutants:
        by_file.setdefault(mutant.file, []).append(mutant)
    names = tracked_files(root)
    for name in names:
        content = (root / name).read_bytes()
        if name in by_file:
            header = f"#include <{root}/scripts/mutation/mutants.h>\n#line 1\n"
            content = (header + mutated(texts[name], by_file[name])).encode()
        write_if_changed(copy / name, content, (root / name).stat().st_mode)
    for path in copy.rglob("*"):
        if path.is_file() and str(path.relative_to(copy)) not in names:
            path.unlink()


def configure(copy, build):
    if not (build / "build.ninja").exists():
        subprocess.run(["cmake", "-S", copy, "-B", build, "-G", "Ninja", "-D", "WHEELWRIGHT_BENCHMARKS=OFF"],
                       stdout=subprocess.DEVNULL, check=True)


def compile_copy(build, targets, jobs):
    """The compiler's output; empty when all is built."""
    result = subprocess.run(["ninja", "-C", build, "-j", str(jobs), "-k", "0", *targets], capture_output=True,
                            text=True, check=False)
    return "" if result.returncode == 0 else result.stdout + result.stderr


def broken_lines(copy, output):
    """(file, line) of every place that the compiler names in an error or on the way to one."""
    places = set()
    for file, line in re.findall(rf"([^\s:()]*{SOURCES}/[\w/]+\.(?:cc|h)):(\d+)", output):
        places.add((file[file.index(SOURCES):], int(line)))
    return places


class Refused:
    """The names of the random breaks that do not compile, remembered for the next time that the same sources are broken
    in the same order."""

    def __init__(self, file, candidates):
        self.file = file
        self.key = hashlib.sha256("\n".join(f"{m.place()} {m.change()}" for m in candidates).encode()).hexdigest()
        known = json.loads(file.read_text()) if file.exists() else {}
        self.names = set(known["names"]) if known.get("key") == self.key else set()

    def add(self, names):
        self.names |= names
        self.file.write_text(json.dumps({"key": self.key, "names": sorted(self.names)}))


def make(root, folder, texts, kept, candidates, choose, targets, jobs, tell):
    """Writes and compiles until every mutant compiles; returns them. `choose` gives the random ones of the candidates
    without those that do not compile, which give their place to others."""
    copy, build = folder / "source", folder / "build"
    folder.mkdir(parents=True, exist_ok=True)
    refused = Refused(folder / "refused.json", candidates)
    while True:
        chosen = choose(refused.names)
        mutants = [*kept, *chosen]
        write_copy(root, copy, texts, mutants)
        configure(copy, build)
        tell(f"compiling {len(kept)} kept and {len(chosen)} random breaks")
        # The program first: what does not compile mostly shows there, before the tests are compiled in vain.
        output = compile_copy(build, targets[:1], jobs) or compile_copy(build, targets, jobs)
        if not output:
            return mutants
        places = broken_lines(copy, output)
        guilty = {m.name for m in chosen
                  if any(file == m.file and m.line <= line <= m.line + 1 + m.original.count("\n")
                         for file, line in places)}
        blamed = [m.name for m in kept if any(file == m.file and abs(line - m.line) <= 3 for file, line in places)]
        if not guilty:
            raise RuntimeError(f"the mutated copy does not compile; kept breaks near the errors: "
                               f"{', '.join(blamed) or 'none'}\n{output[-4000:]}")
        tell(f"{len(guilty)} random breaks do not compile and are replaced")
        refused.add(guilty)
