#!/usr/bin/env python3
# SPDX-License-Identifier: LGPL-2.1-or-later
# Copyright (C) 2026 by the corotet authors
"""check_hdf5.py FILE N: fails unless FILE has the tables of hdf5_file.cc with N rows, as h5py reads them."""

import sys

import h5py
import numpy

n = int(sys.argv[2])
with h5py.File(sys.argv[1]) as file:
    for name, kind, shape in (("doubles", "f8", (n, 3)), ("group/integers", "i4", (n,)), ("group/long_integers", "i8", (n, 2)),
                              ("group/bytes", "u1", (n,)), ("root", "f8", (2, 2)), ("empty", "f8", (0,))):
        table = file[name]
        assert (table.dtype, table.shape) == (numpy.dtype(kind), shape), name
        expected = numpy.arange(table.size).astype(kind).reshape(shape)
        assert numpy.array_equal(table[...], expected), name
    assert list(file["group"].attrs["numbers"]) == [1, 2]
    assert file["group"].attrs["text"].decode() == "words"
