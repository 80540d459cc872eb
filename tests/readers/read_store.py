"""Reads a store of rehearsals with DuckDB, polars, pandas and pyarrow, and compares what they see.

Every expected number follows from the settings in the store:
value(t) = limit * (1 + error * scale ** order) * (1 - exp(-t / time_constant)).
Exits with 1 and one line per difference when a reader sees something else.
"""

import glob
import json
import math
import os
import sys

import duckdb
import pandas
import polars
import pyarrow.parquet

NUMBERS = ["limit", "scale", "settings.limit", "settings.time_constant", "settings.duration", "settings.error"]
UNITS = {"limit": "m/s", "scale": "1", "axes.scale": "1", "settings.duration": "s", "settings.time_constant": "s"}
faults = []


def check(holds, *what):
    if not holds:
        faults.append(" ".join(str(part) for part in what))


def close(one, other):
    return math.isclose(one, other, rel_tol=1e-12, abs_tol=1e-300)


def rows_by(reader, path):
    """The rows of a file as dictionaries, and the type of each column in the reader's own words."""
    if reader == "duckdb":
        relation = duckdb.sql(f"SELECT * FROM read_parquet('{path}')")
        types = dict(zip(relation.columns, map(str, relation.types)))
        return [dict(zip(relation.columns, row)) for row in relation.fetchall()], types
    if reader == "polars":
        frame = polars.read_parquet(path)
        return frame.to_dicts(), {name: str(kind) for name, kind in frame.schema.items()}
    frame = pandas.read_parquet(path)
    return frame.to_dict("records"), {name: str(kind) for name, kind in frame.dtypes.items()}


# What a double, an unsigned integer, an integer and a text are called.
TYPES = {
    "duckdb": ({"DOUBLE"}, {"UBIGINT"}, {"BIGINT"}, {"VARCHAR"}),
    "polars": ({"Float64"}, {"UInt64"}, {"Int64"}, {"String"}),
    "pandas": ({"float64"}, {"uint64"}, {"int64"}, {"object", "str", "string"}),
}


def check_types(reader, types):
    double, unsigned, integer, text = TYPES[reader]
    for name in NUMBERS + ["axes.scale"]:
        check(types.get(name) in double, reader, name, "is", types.get(name))
    for name in ["seed", "counters.steps"]:
        check(types.get(name) in unsigned, reader, name, "is", types.get(name))
    check(types.get("settings.samples") in integer, reader, "settings.samples is", types.get("settings.samples"))
    for name in ["id", "study", "scene", "kind", "status", "settings.ending", "settings_json"]:
        check(types.get(name) in text, reader, name, "is", types.get(name))


def limit_of(settings):
    return settings["limit"] * (1 + settings["error"] * settings["scale"] ** settings["order"])


def check_run(reader, row):
    settings = json.loads(row["settings_json"])["rehearsal"]
    check(row["kind"] == "rehearsal", reader, "kind is", row["kind"])
    check(row["axes.scale"] == settings["scale"], reader, "axes.scale is", row["axes.scale"])
    check(close(row["limit"], limit_of(settings)), reader, "limit is", row["limit"])
    for name, value in settings.items():
        check(row["settings." + name] == value, reader, name, "is", row["settings." + name], "not", value)
    completed = settings["ending"] == "completes"
    check((row["status"] == "completed") == completed, reader, "status is", row["status"])
    check(isinstance(row["reason"], str) != completed, reader, "reason is", row["reason"])
    return settings, row["counters.steps"]


def check_series(reader, store, runs):
    files = glob.glob(os.path.join(store, "series", "*.parquet"))
    check(len(files) == len(runs), "there are", len(files), "series for", len(runs), "runs")
    for path in files:
        rows, types = rows_by(reader, path)
        check(all(types[name] in TYPES[reader][0] for name in ["time", "value"]), reader, path, types)
        settings, steps = runs[rows[0]["id"]]
        check(len(rows) == steps, reader, path, "has", len(rows), "rows")
        check(rows[0]["time"] == 0 and rows[0]["value"] == 0, reader, path, "starts at", rows[0])
        for row in rows:
            expected = limit_of(settings) * -math.expm1(-row["time"] / settings["time_constant"])
            check(close(row["value"], expected), reader, path, "value", row["value"], "is not", expected)


def check_units(store):
    schema = pyarrow.parquet.read_schema(os.path.join(store, "runs.parquet"))
    listed, _ = rows_by("polars", os.path.join(store, "columns.parquet"))
    listed = {(line["table"], line["column"]): line for line in listed}
    for name, unit in UNITS.items():
        found = (schema.field(name).metadata or {}).get(b"unit", b"").decode()
        check(found == unit, "pyarrow: unit of", name, "is", found)
        check(listed[("runs", name)]["unit"] == unit, "columns: unit of", name, "is", listed[("runs", name)])
    for name in schema.names:
        check(listed.get(("runs", name), {}).get("description"), "columns: nothing on", name)
    for path in glob.glob(os.path.join(store, "series", "*.parquet")):
        schema = pyarrow.parquet.read_schema(path)
        for name, unit in [("time", "s"), ("value", "m/s")]:
            check(schema.field(name).metadata[b"unit"].decode() == unit, path, "unit of", name)
            check(listed[("time_series", name)]["unit"] == unit, "columns: unit of", name)
    timings, _ = rows_by("pandas", os.path.join(store, "timings.parquet"))
    check(all(row["wall"] >= 0 and len(row["simulator_hash"]) == 64 for row in timings), "timings:", timings)
    check(listed[("timings", "wall")]["unit"] == "s", "columns: unit of wall")


def check_layout(store):
    """Doubles are split by byte, everything is compressed with zstd."""
    group = pyarrow.parquet.ParquetFile(os.path.join(store, "runs.parquet")).metadata.row_group(0)
    for index in range(group.num_columns):
        column = group.column(index)
        check(column.compression == "ZSTD", column.path_in_schema, "is compressed with", column.compression)
        if column.physical_type == "DOUBLE":
            check("BYTE_STREAM_SPLIT" in column.encodings, column.path_in_schema, "is encoded", column.encodings)


def main(store):
    for reader in TYPES:
        rows, types = rows_by(reader, os.path.join(store, "runs.parquet"))
        check(len(rows) > 1, reader, "sees", len(rows), "runs")
        check_types(reader, types)
        if not faults:
            check_series(reader, store, {row["id"]: check_run(reader, row) for row in rows})
    if not faults:
        check_units(store)
        check_layout(store)
        pattern, runs = os.path.join(store, "series", "*.parquet"), os.path.join(store, "runs.parquet")
        joined = duckdb.sql(f"SELECT count(DISTINCT id) FROM '{pattern}' JOIN '{runs}' USING (id)").fetchall()[0][0]
        check(joined == len(rows), "a join of series and runs sees", joined, "runs of", len(rows))
    for fault in faults:
        print(fault, file=sys.stderr)
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
