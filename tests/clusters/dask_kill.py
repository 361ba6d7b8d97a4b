"""Workers of Dask compute a study; one is killed before the end: dask_kill.py SCRIPT STUDY OUT

SCRIPT is what a user runs: it starts a cluster of two worker processes. The parts that were there at the time of the kill are listed in
OUT.kept. Ends with 77 where Dask cannot be had.
"""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

try:
    import distributed
    import psutil
except ImportError as error:
    print(f"not to be had here: Dask, {error}; skipped")
    sys.exit(77)


def parts(out):
    return sorted(out.glob("part-*.parquet"))


def workers(process):
    """Worker processes: not the tracker of resources that Python starts beside them."""
    found = []
    for child in process.children(recursive=True):
        try:
            if "spawn_main" in " ".join(child.cmdline()):
                found.append(child)
        except psutil.Error:
            pass
    return found


def within(seconds, condition, run, what):
    last = time.monotonic() + seconds
    while not condition():
        if run.poll() is not None:
            sys.exit(f"Dask: the script has ended with {run.returncode} before {what}")
        if time.monotonic() > last:
            sys.exit(f"Dask: after {seconds} s not yet {what}")
        time.sleep(0.05)


def main(script, study, out):
    begun = time.monotonic()
    passed = lambda: f"{time.monotonic() - begun:.0f} s"  # noqa: E731
    out = Path(out)
    run = subprocess.Popen([sys.executable, script, study, out], start_new_session=True)
    process = psutil.Process(run.pid)
    try:
        within(60, lambda: len(parts(out)) >= 4, run, "four parts were there")
        started = workers(process)
        if len(started) != 2:
            sys.exit(f"Dask: {len(started)} worker processes instead of 2")
        started[0].kill()
        kept = [(part.stat(), part.name) for part in parts(out)]
        Path(f"{out}.kept").write_text("".join(f"{s.st_ino} {int(s.st_mtime)} {name}\n" for s, name in kept))
        print(f"distributed {distributed.__version__}, worker killed after {passed()}, {len(kept)} parts are there", flush=True)
        within(30, lambda: not started[0].is_running(), run, "the worker was gone")
        try:
            code = run.wait(240)
        except subprocess.TimeoutExpired:
            sys.exit("Dask: the script has not ended after 240 s")
        if code != 0:
            sys.exit(f"Dask: the script has ended with {code}")
        print(f"script ended after {passed()}")
    finally:
        # Whatever is left of it.
        for signum in (signal.SIGTERM, signal.SIGKILL):
            try:
                os.killpg(run.pid, signum)
                run.wait(5)
            except (ProcessLookupError, subprocess.TimeoutExpired):
                pass


if __name__ == "__main__":
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    main(*sys.argv[1:])
