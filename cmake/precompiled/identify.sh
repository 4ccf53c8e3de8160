#!/bin/sh
# Usage: identify.sh FILE SOURCE...
#
# Writes what ccache knows precompiled headers by: their sources and the packages that these include.
# The precompiled header itself names the build folder, so objects would be found again only there.

sum=$1
shift
{
    cat "$0" "$(dirname "$0")"/*.h "$@"
    dpkg-query --show g++-12 libstdc++-12-dev libc6-dev libeigen3-dev libgtest-dev libgmock-dev \
        libprotobuf-dev libboost1.74-dev libssl-dev
} >"$sum" 2>&1
# What is not installed is named too; without dpkg-query nothing is known.
command -v dpkg-query >/dev/null || rm -f "$sum"
