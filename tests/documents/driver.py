"""Runs the Python blocks of one document: reads requests from standard input, a line of JSON each.

A request has the `code`, its `document`, the `line` where it begins, and the file for its `output`.
The answer, a line on the original standard output, says whether it ran to its end.
"""

import json
import os
import sys
import traceback


def main():
    answers = os.fdopen(os.dup(1), "w")
    requests = os.fdopen(os.dup(0))
    os.dup2(os.open(os.devnull, os.O_RDONLY), 0)
    # Modules beside the documents' own files, as in an interactive session.
    sys.path[0] = ""
    names = {"__name__": "__main__"}
    for line in requests:
        request = json.loads(line)
        output = os.open(request["output"], os.O_WRONLY | os.O_CREAT | os.O_TRUNC, 0o600)
        os.dup2(output, 1)
        os.dup2(output, 2)
        os.close(output)
        ended = run(request, names)
        sys.stdout.flush()
        sys.stderr.flush()
        answers.write(json.dumps(ended) + "\n")
        answers.flush()


def run(request, names):
    """Whether the code ran to its end; if not, prints why."""
    # Lines are counted as in the document.
    code = "\n" * (request["line"] - 1) + request["code"]
    try:
        exec(compile(code, request["document"], "exec"), names)
        return True
    except BaseException:
        traceback.print_exc()
        return False


main()
