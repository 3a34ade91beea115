# SPDX-License-Identifier: GPL-3.0-or-later
"""What comes of jobs: a result, an error, or nothing where the cluster is gone."""

import http.client
import os
from contextlib import closing

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


def test_no_page_tells_other_users_of_the_machine_about_jobs() -> None:
    with client(None, 1) as dask:
        server = dask.cluster.scheduler.http_server
        assert server.address == "127.0.0.1"
        assert server.port != 8787  # dask's usual one, which warns where a second run finds it taken
        for path in ("/info/main/workers.html", "/json/identity.json", "/metrics"):
            with closing(http.client.HTTPConnection(server.address, server.port, timeout=20)) as asked:
                asked.request("GET", path)
                assert asked.getresponse().status == 404


def test_workers_share_the_cores(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each would else start a thread for every core."""
    monkeypatch.delenv("OMP_NUM_THREADS", raising=False)
    cores = os.cpu_count() or 1
    for workers, threads in ((1, cores), (0, 1)):
        with client(None, workers) as dask:
            assert dask.submit(os.getenv, "OMP_NUM_THREADS").result() == str(threads)
