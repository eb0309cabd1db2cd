"""A prior map as files: picture, array, table, and the settings that made it."""

import io
import json
from collections.abc import Mapping

import numpy as np

from occsim._version import __version__
from occsim.imaging import Drawing
from occsim.io.images import png
from occsim.io.map_pictures import belief_picture
from occsim.prior import Prior, PriorMap

FORMAT = "occsim prior map"
VERSION = 1

Plain = str | int | float | bool | None
"""Values that a settings file may hold beside the prior."""


def prior_png(prior_map: PriorMap) -> bytes:
    """Return a prior map as a grey PNG of the drawing's size.

    Parameters
    ----------
    prior_map : PriorMap
        The prior on its grid.

    Returns
    -------
    bytes
        8-bit PNG, H x W pixels, grey ``round(255 * p_free)``: white is free.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, Prior, build_prior
    >>> from occsim.io.prior_map import prior_png
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> prior_map = build_prior(np.array([[True, False]]), grid, Prior())
    >>> prior_png(prior_map)[1:4]
    b'PNG'
    """
    return png(belief_picture(prior_map.p_free, prior_map.grid))


def prior_npy(prior_map: PriorMap) -> bytes:
    """Return p_free of every cell as a NumPy file.

    Parameters
    ----------
    prior_map : PriorMap
        The prior on its grid.

    Returns
    -------
    bytes
        NPY file of float64, shape (R, C), exact; it holds no pickled objects.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, Prior, build_prior
    >>> from occsim.io.prior_map import prior_npy
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> prior_map = build_prior(np.array([[True, False]]), grid, Prior())
    >>> len(prior_npy(prior_map))
    144
    """
    file = io.BytesIO()
    np.save(file, prior_map.p_free, allow_pickle=False)
    return file.getvalue()


def prior_csv(prior_map: PriorMap) -> str:
    """Return p_free of every cell as a table.

    Parameters
    ----------
    prior_map : PriorMap
        The prior on its grid.

    Returns
    -------
    str
        CSV: two comment lines, then one line for each row of cells, from the top down,
        numbers to 12 significant digits.

    Examples
    --------
    >>> import numpy as np
    >>> from occsim import Grid, Prior, build_prior
    >>> from occsim.io.prior_map import prior_csv
    >>> grid = Grid(height_px=1, width_px=2, cell_px=1)
    >>> prior_map = build_prior(np.array([[True, False]]), grid, Prior())
    >>> prior_csv(prior_map).splitlines()[0]
    '# p_free, the prior probability that a cell is free'
    """
    file = io.StringIO()
    grid = prior_map.grid
    header = (
        "p_free, the prior probability that a cell is free\n"
        f"{grid.n_rows} rows x {grid.n_cols} columns of {grid.cell_px} px cells, "
        f"top row first; drawing {grid.width_px} x {grid.height_px} px"
    )
    np.savetxt(
        file, prior_map.p_free, fmt="%.12g", delimiter=",", header=header, comments="# "
    )
    return file.getvalue()


def prior_json(
    prior_map: PriorMap,
    prior: Prior,
    drawing: Drawing,
    chosen_on: Mapping[str, Plain] | None = None,
) -> str:
    """Return the settings that reproduce a prior map from the same drawing.

    Parameters
    ----------
    prior_map : PriorMap
        The prior on its grid.
    prior : Prior
        Its parameters.
    drawing : Drawing
        Where its walls were found.
    chosen_on : mapping, optional
        The conditions under which the pair was chosen, as plain values: sensor, update
        rule, scores. NaN becomes null.

    Returns
    -------
    str
        JSON, with the versions of this library and of NumPy.

    Examples
    --------
    >>> from occsim import MappingRun, MapSettings, Prior, load_sample
    >>> from occsim.io.prior_map import prior_json
    >>> sample, prior = load_sample("d"), Prior(p_wall=0.2, p_space=0.9)
    >>> run = MappingRun(sample, MapSettings(cell_px=10))
    >>> document = prior_json(run.prior_map(prior), prior, sample.drawing)
    >>> '"p_wall": 0.2' in document
    True
    """
    grid = prior_map.grid
    chosen = {name: _plain(value) for name, value in (chosen_on or {}).items()}
    document = {
        "format": FORMAT,
        "version": VERSION,
        "software": {"occsim": __version__, "numpy": np.__version__},
        "drawing": {
            "name": drawing.name,
            "digest": drawing.digest,
            "height_px": grid.height_px,
            "width_px": grid.width_px,
        },
        "grid": {
            "cell_px": grid.cell_px,
            "n_rows": grid.n_rows,
            "n_cols": grid.n_cols,
            "order": "top row first, left column first",
        },
        "prior": {
            "p_wall": prior.p_wall,
            "p_space": prior.p_space,
            "scale": prior.scale,
            "p_free_wall_cells": prior.p_free_wall,
            "p_free_space_cells": prior.p_free_space,
            "n_wall_cells": int(np.count_nonzero(prior_map.is_wall)),
            # Neither wall nor space: the drawing says nothing, so p_free is one half.
            "n_unknown_cells": int(
                np.count_nonzero(
                    ~prior_map.is_wall & (prior_map.p_free != prior.p_free_space)
                )
            ),
        },
        "chosen_on": chosen,
    }
    return json.dumps(document, indent=2, allow_nan=False, ensure_ascii=False)


def _plain(value: Plain) -> Plain:
    # JSON has no NaN.
    return None if isinstance(value, float) and not np.isfinite(value) else value
