"""Tests of the runner: each mistake in a document is found, with its line."""

import sys
import tempfile
import unittest
from pathlib import Path

from blocks import Reader
from document import run_document
from outputs import matches
from sandbox import Sandbox
from shell import commands_of



def read(text):
    return Reader("doc.md", text).read()


def block(language, text, marker=""):
    return (f"<!-- {marker} -->\n" if marker else "") + f"```{language}\n{text}\n```\n\n"


class Blocks(unittest.TestCase):
    """Every block is found, and none escapes."""

    def mistake(self, text, line, words):
        _, mistakes = read(text)
        self.assertEqual(len(mistakes), 1, mistakes)
        self.assertTrue(mistakes[0].startswith(f"doc.md:{line}: "), mistakes)
        self.assertIn(words, mistakes[0])

    def test_blocks_and_lines(self):
        text = "# A\n\n" + block("sh", "feimos -h", "in a clone") + block("text", "...", "output")
        blocks, mistakes = read(text)
        self.assertEqual(mistakes, [])
        self.assertEqual([(b.line, b.action) for b in blocks], [(5, "run"), (10, "compared")])
        self.assertIs(blocks[1].shows, blocks[0])

    def test_blocks_in_lists(self):
        blocks, mistakes = read("- item\n\n  more\n\n  ```sh\n  a\n    b\n  ```\n")
        self.assertEqual((blocks[0].text, mistakes), ("a\n  b\n", []))
        self.assertEqual(read("```a``` is code in a line, as is ```` ``` ````\n"), ([], []))
        self.assertEqual(read("1. item\n\n   more\n\n      deep\n"), ([], []))

    def test_mistakes(self):
        self.mistake("a\n\n    feimos\n", 3, "indented code")
        self.mistake("- a\n\nb\n\n    feimos\n", 5, "indented code")
        self.mistake("# a\n    feimos\n", 2, "indented code")
        self.mistake("> ```sh\n", 1, "within a line")
        self.mistake("- ~~~ sh\n", 1, "within a line")
        self.mistake("<pre>\n", 1, "within a line")
        self.mistake("```\na\n```\n", 1, "no language")
        self.mistake("```bash\na\n```\n", 1, "`bash`")
        self.mistake("```sh\na\n", 1, "no end")
        self.mistake(block("sh", "a", "not ran: x"), 2, "unknown marker")
        self.mistake(block("sh", "a", "not run"), 2, "needs text")
        self.mistake("<!-- output -->\n\n" + block("sh", "a"), 1, "no block follows")
        self.mistake(block("sh", "a") + block("text", "b"), 5, "mark it")
        self.mistake(block("text", "b", "output"), 2, "an output is")
        self.mistake(block("json", "{}"), 1, "nothing reads")
        self.mistake(block("python", "a", "in a clone"), 2, "only `sh`")

    def test_outputs_of_what_is_not_run(self):
        blocks, _ = read(block("sh", "a", "not run: why") + block("text", "b", "output"))
        self.assertEqual([b.reason for b in blocks], ["why", "why"])


class Outputs(unittest.TestCase):
    def test_equal_outputs(self):
        for expected, found in [
            ("a  b\nc\n", "a b  \nc\n\n"),
            ("a ... c\n", "a b c\n"),
            ("a...\n", "a\n"),
            ("...\nb\n...\n", "a\na\nb\nc\n"),
            ("...\nb\n...\n", "b\n"),
            ("a\n...\nd\n", "a\nd\n"),
            ("a b\n    c d\n", "a b c d\n"),
            ("1.99...)\n", "1.990001)\n"),
            ("...\n", ""),
            ("a\n  b\n", "a\n  b\n"),
        ]:
            self.assertTrue(matches(expected, found), (expected, found))

    def test_other_outputs(self):
        for expected, found in [
            ("a\n", "b\n"),
            ("a\n", "a\nb\n"),
            ("a\nb\n", "a b\n"),
            ("a ... d\n", "a b\nc d\n"),
            ("...\nb\n", "a\nb\nc\n"),
            ("ab\n", "a b\n"),
            ("a.c\n", "abc\n"),
            ("a\n", ""),
        ]:
            self.assertFalse(matches(expected, found), (expected, found))


class Commands(unittest.TestCase):
    def test_whole_commands(self):
        text = "# c\na\nb \\\n  c\ncat <<'E' > x\nif\nE\nfor i in 1; do\n  d\ne; done\n"
        text += "'f\ng' |\n  h\n"
        self.assertEqual([command.line for command in commands_of(text)], [0, 2, 4, 7, 10])

    def test_wrong_syntax(self):
        with self.assertRaises(ValueError):
            commands_of("a\nif b; then\n")


class Documents(unittest.TestCase):
    """Documents that are run, in their sandboxes."""

    def run_text(self, text, seconds=20):
        blocks, mistakes = read(text)
        self.assertEqual(mistakes, [])
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder).resolve() / "sandbox"
            sandbox = Sandbox(root, Path("/bin/echo"), sys.executable, False)
            failures = run_document(blocks, sandbox, seconds)
            self.left_out = sandbox.commands_left_out()
            return failures

    def passes(self, *blocks):
        self.assertEqual(self.run_text("".join(blocks)), [])

    def fails(self, place, words, *blocks, **limits):
        failures = self.run_text("".join(blocks), **limits)
        self.assertEqual(len(failures), 1, failures)
        self.assertTrue(failures[0].startswith(f"doc.md:{place}: "), failures)
        for word in words:
            self.assertIn(word, failures[0])

    def test_a_document_that_is_right(self):
        self.passes(
            block("json", "[1, 2]", "file: sub/a.json"),
            block("sh", "echo before\nx=3\nfeimos $x $(cat sub/a.json)"),
            block("text", "3 [1, 2]", "output"),
            block("python", "import json\nn = json.load(open('sub/a.json'))"),
            block("sh", "echo 5 > five"),
            block("python", "print(sum(n), open('five').read())"),
            block("text", "3 5", "output"),
        )

    def test_a_wrong_output(self):
        shown = block("text", "b", "output")
        self.fails(7, ["expected", "b", "printed", "a"], block("sh", "echo a"), shown)

    def test_commands_that_fail(self):
        failing, later = block("sh", "echo yes\n(echo no; exit 3)\necho"), block("sh", "echo")
        words = ["exit code 3", "$ (echo no; exit 3)", "    no", "1 later block"]
        self.fails(3, words, failing, later)
        self.fails(2, ["unbound"], block("sh", "echo $unbound"))
        self.fails(2, ["exit code 1"], block("sh", "false | cat"))
        self.fails(2, ["time limit"], block("sh", "sleep 60"), seconds=0.5)

    def test_python_that_fails(self):
        self.fails(3, ["line 4", "KeyError"], "\n", block("python", "a = {}\na['b']"))
        self.fails(2, ["Python ended"], block("python", "while True: pass"), seconds=1)
        self.fails(2, ["exit code 7"], block("python", "import os\nos._exit(7)"))

    def test_files_stay_within_the_folder(self):
        self.fails(4, ["outside"], "\n", block("json", "1", "file: ../a.json"))
        self.passes(block("sh", 'case "$HOME $TMPDIR" in *box/home*box/tmp*) ;; *) false ;; esac'))
        self.passes(block("sh", "test -z \"$(ls -A)\"\ntouch a ~/b"))

    def test_stand_ins(self):
        self.passes(
            block("sh", "pip install feimos\ncargo test\ncargo run --release -- render a"),
            block("text", "render a", "output"),
        )
        commands = [command for command, _ in self.left_out]
        expected = ["pip install feimos", "cargo test", "cargo run --release -- render a"]
        self.assertEqual(commands, expected)

    def test_clones(self):
        self.passes(
            block("sh", "git clone -q https://github.com/feimos/feimos\ntest -e feimos/Cargo.toml"),
            block("sh", "test -e Cargo.toml\ntouch ../mark", "in a clone"),
            block("sh", "test -e mark"),
        )


if __name__ == "__main__":
    unittest.main()
