"""The history in the formats of others: github-action-benchmark, Apache Otava."""
import csv
import json

from judge import METRICS


def label(series):
    return f"{series.name} {series.metric}"


def action_benchmark(file, all_series):
    """The last night for github-action-benchmark, tool customSmallerIsBetter: what is judged."""
    rows = [{"name": label(series), "unit": METRICS[series.metric].unit or "-", "value": series.values[-1],
             "range": f"± {series.records[-1]['spread']:.3g}", "extra": f"n={series.records[-1]['n']}; {series.records[-1]['commit']}; {series.build}"}
            for series in all_series if METRICS[series.metric].smaller_is_better and METRICS[series.metric].kind != "shown"]
    file.write_text(json.dumps(rows, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")


def otava(folder, all_series):
    """otava.csv, a row a night and a column a metric, and otava.yaml that says which way is better."""
    nights = sorted({record["date"] for series in all_series for record in series.records})
    commits = {record["date"]: record["commit"] for series in all_series for record in series.records}
    by_night = [{record["date"]: record["value"] for record in series.records} for series in all_series]
    with (folder / "otava.csv").open("w", newline="", encoding="utf-8") as table:
        writer = csv.writer(table)
        writer.writerow(["time", "commit", *map(label, all_series)])
        writer.writerows([night, commits[night], *(values.get(night, "") for values in by_night)] for night in nights)
    config = {"tests": {"hdem": {
        "type": "csv", "file": str((folder / "otava.csv").resolve()), "time_column": "time", "attributes": ["commit"],
        "metrics": {label(series): {"column": label(series), "direction": -1 if METRICS[series.metric].smaller_is_better else 1} for series in all_series}}}}
    (folder / "otava.yaml").write_text(json.dumps(config, indent=1) + "\n", encoding="utf-8")    # JSON is YAML


def write(folder, all_series):
    folder.mkdir(parents=True, exist_ok=True)
    action_benchmark(folder / "action_benchmark.json", all_series)
    otava(folder, all_series)
