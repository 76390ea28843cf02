"""Nightly results as JSON lines, one file a machine, one line a metric and night; they are only ever appended to."""
import hashlib
import json
import platform
import re
from pathlib import Path

from measure import MeasureError

KEYS = ("date", "commit", "machine", "case", "threads", "metric", "unit", "value", "n", "spread", "build")


def machine_id():
    """Processor, number of processors, host: what must be the same for two speeds to be compared."""
    model = re.search(r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE)
    processors = len(re.findall(r"^processor\s*:", Path("/proc/cpuinfo").read_text(encoding="utf-8"), re.MULTILINE))
    facts = f"{model[1] if model else platform.machine()} x{processors} {platform.node()}"
    name = re.sub(r"[^a-z0-9]+", "-", (model[1] if model else platform.machine()).lower()).strip("-")
    return f"{name}-x{processors}-{hashlib.sha256(facts.encode()).hexdigest()[:8]}"


def append(file, records):
    file.parent.mkdir(parents=True, exist_ok=True)
    with file.open("a", encoding="utf-8") as lines:
        lines.writelines(json.dumps(record) + "\n" for record in records)


def load(file):
    """All records of a file, oldest first. The records of one night share their date."""
    if not file.exists():
        return []
    records = []
    for number, line in enumerate(file.read_text(encoding="utf-8").splitlines(), 1):
        try:
            record = json.loads(line)
            missing = [key for key in ("date", "machine", "case", "threads", "metric") if key not in record]
        except ValueError as error:
            raise MeasureError(f"{file}:{number}: not a JSON line ({error}). Remove the line.") from error
        if missing:
            raise MeasureError(f"{file}:{number}: has no \"{missing[0]}\". Remove the line.")
        records.append(record)
    return records


class Series:
    """One metric of one case, threads and build on one machine, night after night; begins anew where a new level was accepted."""

    def __init__(self, key):
        self.machine, self.case, self.threads, self.metric, self.build = key
        self.records, self.accepted = [], []    # accepted: (place in records, reason)

    @property
    def name(self):
        return f"{self.case}/{self.threads}" if self.threads else self.case

    @property
    def values(self):
        return [record["value"] for record in self.records]

    @property
    def begin(self):
        """First record that the present one is compared with."""
        return self.accepted[-1][0] if self.accepted else 0


def series_of(records):
    """Machines and builds are never mixed: another build begins another series. Only those measured in the last night are given back."""
    found = {}
    for record in records:
        if record.get("accepted"):
            for series in found.values():
                if (series.case, series.threads, series.metric) == (record["case"], record["threads"], record["metric"]):
                    series.accepted.append((max(len(series.records) - 1, 0), record["accepted"]))
            continue
        key = tuple(record[name] for name in ("machine", "case", "threads", "metric", "build"))
        found.setdefault(key, Series(key)).records.append(record)
    last = max((record["date"] for record in records if not record.get("accepted")), default="")
    return [series for series in found.values() if series.records[-1]["date"] == last]
