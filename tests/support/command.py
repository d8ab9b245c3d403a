# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of a test; what a command printed is in its failure."""
import re
import subprocess


def run(*command, status=0, stderr=subprocess.STDOUT, timeout=1800, **more):
    """What it printed, also of errors; raises AssertionError with all of that if it ends with
    another status."""
    done = subprocess.run([str(each) for each in command], stdout=subprocess.PIPE, stderr=stderr,
                          text=True, timeout=timeout, **more)
    if done.returncode != status:
        raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout[-4000:]}"
                             f"{(done.stderr or '')[-4000:]}")
    return done.stdout


def output(*command, **more):
    """What it printed, without errors."""
    return run(*command, stderr=subprocess.PIPE, **more)


def source_is_missing(said):
    """Of a build for which toolchain/debian_source.sh fetches sources: the words with which it
    ends where there are none, or None. CMake breaks them into lines."""
    found = re.search(r"the source of \S+ could not be fetched", " ".join(said.split()))
    return found and found[0] + "; STYLET_DEBIAN_SOURCES can name a folder that has it"
