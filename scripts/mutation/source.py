"""Where the code of a C++ file can be broken, without a compiler: by its tokens and by how clang-format spaces them."""

import re

TOKEN = re.compile(
    r"""(?P<skip>//[^\n]*|/\*.*?\*/|\#(?:[^\n\\]|\\.)*|R"\((?:.*?)\)"|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)+')
      |(?P<word>[A-Za-z_]\w*)
      |(?P<number>\.?\d(?:[eE][+-]|[\w.'])*)
      |(?P<mark><<=|>>=|<=>|->\*|\.\.\.|<<|>>|<=|>=|==|!=|&&|\|\||\+\+|--|\+=|-=|\*=|/=|%=|\^=|->|::|.)""",
    re.VERBOSE | re.DOTALL)


class Token:
    def __init__(self, match):
        self.text, self.begin, self.end = match[0], match.start(), match.end()
        self.is_name = match.lastgroup == "word"
        self.is_number = match.lastgroup == "number"


def tokens_of(text):
    return [Token(m) for m in TOKEN.finditer(text) if m.lastgroup != "skip" and not m[0].isspace()]


def line_of(text, offset):
    return text.count("\n", 0, offset) + 1


class Site:
    """A piece of code, how it reads when it is broken, and the code that is the one or the other."""

    def __init__(self, kind, begin, end, broken, guarded):
        self.kind, self.begin, self.end, self.broken = kind, begin, end, broken
        self.guarded = guarded  # with @ for the mutant's number

    def overlaps(self, other):
        return self.begin < other.end and other.begin < self.end


NAMESPACE = "::wheelwright_mutants::"
COMPARISONS = {"<": ("<=", ">"), ">": (">=", "<"), "<=": ("<", ">="), ">=": (">", "<=")}
COMPARISON_CODES = {"<": "<", ">": ">", "<=": "l", ">=": "g"}
SYMMETRIC = {"max", "min", "hypot", "minmax", "swap", "dot", "if", "while", "for", "switch", "return", "sizeof",
             "decltype", "operator", "lerp", "power", "defined"}
SIMPLE = re.compile(r"[A-Za-z_][\w.]*(?: [+*-] [A-Za-z_0-9][\w.]*)*")


def spaced(text, token):
    return text[token.begin - 1].isspace() and text[token.end:token.end + 1].isspace()


def joins_text(text, token):
    """Whether one of the operands is a literal string."""
    return text[:token.begin].rstrip().endswith('"') or text[token.end:].lstrip().startswith('"')


def constant_ranges(text, tokens):
    """Code that is computed while compiling: nothing can be broken there at run time."""
    ranges = []
    for k, token in enumerate(tokens):
        if token.text == "template" and tokens[k + 1].text == "<":
            level, j = 0, k + 1
            while True:
                level += {"<": 1, ">": -1, ">>": -2}.get(tokens[j].text, 0)
                if level <= 0:
                    break
                j += 1
            ranges.append((token.begin, tokens[j].end))
        elif token.text in ("static_assert", "decltype", "noexcept", "requires", "sizeof", "alignas") or (
                token.text == "constexpr" and tokens[k - 1].text == "if"):
            if tokens[k + 1].text == "(":
                ranges.append((token.begin, tokens[closing(tokens, k + 1)].end))
        elif token.text in ("constexpr", "constinit", "enum", "using", "case"):
            ranges.append((token.begin, end_of_constant(tokens, k)))
    return ranges


def closing(tokens, k):
    """The bracket that closes the one at k."""
    pairs = {"(": ")", "[": "]", "{": "}"}
    opening, close, level = tokens[k].text, pairs[tokens[k].text], 0
    for j in range(k, len(tokens)):
        level += (tokens[j].text == opening) - (tokens[j].text == close)
        if level == 0:
            return j
    raise ValueError(f"{opening} is not closed")


def end_of_constant(tokens, k):
    """The end of a constexpr variable, an enumeration or an alias; only the head of a constexpr function, whose
    body runs at run time too."""
    j = k
    while j < len(tokens):
        if tokens[j].text == ";":
            return tokens[j].end
        if tokens[j].text == ":" and tokens[k].text == "case":
            return tokens[j].end
        if tokens[j].text in "([":
            j = closing(tokens, j)
        elif tokens[j].text == "{":
            if tokens[k].text == "constexpr" and tokens[j - 1].text in (")", "const", "noexcept", "override"):
                return tokens[j].begin
            j = closing(tokens, j)
        j += 1
    return tokens[-1].end


def sign_sites(text, tokens):
    for k in range(1, len(tokens) - 1):
        token, before = tokens[k], tokens[k - 1]
        mark, begin, end = token.text, token.begin, token.end
        if joins_text(text, token):
            continue
        if mark in "+-" and spaced(text, token):
            name, other = ("Plus", "-") if mark == "+" else ("Minus", "+")
            yield Site("sign", begin, end, other, f"{mark} {NAMESPACE}{name}{{@}} {mark}")
        elif mark in ("+=", "-="):
            name, other = ("AddTo", "-=") if mark == "+=" else ("TakeFrom", "+=")
            yield Site("sign", begin, end, other, f"{mark} {NAMESPACE}{name}{{@}} ^=")
        elif mark == "-" and not text[end].isspace() and before.text in ("(", ",", "=", "return", "[", "{", "?",
                                                                          ":", "&&", "||", "+", "*", "<", ">"):
            yield Site("sign", begin, end, "", f"{NAMESPACE}Negative{{@}} *")
        elif mark in COMPARISONS and spaced(text, token):
            for other in COMPARISONS[mark]:
                yield Site("comparison", begin, end, other,
                           f"{mark} {NAMESPACE}Compare{{@, '{COMPARISON_CODES[other]}'}} {mark}")
        elif mark in ("==", "!=") and spaced(text, token) and before.text != "operator":
            name, other = ("Equal", "!=") if mark == "==" else ("NotEqual", "==")
            yield Site("comparison", begin, end, other, f"{mark} {NAMESPACE}{name}{{@}} {mark}")


def subscript_sites(text, tokens):
    for k in range(1, len(tokens) - 2):
        if tokens[k].text != "[" or text[tokens[k].begin - 1].isspace() or not (
                tokens[k - 1].is_name or tokens[k - 1].text in ")]"):
            continue
        last = closing(tokens, k)
        begin, end = tokens[k].end, tokens[last].begin
        inner = text[begin:end]
        if not inner or inner[0] in "&=[\"" or "\n" in inner:
            continue
        changes = []
        if inner in ("0", "1", "2"):
            changes = [("axis", {"0": "1", "1": "0", "2": "0"}[inner])]
        elif inner in ("d", "axis", "i", "j", "k", "a", "b"):
            changes = [("axis", "0"), ("index", f"{inner} + 1")]
        elif not tokens[k + 1].is_number or last > k + 2:
            changes = [("index", f"{inner} + 1"), ("index", f"{inner} - 1")]
        for kind, broken in changes:
            yield Site(kind, begin, end, broken, f"{NAMESPACE}broken(@) ? ({broken}) : ({inner})")


def argument_sites(text, tokens):
    """Two simple arguments, swapped."""
    for k in range(1, len(tokens) - 2):
        if tokens[k].text != "(" or not tokens[k - 1].is_name or tokens[k - 1].text in SYMMETRIC or text[
                tokens[k].begin - 1].isspace():
            continue
        last = closing(tokens, k)
        begin, end = tokens[k].end, tokens[last].begin
        parts = text[begin:end].split(", ")
        if len(parts) != 2 or parts[0] == parts[1] or not all(SIMPLE.fullmatch(part) for part in parts):
            continue
        first, second = parts
        choice = NAMESPACE + "broken(@) ? "
        yield Site("index", begin, end, f"{second}, {first}",
                   f"{choice}({second}) : ({first}), {choice}({first}) : ({second})")


def sites_of(text):
    """All places that may be broken at random, in the order of the file."""
    tokens = tokens_of(text)
    constants = constant_ranges(text, tokens)
    found = [*sign_sites(text, tokens), *subscript_sites(text, tokens), *argument_sites(text, tokens)]
    return sorted((s for s in found if not any(a <= s.begin < b for a, b in constants)),
                  key=lambda s: (s.begin, s.end, s.broken))
