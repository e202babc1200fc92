"""The breaks: those of a kept list, and random ones."""

import random
import re
from pathlib import Path

from .source import NAMESPACE, Site, line_of, sites_of, tokens_of


class Mutant:
    """One break of one file. `name` says which, e.g. k7 or r12; `number` is its number in the build; `reason` says
    why it matters, where somebody said so."""

    def __init__(self, name, number, file, text, site, reason=""):
        self.name, self.number, self.file, self.site, self.reason = name, number, file, site, reason
        self.line = line_of(text, site.begin)
        self.original = " ".join(text[site.begin:site.end].split())
        start = text.rfind("\n", 0, site.begin) + 1
        end = text.find("\n", site.end)
        self.code = text[start:end if end >= 0 else None].strip()

    def place(self):
        return f"{self.file}:{self.line}"

    def change(self):
        return f"{self.original!r} -> {self.site.broken!r} in: {' '.join(self.code.split())}"


class StaleList(Exception):
    """Breaks of the list that do not fit the sources."""


def entries_of(path):
    """The breaks of one file of the list: paragraphs of lines `key: value`."""
    for paragraph in re.split(r"\n\s*\n", path.read_text()):
        lines = [line for line in paragraph.splitlines() if line and not line.startswith("#")]
        if lines:
            entry = dict(line.split(":", 1) for line in lines)
            yield {key: value.strip() for key, value in entry.items()}


def pieces(code, text):
    """Where a piece of code stands in a text, however it is broken into lines."""
    return list(re.finditer(r"\s+".join(map(re.escape, code.split())), text))


def is_one_expression(code):
    """Whether brackets are closed and nothing but operands and operators stands outside them, as far as is told
    without a compiler."""
    depth = choices = 0
    for token in tokens_of(code):
        depth += (token.text in "([{") - (token.text in ")]}")
        if depth < 0 or (depth == 0 and token.text in (",", ";", "if", "return")):
            return False
        choices += depth == 0 and {"?": 1, ":": -1}.get(token.text, 0)
    return depth == 0 and choices == 0 and not code.startswith((".", "{")) and code[-1] not in "=+-*/%<>&|!?:.,"


DECLARATION = re.compile(r"(constexpr|const|auto|static|using)\b|(?!return|delete|throw)[\w:]+(<[^;=()]*>)?[&*]? \w+( =|;|\{)")


def is_one_statement(code, before):
    """Whether code that ends in a semicolon can stand in braces of its own: it declares nothing, and no longer statement
    ends with it."""
    return before.rstrip()[-1:] in ("", ";", "{", "}", ")", ":") and not DECLARATION.match(code)


OPERATORS = ("= += -= *= /= %= ? :", "||", "&&", "|", "^", "&", "== !=", "< > <= >=", "<< >>", "+ -", "* / %")
PRECEDENCE = {operator: level for level, operators in enumerate(OPERATORS) for operator in operators.split()}
UNARY = len(OPERATORS)
NO_OPERATOR = UNARY + 1


def is_operand(token):
    """Whether an operand ends with the token: what follows is a binary operator."""
    return token.is_name or token.is_number or token.text in ")]}"


def weakest_operator(code):
    """The precedence of the binary operator of an expression that is applied last. Spaces tell a comparison from the
    arguments of a template."""
    depth, weakest, before = 0, NO_OPERATOR, None
    for token in tokens_of(code):
        is_template = token.text in "<>" and " " not in code[token.begin - 1:token.end + 1]
        depth -= token.text in ")]}" or (is_template and token.text == ">")
        if depth == 0 and before and is_operand(before) and not is_template:
            weakest = min(weakest, PRECEDENCE.get(token.text, NO_OPERATOR))
        depth += token.text in "([{" or (is_template and token.text == "<")
        before = token
    return weakest


def loses_operand(code, before, after):
    """Whether an operator beside an expression takes one of its operands, so that the expression is none in itself."""
    weakest, last, following = weakest_operator(code), tokens_of(before)[-2:], tokens_of(after)[:1]
    left = right = -1
    if len(last) == 2:
        is_unary = last[1].text in "-!*&" and not is_operand(last[0])
        left = UNARY if is_unary else PRECEDENCE.get(last[1].text, -1)
    if following:
        right = PRECEDENCE.get(following[0].text, -1)
    return weakest < NO_OPERATOR and (0 < left and weakest <= left or weakest < right)


def declares(code, before):
    """Whether the code, with what stands before it, declares the variable that it assigns to."""
    return any(token.text == "=" for token in tokens_of(code)) and before.rstrip()[-1:] not in (";", "{", "}", ")")


def kept_site(entry, text):
    """Where the old code stands, once in the text, or once in the code `in` that stands there once. A statement ends in a
    semicolon, anything else is an expression."""
    old, new, around = entry["old"], entry["new"], entry.get("in", entry["old"])
    outer = pieces(around, text)
    inner = pieces(old, outer[0][0]) if len(outer) == 1 else outer
    if len(inner) != 1:
        raise StaleList(f"{entry['file']}: {'found more than once' if inner else 'not found'}: {old}")
    begin, end = (outer[0].start() + offset for offset in inner[0].span())
    if old.endswith(";"):
        if not is_one_statement(old, text[:begin]):
            raise StaleList(f"{entry['file']}: no statement that can stand in braces: {old}")
        guarded = f"if ({NAMESPACE}broken(@)) {{ {new} }} else {{ {text[begin:end]} }}"
    else:
        before = text[:begin]
        if loses_operand(old, before[-200:], text[end:end + 20]):
            raise StaleList(f"{entry['file']}: an operator beside it takes one of its operands: {old}")
        if not (is_one_expression(old) and is_one_expression(new)) or before.endswith((".", "->")) or declares(old, before):
            raise StaleList(f"{entry['file']}: no whole expression: {old}")
        guarded = f"({NAMESPACE}broken(@) ? ({new}) : ({text[begin:end]}))"
    return Site("kept", begin, end, new, guarded)


def kept_mutants(folder, texts):
    """The list, one mutant an entry; raises StaleList with all that does not fit."""
    mutants, problems = [], []
    for path in sorted(Path(folder).glob("*.txt")):
        for entry in entries_of(path):
            name = f"k{len(mutants) + len(problems) + 1}"
            try:
                if entry["file"] not in texts:
                    raise StaleList(f"{entry['file']}: no such file")
                text = texts[entry["file"]]
                mutant = Mutant(name, len(mutants), entry["file"], text, kept_site(entry, text), entry["why"])
                clash = [m for m in mutants if m.file == mutant.file and m.site.overlaps(mutant.site)]
                if clash:
                    raise StaleList(f"{entry['file']}: overlaps {clash[0].name}: {entry['old']}")
                mutants.append(mutant)
            except (StaleList, KeyError) as problem:
                problems.append(f"{path.name}: {problem}")
    if problems:
        raise StaleList("\n".join(problems))
    return mutants


FIRST_RANDOM = 1000  # above the numbers of the list
KINDS = ("sign", "comparison", "index", "axis")


def shuffled_candidates(texts, seed):
    """All random mutants in the order in which they are tried: the kinds take turns, so that none is rare."""
    queues = {kind: [] for kind in KINDS}
    for file in sorted(texts):
        for site in sites_of(texts[file]):
            queues[site.kind].append((file, site))
    generator = random.Random(seed)
    for kind in KINDS:
        generator.shuffle(queues[kind])
    result = []
    while any(queues.values()):
        for kind in KINDS:
            if queues[kind]:
                file, site = queues[kind].pop()
                n = len(result) + 1
                result.append(Mutant(f"r{n}", FIRST_RANDOM + n, file, texts[file], site))
    return result


def choose(candidates, number, taken, refused):
    """The first candidates that are not refused and stand apart from each other and from those that are taken."""
    chosen = []
    by_file = {}
    for mutant in taken:
        by_file.setdefault(mutant.file, []).append(mutant.site)
    for mutant in candidates:
        if len(chosen) == number:
            break
        sites = by_file.setdefault(mutant.file, [])
        if mutant.name in refused or any(mutant.site.overlaps(site) for site in sites):
            continue
        sites.append(mutant.site)
        chosen.append(mutant)
    return chosen
