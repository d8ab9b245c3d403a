# SPDX-License-Identifier: Apache-2.0
"""h5py, loaded when a file is first read or written: simulations do not need it. pip could not even
install what needs it beside Debian's, which has another name."""
from typing import Any


def __getattr__(name: str) -> Any:
    try:
        import h5py
    except ModuleNotFoundError as error:
        raise ModuleNotFoundError("files of HDF5 need h5py (Debian: package python3-h5py)",
                                  name="h5py") from error
    return getattr(h5py, name)
