# SPDX-License-Identifier: BSD-3-Clause
"""The examples of a document."""

import re


def code_blocks(file, language):
    """The texts of the fenced blocks of a language in a Markdown file, in their order."""
    return re.findall(rf"^```{language}\n(.*?)^```$", file.read_text(), re.MULTILINE | re.DOTALL)
