"""The code blocks of a Markdown document, and what their markers ask for."""

import re
from dataclasses import dataclass, field

LANGUAGES = {"sh", "python", "rust", "pbrt", "json", "text"}
COMMANDS = {"sh", "python"}
FENCE = re.compile(r"( *)(`{3,}(?=[^`]*$)|~{3,})[ \t]*(.*)")
# Blocks in quotations, behind the mark of a list, and in HTML: nothing reads these here.
HIDDEN = re.compile(r"[ >*+\-\d.)\t]*(?:`{3,}[^`]*|~{3,}.*|<pre\b.*)")
COMMENT = re.compile(r"\s*<!--\s*(.*?)\s*-->\s*")
ITEM = re.compile(r"( *(?:[-*+]|\d+[.)]) +)\S")
# A marker, and whether something has to follow its name.
MARKERS = {"file": True, "output": False, "not run": True, "in a clone": False}


@dataclass
class Block:
    """A fenced block; `line` is that of its first line of text, from 1."""

    document: str
    line: int
    language: str
    text: str
    marker: str = ""
    argument: str = ""
    # The block of commands whose output this one shows.
    shows: "Block | None" = field(default=None, repr=False)

    @property
    def place(self):
        return f"{self.document}:{self.line}"

    @property
    def action(self):
        """What happens with the block: one of the words that the last lines of a run count."""
        if self.reason:
            return "not run"
        if self.marker == "file":
            return "file"
        if self.marker == "output":
            return "compared"
        return {"rust": "rust", "text": "text"}.get(self.language, "run")

    @property
    def reason(self):
        """Why a block is not run, or an output not compared; empty for others."""
        if self.shows:
            return self.shows.reason
        return self.argument if self.marker == "not run" else ""


class Reader:
    """Reads a document line by line, and collects blocks and mistakes."""

    def __init__(self, document, text):
        self.document, self.lines = document, text.splitlines()
        self.blocks, self.mistakes = [], []
        # Columns at which the text of the list item begins that a line may belong to.
        self.item = 0
        # The last block of commands; None behind a heading.
        self.commands = None

    def wrong(self, line, message):
        self.mistakes.append(f"{self.document}:{line}: {message}")

    def read(self):
        number = 0
        while number < len(self.lines):
            fence = FENCE.fullmatch(self.lines[number])
            if fence:
                number = self.fenced(number, fence)
            else:
                self.prose(number)
                number += 1
        return self.blocks, self.mistakes

    def prose(self, number):
        """A line outside of blocks: finds indented code, lists, headings and lost markers."""
        line, before = self.lines[number], self.lines[number - 1] if number else ""
        if not line.strip():
            return
        indent = len(line) - len(line.lstrip(" "))
        item = ITEM.match(line)
        if indent < self.item:
            self.item = 0
        starts = not before.strip() or before.startswith("#")
        if starts and (indent >= self.item + 4 or line.startswith("\t")):
            self.wrong(number + 1, "indented code: use a fence with a language")
        elif item:
            self.item = len(item[1])
        if HIDDEN.fullmatch(line):
            self.wrong(number + 1, "a block begins within a line: give its fence a line of its own")
        if line.startswith("#"):
            self.commands = None
        comment = COMMENT.fullmatch(line)
        after = self.lines[number + 1] if number + 1 < len(self.lines) else ""
        if comment and marker_of(comment[1]) and not FENCE.fullmatch(after):
            self.wrong(number + 1, f"no block follows the marker `{comment[1]}`")

    def fenced(self, number, fence):
        """Reads the block whose fence is in line `number`; returns the line behind it."""
        indent, ticks, language = len(fence[1]), fence[2], fence[3].strip()
        closing = re.compile(rf" *{ticks[0]}{{{len(ticks)},}} *")
        end = number + 1
        while end < len(self.lines) and not closing.fullmatch(self.lines[end]):
            end += 1
        if end == len(self.lines):
            self.wrong(number + 1, "the block has no end")
        content = [re.sub(rf"^ {{0,{indent}}}", "", line) for line in self.lines[number + 1 : end]]
        block = Block(self.document, number + 2, language, "".join(f"{line}\n" for line in content))
        comment = COMMENT.fullmatch(self.lines[number - 1]) if number else None
        if comment:
            block.marker, block.argument = marker_of(comment[1]) or (comment[1], "")
        self.add(block)
        return end + 1

    def add(self, block):
        mistake = self.mistake_of(block)
        if mistake:
            self.wrong(block.line - 1, mistake)
        else:
            self.blocks.append(block)
        if block.marker == "output":
            block.shows = self.commands
        if block.marker != "file":
            self.commands = block if block.language in COMMANDS else None

    def mistake_of(self, block):
        """What is wrong with a block and its marker; None if nothing is."""
        language, marker = block.language, block.marker
        if language not in LANGUAGES:
            known = ", ".join(sorted(LANGUAGES))
            return f"`{language or 'no language'}`: expected one of {known} behind the fence"
        if marker and marker not in MARKERS:
            return f"unknown marker `{marker}`: expected one of {', '.join(MARKERS)}"
        if marker and MARKERS[marker] != bool(block.argument):
            needs = "needs" if MARKERS[marker] else "takes no"
            return f"the marker `{marker}` {needs} text behind it"
        if marker == "output" and (language != "text" or not self.commands):
            return "an output is a `text` block behind a block of `sh` or `python`"
        if marker == "in a clone" and language != "sh":
            return "only `sh` runs in a clone"
        if not marker and language in {"json", "pbrt"}:
            return f"nothing reads this `{language}`: name its file, `<!-- file: NAME -->`"
        if not marker and language == "text" and self.commands:
            return "this `text` follows commands: mark it as their output, `<!-- output -->`"
        return None


def marker_of(comment):
    """The name of a marker and the text behind it; None for other comments."""
    for name in MARKERS:
        if comment == name or comment.startswith(f"{name}:"):
            return name, comment[len(name) + 1 :].strip()
    return None
