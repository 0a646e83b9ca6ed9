"""Comparison of two runs."""

import numpy as np


def same(one, other, without=()):
    """Whether all fields of all tables have the same bits; NaN equals NaN."""
    for name in ("frames", "contacts", "events"):
        a, b = getattr(one, name), getattr(other, name)
        assert a.dtype == b.dtype and len(a) == len(b), name
        for field in set(a.dtype.names) - set(without):
            bits = [table[field].view("u8") if table[field].dtype == "f8" else table[field] for table in (a, b)]
            assert np.array_equal(*bits), f"{name}: {field}"
