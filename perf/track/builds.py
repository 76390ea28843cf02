"""Builds hdem_perf of this tree and of other commits; those are kept."""
import subprocess
from pathlib import Path

import measure

PRESET = "release"
LAST_LINES = 15


class Builder:
    """Works on the tree `root`; other commits are checked out and built below `cache`."""

    def __init__(self, root, cache, jobs, say):
        self.root, self.cache, self.jobs, self.say = Path(root), Path(cache), jobs, say

    def git(self, *words):
        """(what it prints, without the last line's end; None when it fails)"""
        try:
            done = subprocess.run(["git", "-C", self.root, *words], capture_output=True, text=True, check=False)
        except FileNotFoundError as missing:
            raise measure.MeasureError("git is not there. Install it, or give a stored hdem_perf in place of a commit.") from missing
        return done.stdout.strip() if done.returncode == 0 else None

    def commit_of(self, text):
        """Full name of a commit; without a text, of the state before the present change: HEAD where files have changed, else its parent."""
        if self.git("rev-parse", "--git-dir") is None:
            raise measure.MeasureError(f"{self.root} is no git repository: there is no commit to build. Give a stored hdem_perf.")
        name = text or ("HEAD" if self.git("status", "--porcelain", "--untracked-files=no") else "HEAD~1")
        found = self.git("rev-parse", "--verify", "--quiet", f"{name}^{{commit}}")
        if found is None:
            raise measure.MeasureError(f"\"{name}\" is neither a commit of this repository nor a file. `git log --oneline` lists commits.")
        return found

    def other(self, commit):
        """hdem_perf of a commit, built once."""
        tree = self.cache / commit[:12]
        program = tree / "build" / PRESET / "bin/hdem_perf"
        if program.exists():
            self.say(f"{commit[:12]}: kept from before, {program}")
            return program
        if not (tree / ".git").exists():
            self.cache.mkdir(parents=True, exist_ok=True)
            self.git("worktree", "prune")    # one that was deleted by hand
            self.command(["git", "-C", self.root, "worktree", "add", "--force", "--detach", tree, commit], self.cache / f"{commit[:12]}.log", self.root)
        return self.build(tree, program, self.cache / f"{commit[:12]}.log")

    def present(self):
        """hdem_perf of this tree."""
        folder = self.root / "build"
        folder.mkdir(exist_ok=True)
        return self.build(self.root, folder / PRESET / "bin/hdem_perf", folder / "against.log")

    def build(self, tree, program, log):
        self.say(f"building {program}")
        if not (tree / "build" / PRESET / "build.ninja").exists():
            self.command(["cmake", "--preset", PRESET], log, tree)
        self.command(["cmake", "--build", f"build/{PRESET}", "--target", "hdem_perf", "--parallel", str(self.jobs)], log, tree)
        if not program.exists():
            raise measure.MeasureError(f"{tree}: its target hdem_perf gives no {program.relative_to(tree)}. This commit cannot be compared with.")
        return program

    @staticmethod
    def command(words, log, folder):
        """Runs a command; what it says goes to `log`, and its last lines to the user when it fails."""
        words = [str(word) for word in words]
        with log.open("w", encoding="utf-8") as said:
            try:
                code = subprocess.run(words, cwd=folder, stdout=said, stderr=subprocess.STDOUT, check=False).returncode
            except FileNotFoundError as missing:
                raise measure.MeasureError(f"{words[0]} is not there; tools/setup installs it.") from missing
        if code != 0:
            last = "\n    ".join(log.read_text(encoding="utf-8", errors="replace").splitlines()[-LAST_LINES:])
            raise measure.MeasureError(f"{' '.join(words)}: ended with exit code {code}. The end of {log}:\n    {last}")
