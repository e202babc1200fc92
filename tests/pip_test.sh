#!/usr/bin/env bash
# Installs the Python package by pip into a clean virtual environment, with the build that the tests belong to, and uses it
# there, from another folder.
# usage: pip_test.sh BUILD PYTHON, in the top folder of the sources
set -euo pipefail

build=$1 python=$2
folder=$(mktemp --directory)
trap 'rm -rf "$folder"' EXIT
"$python" -c 'import setuptools, wheel, venv, pip' 2>/dev/null || {
  echo "not installed: python3-setuptools python3-wheel python3-venv python3-pip"
  exit 77
}
unset PYTHONPATH
mkdir "$folder/sources" "$folder/sources/docs" "$folder/elsewhere"
cp --recursive pyproject.toml setup.py VERSION python "$folder/sources"
cp docs/python.md "$folder/sources/docs"
"$python" -m venv --system-site-packages "$folder/venv"
WHEELWRIGHT_BUILD=$build "$folder/venv/bin/pip" --quiet install --no-build-isolation --no-index "$folder/sources"
cp python/tests/*.py "$folder/elsewhere"
cd "$folder/elsewhere"
"$folder/venv/bin/python" -c "
import wheelwright
assert wheelwright.__file__.startswith('$folder/venv'), wheelwright.__file__
libraries = [line.split()[-1] for line in open('/proc/self/maps') if 'libwheelwright' in line]
assert all(library.startswith('$folder/venv') for library in libraries), libraries
"
"$folder/venv/bin/python" -m unittest test_case test_run
"$folder/venv/bin/pip" --quiet show wheelwright-fem >/dev/null
