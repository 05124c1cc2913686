"""The Python session of a document."""

import json
import os
import subprocess
import threading
from pathlib import Path

DRIVER = Path(__file__).with_name("driver.py")


class Session:
    """One process of Python, which keeps its names from block to block."""

    def __init__(self, sandbox):
        self.output = sandbox.outputs / "python"
        self.process = subprocess.Popen(
            [sandbox.python, DRIVER],
            cwd=sandbox.work,
            env=sandbox.environment,
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            text=True,
        )

    def run(self, block, seconds):
        """Returns whether the block ran to its end, and what it printed."""
        request = {"code": block.text, "document": block.document, "line": block.line}
        timer = threading.Timer(seconds, self.process.kill)
        timer.start()
        try:
            request["output"] = os.fspath(self.output)
            self.process.stdin.write(json.dumps(request) + "\n")
            self.process.stdin.flush()
            answer = self.process.stdout.readline()
        except BrokenPipeError:
            answer = ""
        finally:
            timer.cancel()
        printed = self.output.read_text(errors="replace") if self.output.exists() else ""
        if not answer:
            return False, printed + f"Python ended: exit code {self.process.wait()}\n"
        return json.loads(answer), printed

    def close(self):
        self.process.kill()
        self.process.communicate()
