#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""Restarts at random, more of them than a test has time for; what is checked is in checkpoints.py.

    restarts.py --kills N      kills runs of all kinds until there were so many kills; restarts them
    restarts.py --damages N    damages that many checkpoints, one at a time
    restarts.py --stops N      sends SIGTERM to that many runs, and measures how long they take to end
    restarts.py --seed S ...   other moments and places

The environment is that of the test (COROTET_PROGRAM, COROTET_MPIRUN).
"""

import argparse
import collections
import os
import pathlib
import random
import re
import shutil
import signal
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))

from checkpoints import KINDS, Checkpoints, Run, rows_without_time
from support import read_history


def kill_many(test, n):
    """Kills runs of all kinds on 1, 2 and 4 ranks until there were n kills."""
    counts = collections.Counter()
    references = {}
    number = 0
    try:
        while sum(counts.values()) < n:
            kind, ranks = random.choice(list(KINDS)), random.choice((1, 1, 1, 2, 2, 4))
            # On several ranks the factorisation of Trilinos gives other last
            # digits each time, also in undisturbed runs.
            if ranks > 1 and KINDS[kind].get("Linear solver/Type") == "direct":
                continue
            if (kind, ranks) not in references:
                references[kind, ranks] = test.undisturbed(kind, ranks)
            moments = [random.uniform(0.1, 1.1) for _ in range(random.choice((1, 1, 2, 3)))]
            number += 1
            counts[kind, ranks] += test.kill_and_restart(kind, *references[kind, ranks], moments, f"run {number}")
            print(f"{sum(counts.values())} kills, {number} runs", end="\r", flush=True)
    finally:
        print(f"{sum(counts.values())} kills in {number} runs")
        for (kind, ranks), count in sorted(counts.items()):
            print(f"{kind:20} {ranks} ranks: {count}")


def damage_many(test, n):
    """Damages the newest checkpoint of a run and restarts it, n times."""
    kind = "generalized-alpha"
    reference, _ = test.undisturbed(kind)
    whole = Run(test.folder / "whole", kind, 1)
    test.stop_at(whole, 24)
    newest = sorted((whole.output / "checkpoint").glob("*.json"))[-1].stem
    files = {suffix: (whole.output / "checkpoint" / f"{newest}{suffix}").read_bytes() for suffix in (".json", ".h5")}
    counts = collections.Counter()
    for number in range(n):
        suffix = random.choice(list(files))
        data = bytearray(files[suffix])
        what = random.choice(("bit", "byte", "end", "hole"))
        place = random.randrange(len(data))
        if what == "bit":
            data[place] ^= 1 << random.randrange(8)
        elif what == "byte":
            data[place] = (data[place] + random.randrange(1, 256)) % 256
        elif what == "end":
            del data[place:]
        else:
            hole = data[place:place + 512]
            data[place:place + 512] = bytes(len(hole))
        if data == files[suffix]:
            continue
        run = Run(test.folder / f"damage_{number}", kind, 1)
        shutil.copytree(whole.output, run.output)
        (run.output / "checkpoint" / f"{newest}{suffix}").write_bytes(data)
        status, out, errors = run.finish("--restart")
        test.assertEqual((status, errors), (0, ""), f"{suffix} {what} {place}: {out}")
        test.assertIn(f"warning: run/checkpoint/{newest}", out, f"{suffix} {what} {place}")
        test.assertEqual(rows_without_time(run.output), rows_without_time(reference.output), f"{suffix} {what} {place}")
        shutil.rmtree(run.folder)
        counts[what] += 1
    print(f"{sum(counts.values())} damaged checkpoints: all named, the one before used (" + ", ".join(
        f"{count} {what}" for what, count in sorted(counts.items())) + ")")


def stop_many(test, n):
    """Sends SIGTERM to a rank of long runs of all kinds on 1 and 2 ranks, at random moments after their first checkpoint."""
    longest = 0
    for number in range(n):
        kind = list(KINDS)[number % len(KINDS)]
        long = {"Time integration/static/Load steps": "100000"} if kind == "static" else {"Time integration/End time": "1e4"}
        run = Run(test.folder / f"stop_{number}", kind, 1 + number // len(KINDS) % 2, long)
        process = run.start()
        while process.poll() is None and not list((run.output / "checkpoint").glob("*.json")):
            time.sleep(0.01)
        time.sleep(random.uniform(0, 0.5))
        start = time.monotonic()
        os.kill(run.processes()[-1], signal.SIGTERM)
        _, errors = process.communicate(timeout=60)
        longest = max(longest, time.monotonic() - start)
        test.assertEqual(process.returncode, 4, f"{kind}: {errors}")
        # The last row is that of the saved state.
        step = re.search(r"stopped: step (\d+) .*SIGTERM; the run is saved", errors).group(1)
        test.assertTrue(list((run.output / "checkpoint").glob(f"*_{int(step):06}.json")), f"{kind}: {errors}")
        test.assertLessEqual(int(read_history(run.output)[-1]["step"]), int(step))
        shutil.rmtree(run.folder)
    print(f"{n} runs stopped by SIGTERM, all saved: at most {longest:.2f} s")


def main():
    campaigns = {"kills": kill_many, "damages": damage_many, "stops": stop_many}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in campaigns:
        parser.add_argument(f"--{name}", type=int, default=0)
    parser.add_argument("--seed", type=int, default=0)
    options = parser.parse_args()
    random.seed(options.seed)
    test = Checkpoints()
    test.setUp()
    try:
        for name, campaign in campaigns.items():
            if n := getattr(options, name):
                campaign(test, n)
    finally:
        test.doCleanups()


if __name__ == "__main__":
    main()
