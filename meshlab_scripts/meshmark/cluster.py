# SPDX-License-Identifier: GPL-3.0-or-later
"""Jobs on all cores, or on a user's cluster, by dask.distributed."""

import logging
import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from typing import Any

import dask
from dask.distributed import Client, Future, LocalCluster, Security, as_completed

from .errors import MeshmarkError


@contextmanager
def client(scheduler: str | None, workers: int = 0) -> Iterator[Client]:
    """Of the cluster at this address, or of one with so many processes here; 0 is one for each core."""
    if scheduler:
        with Client(scheduler) as remote:
            yield remote
        return
    cores = os.cpu_count() or 1
    workers = workers or cores
    with (
        dask.config.set(
            {
                "distributed.scheduler.worker-ttl": None,  # a machine that slept is no dead worker, nor a paused run
                "distributed.scheduler.http.routes": [],  # other users of this machine can reach its ports
                "distributed.worker.http.routes": [],
                "distributed.nanny.pre-spawn-environ": {  # memory that is given back is asked for again
                    "MALLOC_TRIM_THRESHOLD_": 1 << 30, "MALLOC_MMAP_THRESHOLD_": 32 << 20,
                },
                "distributed.nanny.environ": {"OMP_NUM_THREADS": max(1, cores // workers)},  # the plugin's, too
                "distributed.worker.profile.enabled": False,  # which looks at each process 100 times a second
                "distributed.worker.memory.monitor-interval": "1s",
                "distributed.admin.system-monitor.interval": "60s",
            }
        ),
        LocalCluster(
            n_workers=workers, threads_per_worker=1, silence_logs=logging.ERROR,
            security=Security.temporary(), dashboard_address="127.0.0.1:0", scheduler_kwargs={"dashboard": False},
        ) as cluster,
        Client(cluster) as local,
    ):  # fmt: skip
        yield local


def ended(futures: Iterable[Future]) -> Iterator[tuple[str, Any, BaseException | None]]:
    """The key of each job, as they end, and what it returned, or the error that it or its worker died of.

    :raises MeshmarkError: after those that ended, where the cluster was lost with the others
    """
    lost = 0
    for future in as_completed(futures):
        if future.status == "finished":
            yield future.key, future.result(), None
        elif future.status == "error":
            yield future.key, None, future.exception()
        else:  # the cluster is gone, which says nothing of the job
            lost += 1
        future.release()
    if lost:
        raise MeshmarkError(f"The cluster was lost with {lost} jobs to do. Run the same again: it goes on from there.")
