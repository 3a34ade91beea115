# SPDX-License-Identifier: GPL-3.0-or-later
"""What comes of jobs: a result, an error, or nothing where the cluster is gone."""

import meshmark
import pytest
from dask.distributed import LocalCluster
from meshmark.cluster import client, ended


def test_results_errors_and_a_cluster_that_is_lost() -> None:
    with (
        LocalCluster(n_workers=1, threads_per_worker=1, processes=False, dashboard_address=None) as cluster,
        client(cluster.scheduler_address) as dask,
    ):
        good = dask.submit(divmod, 7, 2, key="good")
        bad = dask.submit(divmod, 7, 0, key="bad")
        told = {name: (result, type(death)) for name, result, death in ended([good, bad])}
        assert told == {"good": ((3, 1), type(None)), "bad": (None, ZeroDivisionError)}

        never = dask.submit(divmod, 7, 2, key="never", resources={"what no worker has": 1})
        cluster.close()
        with pytest.raises(meshmark.MeshmarkError, match="lost with 1 jobs"):
            list(ended([never]))
