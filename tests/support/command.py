# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of a test; if one fails, the failure contains its output."""
import re
import subprocess


def run(*command, status=0, stderr=subprocess.STDOUT, timeout=1800, **more):
    """Its output, errors included; raises AssertionError with all of it if the exit status is
    another one."""
    done = subprocess.run([str(each) for each in command], stdout=subprocess.PIPE, stderr=stderr,
                          text=True, timeout=timeout, **more)
    if done.returncode != status:
        raise AssertionError(f"{command}: exit code {done.returncode}\n{done.stdout[-4000:]}"
                             f"{(done.stderr or '')[-4000:]}")
    return done.stdout


def output(*command, **more):
    """Its output, without errors."""
    return run(*command, stderr=subprocess.PIPE, **more)


def source_is_missing(said):
    """For a build for which toolchain/debian_source.sh fetches sources: the message with which it
    ends if there are none, or None. CMake breaks it into lines."""
    found = re.search(r"the source of \S+ could not be fetched", " ".join(said.split()))
    return found and found[0] + "; STYLET_DEBIAN_SOURCES can name a folder that has it"
