"""Compares what a command prints with what a document shows."""

import re


def matches(expected, found):
    """Whether `found` is what a document shows.

    `...` stands for anything within a line, or as a line for any number of lines. A line that
    begins with more spaces than the line before may continue it: documents wrap long lines. The
    number of spaces between words does not count.
    """
    return re.fullmatch(pattern(expected), "\n" + tidy(found)) is not None


def pattern(expected):
    """A pattern in which each line begins with its line break."""
    parts, indent = [], 0
    for line in tidy(expected).split("\n"):
        deeper = len(line) - len(line.lstrip(" "))
        if line.strip() == "...":
            parts.append(r"(?:\n[^\n]*)*?")
            continue
        parts.append(r"\s+" if deeper > indent and parts else r"\n *")
        pieces = [words(piece) for piece in line.strip().split("...")]
        parts.append(r"[^\n]*?".join(pieces))
        indent = deeper
    return "".join(parts) + r"\s*"


def words(text):
    """A pattern for words with any number of spaces in between."""
    return " +".join(re.escape(word) for word in re.split(" +", text))


def tidy(text):
    """The lines without spaces at their ends, and without empty ones before and behind."""
    return "\n".join(line.rstrip() for line in text.split("\n")).strip("\n")
