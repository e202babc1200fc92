"""Tests of scripts/mutation. usage: mutation_test.py COMPILER, from the repository's top folder."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

sys.dont_write_bytecode = True
sys.path.insert(0, "scripts")

from mutation.build import mutated, read_sources  # noqa: E402
from mutation.mutants import Mutant, StaleList, choose, kept_mutants, kept_site, shuffled_candidates  # noqa: E402
from mutation.source import sites_of  # noqa: E402

compiler = sys.argv.pop(1)

CODE = """
constexpr int size = 2 + 1;
template <int n = 4 - 1>
constexpr int twice(int a) {
  return n - a * 2;  // not a - b
}
inline double at(const double* v, int i, int j) { return v[2 * i + j] - v[0] * 0.5; }
inline double value(const double* v, int n) {
  static_assert(size == 3);
  double sum = -v[1] * 3;
  for (int i = 0; i < n; ++i) sum += i <= 1 ? v[i] : -2.5;
  sum -= twice(n) + at(v, 0, 1);
  if constexpr (size > 2) sum = 10 - sum - 1;
  return n == 3 && sum >= 1 ? sum : 2 * -sum + 1 - 3 * v[2];
}
"""


class Sites(unittest.TestCase):
    def test_code_that_is_computed_while_compiling_is_left_alone(self):
        lines = {CODE[:site.begin].count("\n") for site in sites_of(CODE)}
        self.assertFalse(lines & {1, 2, 8})
        self.assertEqual(lines & {4, 6, 9, 10, 11, 12, 13}, {4, 6, 9, 10, 11, 12, 13})

    def test_comments_strings_templates_and_declarations_are_no_sites(self):
        for code in ('// a - b\n', '/* a < b */', 'const char* s = "a - b";', 'std::string s = "a" + t;', "Vec<dim> x;",
                     "auto [a, b] = f;", "auto f = [i] { return i; };", "#define a b - c\n", "using T = V<n - 1>;",
                     "enum { a = b - 1 };", "i++;", "void f(int a, int b);", "std::max(a, b);", "x->y;"):
            self.assertEqual([code[s.begin:s.end] for s in sites_of(code)], [], code)

    def test_every_kind_is_found(self):
        kinds = {s.kind for s in sites_of("x = a - f(i, j) * v[0];\nif (a < b) c = v[i + 1];")}
        self.assertEqual(kinds, {"sign", "comparison", "index", "axis"})

    def test_one_build_holds_what_each_break_would_give(self):
        """With a mutant active the program prints what the program with that break in its text prints."""
        mutants = [Mutant(f"r{k}", k, "f", CODE, site) for k, site in enumerate(sites_of(CODE))]
        chosen = []  # sites may be alternatives to each other
        for mutant in mutants:
            if not any(mutant.site.overlaps(other.site) for other in chosen):
                chosen.append(mutant)
        self.assertGreater(len(chosen), 20)
        header = Path("scripts/mutation/mutants.h").resolve()
        broken = [CODE[:m.site.begin] + m.site.broken + CODE[m.site.end:] for m in chosen]
        spaces = [mutated(CODE, chosen), *broken]
        program = f'#include "{header}"\n#include <cstdio>\n#include <cstdlib>\n' + "".join(
            f"namespace v{k} {{ {code} }}\n" for k, code in enumerate(spaces))
        calls = "".join(f"case {k}: std::printf(\"%.17g %.17g\\n\", v{k}::value(v, 3), v{k}::value(v, 2)); break;\n"
                        for k in range(len(spaces)))
        program += ("int main(int, char** arguments) {\n  const double all[] = {9, 8, 7, 1.5, -0.25, 0.75, 4, 3, 2};\n"
                    f"  const double* v = all + 3;\n  switch (std::atoi(arguments[1])) {{\n{calls}  }}\n}}\n")
        with tempfile.TemporaryDirectory() as folder:
            source, binary = Path(folder) / "a.cc", Path(folder) / "a"
            source.write_text(program)
            subprocess.run([compiler, "-std=c++20", "-w", source, "-o", binary], check=True)

            def printed(space, active):
                environment = {**os.environ, "WHEELWRIGHT_MUTANT": str(active)}
                return subprocess.run([binary, str(space)], env=environment, capture_output=True, text=True,
                                      check=True).stdout

            sound = printed(0, -1)
            differing = 0
            for k, mutant in enumerate(chosen):
                self.assertEqual(printed(0, mutant.number), printed(k + 1, -1), mutant.change())
                differing += printed(0, mutant.number) != sound
            self.assertGreater(differing, 0.8 * len(chosen))


class Choice(unittest.TestCase):
    def test_a_seed_gives_the_same_breaks_and_another_gives_others(self):
        texts = {"a": CODE, "b": CODE.replace("value", "other")}

        def names(seed):
            return [m.place() + m.change() for m in shuffled_candidates(texts, seed)]

        self.assertEqual(names(1), names(1))
        self.assertNotEqual(names(1), names(2))
        self.assertEqual(sorted(names(1)), sorted(names(2)))

    def test_chosen_breaks_stand_apart_and_refused_ones_are_replaced(self):
        candidates = shuffled_candidates({"a": CODE}, 1)
        first = choose(candidates, 8, [], set())
        again = choose(candidates, 8, [], {first[0].name})
        self.assertEqual(len(again), 8)
        self.assertNotIn(first[0], again)
        for chosen in (first, again):
            for a in chosen:
                self.assertFalse([b for b in chosen if b is not a and a.site.overlaps(b.site)])


class TheList(unittest.TestCase):
    def test_every_break_of_the_list_fits_the_sources(self):
        self.assertGreaterEqual(len(kept_mutants(Path("tests/mutations"), read_sources(Path.cwd()))), 40)

    def test_code_that_is_gone_or_not_unique_is_an_error(self):
        for old in ("no such code", "v[i]"):
            with self.assertRaises(StaleList):
                kept_site({"file": "a", "old": old, "new": "1"}, "x = v[i] + v[i];")

    def test_code_that_no_other_code_can_replace_is_an_error(self):
        text = "double x = a.b(1, 2) * f({c, d}), y = e;"
        for old in ("b(1, 2)", "{c, d}", "1, 2", "a.b(1, 2) *", "f({c", "x = a.b(1, 2)"):
            with self.assertRaises(StaleList):
                kept_site({"file": "a", "old": old, "new": "1"}, text)
        for old in ("a.b(1, 2)", "f({c, d})"):
            self.assertEqual(kept_site({"file": "a", "old": old, "new": "3"}, text).begin, text.index(old))

    def test_code_that_cannot_stand_in_braces_is_an_error(self):
        for old in ("double y = 0;", "const auto z = f(1);", "g(y);", "LevelSet<dim> result = psi;"):
            with self.assertRaises(StaleList):
                kept_site({"file": "a", "old": old, "new": ""},
                          "double y = 0; const auto z = f(1); LevelSet<dim> result = psi; x = g(y);")
        self.assertTrue(kept_site({"file": "a", "old": "g(y);", "new": ""}, "double y = 0; g(y);"))

    def test_code_whose_operand_belongs_to_an_operator_beside_it_is_an_error(self):
        for old, text in (("x += a", "x += a * b;"), ("a + b", "y = a + b * c;"), ("a + b", "y = d - a + b;"),
                          ("*a / b", "y = d * *a / b;")):
            with self.assertRaises(StaleList):
                kept_site({"file": "a", "old": old, "new": "1"}, text)
        for old, text in (("a * b", "y = d - a * b + c;"), ("f<dim>(a, b)", "y = -f<dim>(a, b);"), ("a + b", "f(a + b, c);"),
                          ("-a * b", "y = -a * b;")):
            self.assertTrue(kept_site({"file": "a", "old": old, "new": "1"}, text))

    def test_half_of_a_choice_is_an_error(self):
        for old in ("a ? b", "b : c"):
            with self.assertRaises(StaleList):
                kept_site({"file": "a", "old": old, "new": "1"}, "x = f(a ? b : c);")

    def test_code_that_stands_twice_is_told_apart_by_what_is_around_it(self):
        text = "x = v[i] - v[i] * 2;"
        site = kept_site({"file": "a", "old": "v[i]", "new": "0", "in": "v[i] * 2"}, text)
        self.assertEqual((site.begin, site.end), (11, 15))

    def test_lines_may_be_broken_otherwise(self):
        site = kept_site({"file": "a", "old": "a + b;", "new": ""}, "{\n  a +\n  b;\n}")
        self.assertEqual((site.begin, site.end), (4, 12))


if __name__ == "__main__":
    unittest.main()
