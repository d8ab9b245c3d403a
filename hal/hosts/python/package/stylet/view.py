# SPDX-License-Identifier: Apache-2.0
"""Draws a recording.

usage: python3 -m stylet.view FILE [-o PICTURE] [--needle N]
"""
import argparse
import sys

from stylet.recording import Recording


def main() -> None:
    parser = argparse.ArgumentParser(prog="python3 -m stylet.view",
                                     description="Draws force by cause over time and depth.")
    parser.add_argument("file", help="recording of stylet run --record")
    parser.add_argument("-o", "--output", help="picture to write; without it a window opens")
    parser.add_argument("--needle", type=int, default=0, help="of several, from 0")
    arguments = parser.parse_args()
    import matplotlib
    if arguments.output:
        matplotlib.use("Agg")  # needs no screen
    import matplotlib.pyplot
    try:
        recording = Recording(arguments.file)
        figure = recording.plot(arguments.needle)
        if arguments.output:
            figure.savefig(arguments.output)
        else:
            matplotlib.pyplot.show()
    except (OSError, ValueError, IndexError) as error:
        sys.exit(f"stylet.view: {error}")


if __name__ == "__main__":
    main()
