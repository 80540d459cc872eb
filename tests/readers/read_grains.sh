#!/bin/sh
# Reads exported grains with VTK, the library under ParaView, in an environment of its own.
# usage: read_grains.sh FOLDER   (with grains.pvd, made of a rehearsal with 64 grains)
set -eu
here=$(cd "$(dirname "$0")" && pwd)
[ $# -eq 1 ] || { echo "usage: $0 FOLDER" >&2; exit 2; }
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
python3 -m venv "$folder/venv"
"$folder/venv/bin/python" -m pip install --quiet --disable-pip-version-check pyvista
"$folder/venv/bin/python" "$here/read_grains.py" "$1"
