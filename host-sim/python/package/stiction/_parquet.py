"""Tables of pandas as Parquet files, with their scene and solver in the metadata."""

from __future__ import annotations

import json
import os
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import pandas

NAMES = ("frames", "contacts", "events")
KEY = b"stiction"


def write(
    folder: str | os.PathLike[str], tables: tuple[pandas.DataFrame, ...], about: dict[str, str]
) -> None:
    """Writes tables into a folder, which is created."""
    import pyarrow
    import pyarrow.parquet

    os.makedirs(folder, exist_ok=True)
    for name, frame in zip(NAMES, tables):
        table = pyarrow.Table.from_pandas(frame, preserve_index=False)
        metadata = {**(table.schema.metadata or {}), KEY: json.dumps(about).encode()}
        path = os.path.join(folder, f"{name}.parquet")
        pyarrow.parquet.write_table(table.replace_schema_metadata(metadata), path)


def read(
    folder: str | os.PathLike[str],
) -> tuple[tuple[pandas.DataFrame, pandas.DataFrame, pandas.DataFrame], dict[str, Any]]:
    """The tables in a folder, and their metadata."""
    import pyarrow.parquet

    paths = [os.path.join(folder, f"{name}.parquet") for name in NAMES]
    frames, contacts, events = (pyarrow.parquet.read_table(path) for path in paths)
    metadata = frames.schema.metadata or {}
    if KEY not in metadata:
        raise ValueError(f"{paths[0]}: has no scene in its metadata, allowed: a file written by `Run.to_parquet`")
    about: dict[str, Any] = json.loads(metadata[KEY])
    return (frames.to_pandas(), contacts.to_pandas(), events.to_pandas()), about
