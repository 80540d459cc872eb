#!/bin/sh
# Reads a store with DuckDB, polars and pandas, in an environment of its own.
# usage: run.sh STORE   (a store made by a study of rehearsals)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
[ $# -eq 1 ] || { echo "usage: $0 STORE" >&2; exit 2; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check duckdb polars pandas pyarrow
"$folder/venv/bin/python" "$here/read_store.py" "$1"
