"""Commands of the rings of tests: their output is passed on, all of them run, and the end lists times and failures."""

import os
import re
import resource
import shutil
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
# What cargo, rustc and the linker say when the disk is full.
FULL = re.compile(r"No space left on device|os error 28|signal: 7, SIGBUS")


def processor_seconds():
    """The seconds that all commands until now have computed."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def passed_on(command, environment, seen=lambda line: None, silence=None, hung=lambda: None):
    """Runs a command, calls `seen` with each line that it prints, and returns its status.

    After `silence` seconds without a line the command is ended, and `hung` is called first.
    """
    last = time.monotonic()
    process = subprocess.Popen(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               text=True, errors="replace", start_new_session=True)

    def ended():
        try:
            os.killpg(process.pid, signal.SIGKILL)
        except ProcessLookupError:
            pass

    def watch():
        while process.poll() is None:
            if time.monotonic() - last > silence:
                hung()
                ended()
            time.sleep(1)

    if silence:
        threading.Thread(target=watch, daemon=True).start()
    try:
        for line in process.stdout:
            last = time.monotonic()
            sys.stdout.write(line)
            sys.stdout.flush()
            if FULL.search(line):
                ended()
                folder = environment.get("CARGO_TARGET_DIR", ROOT)
                free = shutil.disk_usage(folder).free >> 20
                sys.exit(f"\nThe disk is full: {free} MiB are free for {folder}. `cargo clean` makes room.")
            seen(line)
        return process.wait()
    except KeyboardInterrupt:
        ended()
        raise


class Steps:
    """Steps by their names: one that fails does not hinder those after it."""

    def __init__(self):
        self.start, self.rows, self.failed, self.left_out = time.monotonic(), [], [], []

    def run(self, name, command, **environment):
        """Runs lines of bash, which end with the first that fails; returns whether all succeeded."""
        print(f"\n=== {name}", flush=True)
        start, used = time.monotonic(), processor_seconds()
        arguments = ["bash", "-euo", "pipefail", "-c", command]

        def seen(line):
            if line.startswith("left out: "):
                self.left_out.append(line.removeprefix("left out: ").strip())

        status = passed_on(arguments, {**os.environ, **environment}, seen)
        self.rows.append((time.monotonic() - start, processor_seconds() - used, name))
        if status:
            self.failed.append(name)
        return status == 0

    def end(self):
        """Prints the times, what was left out and what failed, and ends the program."""
        total = (time.monotonic() - self.start, processor_seconds(), "in all")
        print(f"\n{'wall s':>8} {'processor s':>12}")
        for wall, used, name in [*self.rows, total]:
            print(f"{wall:8.0f} {used:12.0f}  {name}")
        if self.left_out:
            print("\nLeft out:\n" + "\n".join(f"    {what}" for what in self.left_out))
        if self.failed:
            print("\nFailed:\n" + "\n".join(f"    {name}" for name in self.failed))
            sys.exit(1)
        sys.exit(0)
