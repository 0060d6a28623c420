# SPDX-License-Identifier: BSD-3-Clause
"""The examples of a document, and how its commands are run."""

import re
import signal
import subprocess
import time


def code_blocks(file, language):
    """The texts of the fenced blocks of a language in a Markdown file, in their order."""
    blocks = re.findall(r"^```(\w*)\n(.*?)^```$", file.read_text(), re.MULTILINE | re.DOTALL)
    return [text for name, text in blocks if name == language]


def shorten(tool, more, folder):
    """Makes a `lockbox` in the folder that gives its commands of these names further arguments."""
    script = "".join(f'{name}) set -- "$@" {added};;\n' for name, added in more.items())
    folder.mkdir()
    (folder / "lockbox").write_text(f'#!/bin/sh\ncase "$1" in\n{script}esac\nexec {tool} "$@"\n')
    (folder / "lockbox").chmod(0o755)


def opens_window(command):
    words = set(command.split())
    return "view" in words and not words & {"--screenshot", "--pictures", "--video"}


def end_after_rows(process, states):
    """Ctrl-C for a run that has written rows, however long it takes on a busy machine."""
    for _ in range(2400):
        if process.poll() is not None:
            break
        if states.exists() and len(states.read_text().splitlines()) > 3:
            break
        time.sleep(0.05)
    process.send_signal(signal.SIGINT)


def run(command, folder, environment, lasts):
    """Its exit status. What lasts until it is ended is, by Ctrl-C: with 130."""
    process = subprocess.Popen(command.split(), cwd=folder, env=environment,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                               preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
    words = command.split()
    if lasts and "track" in words:
        end_after_rows(process, folder / words[words.index("--output") + 1] / "states.csv")
    elif lasts:
        time.sleep(5)
        process.send_signal(signal.SIGINT)
    output, errors = process.communicate()
    print(command, output, errors)
    return process.returncode
