"""What goes wrong, with the texts of the program."""
from __future__ import annotations


class Error(Exception):
    """What all exceptions of hdem are."""


class CaseError(Error, ValueError):
    """What the user must change in a case, a checkpoint or a folder.

    str() has all problems, one a line, each as the program prints it: "file:line:col: object: field = value (why). What to do."
    problems is a list of them.
    """

    def __init__(self, problems: list[str]) -> None:
        super().__init__(problems)
        self.problems = list(problems)

    def __str__(self) -> str:
        return "\n".join(self.problems)


class RunError(Error, RuntimeError):
    """A run cannot go on: a value that is not finite, an overlap above its limit, a step too great, a file that cannot be written."""
