# SPDX-License-Identifier: Apache-2.0
"""Runs the commands of a test of another tree; what a command printed is in its failure."""
import subprocess


def run(*command):
    """What it printed; raises AssertionError with all of that if it fails."""
    done = subprocess.run([str(each) for each in command], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}")
    return done.stdout
