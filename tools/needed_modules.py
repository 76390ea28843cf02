"""What each script does first: it says which Python modules are missing, in one line and with exit code 2; Ctrl-C ends it with one line, too.

    from needed_modules import end_in_one_line, need
    if __name__ == "__main__":
        end_in_one_line("hdem plot")
    need("h5py", "matplotlib", "numpy")

Modules that take long are imported behind these lines.
"""
import importlib
import os
import signal
import sys

IN_SOURCES = os.path.exists(os.path.join(os.path.dirname(__file__), "setup"))
INTERRUPTED = 130    # exit code
unfinished = set()    # names of files that are being written; they do not stay behind


def end_in_one_line(command):
    """What SIGINT does from now on. The program ends at once: modules that are being imported would make something else of an exception."""
    def end(_number, _frame):
        for file in list(unfinished):
            try:
                os.unlink(file)
            except OSError:
                pass
        os.write(2, f"{command}: interrupted\n".encode())
        os._exit(INTERRUPTED)
    if signal.getsignal(signal.SIGINT) is not signal.SIG_IGN:    # nohup: go on
        signal.signal(signal.SIGINT, end)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})    # hdem holds it back until here


def missing_of(names):
    """Those that cannot be imported: not there, or of another Python."""
    missing = []
    for name in names:
        try:
            importlib.import_module(name)
        except ImportError:
            missing.append(name)
    return missing


def remedy_for(missing):
    """Where hdem is installed there is no tools/setup."""
    first = "run tools/setup" if IN_SOURCES else f"install {' '.join(f'python3-{name}' for name in missing)}"
    return f"{first}, or use /usr/bin/python3"


def ready_the_screen():
    """From here on it takes any text."""
    for stream in (sys.stdout, sys.stderr):
        stream.reconfigure(errors="backslashreplace")    # a name in another alphabet, or a path in none


def need(*names, remedy=None):
    """Ends the program when one of them is missing."""
    ready_the_screen()
    missing = missing_of(names)
    if missing:
        print(f"error: needs the Python module{'s' if len(missing) > 1 else ''} {', '.join(missing)}: {remedy or remedy_for(missing)}", file=sys.stderr)
        sys.exit(2)
