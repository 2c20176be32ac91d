#!/usr/bin/env python3
"""Runs a refusal: NAME.prm is wrong, and the program must say exactly what is in NAME.output.

    run_case.py [--seconds LIMIT] NAME.prm PROGRAM...

It must exit with status 1, show nothing else on its standard output or error stream, and need no more than LIMIT seconds of processor
time (which, unlike wall time, does not depend on what else the machine does). When PROGRAM is started by mpirun, which adds
words of its own, the text must be there once. Comments at the top of NAME.prm may change what is run:

    # arguments: --set "Section/Entry = 1"      further arguments
    # file: absent.prm                          the parameter file to read instead of NAME.prm
"""

import argparse
import pathlib
import re
import resource
import shlex
import subprocess
import sys
import tempfile


def directive(text, name):
    match = re.search(rf"^# {name}: (.*)$", text, re.MULTILINE)
    return match.group(1) if match else ""


def check(case, program, seconds):
    text = case.read_text()
    arguments = shlex.split(directive(text, "arguments"))
    parameter_file = directive(text, "file") or case.name
    expected = case.with_suffix(".output").read_text()
    with tempfile.TemporaryDirectory() as folder:
        # If the program accepts the case against expectation, its results must
        # not land beside the case. The run is quiet, as output from before the
        # error (about the mesh, say) would be on standard output.
        arguments.append("--quiet")
        if "--output" not in arguments:
            arguments += ["--output", f"{folder}/output"]
        run = subprocess.run([*program, *arguments, parameter_file], cwd=case.parent, capture_output=True, text=True, timeout=60,
                             check=False)
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    used = usage.ru_utime + usage.ru_stime
    by_mpirun = len(program) > 1

    mistakes = []
    if not expected.startswith("corotet: error: ") or expected.count("\n") != 1:
        mistakes.append("the expected text must be one line that starts with 'corotet: error: '")
    if run.returncode != 1:
        mistakes.append(f"the exit status is {run.returncode}, not 1")
    if by_mpirun and run.stderr.count(expected) != 1 or not by_mpirun and run.stderr != expected:
        mistakes.append(f"expected on standard error:\n{expected}found:\n{run.stderr}")
    if run.stdout and not by_mpirun:
        mistakes.append(f"nothing is expected on standard output, found:\n{run.stdout}")
    if used > seconds and not by_mpirun:
        mistakes.append(f"it took {used:.2f} s of processor time; {seconds} s are allowed")
    return mistakes


parser = argparse.ArgumentParser()
parser.add_argument("--seconds", type=float, default=2)
parser.add_argument("case", type=pathlib.Path)
parser.add_argument("program", nargs=argparse.REMAINDER)
options = parser.parse_args()
found = check(options.case.resolve(), options.program, options.seconds)
print("\n".join(found))
sys.exit(1 if found else 0)
