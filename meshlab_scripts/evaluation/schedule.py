# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs jobs on all cores, or on a user's cluster, by dask.distributed."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager

import dask
from dask.distributed import Client, Future, LocalCluster, as_completed
from tqdm import tqdm

from .jobs import Job, Site
from .store import Store
from .work import run


def run_missing(jobs: list[Job], site: Site, store: Store, scheduler: str | None, title: str = "") -> None:
    """Runs the jobs that the store has no result of, each after the one that it needs."""
    by_name = {job.name: job for job in jobs}
    done = store.get(jobs)
    missing = [job for name, job in by_name.items() if name not in done]
    if not missing:
        return
    with (
        _client(scheduler) as client,
        tqdm(desc=title, total=len(by_name), initial=len(done), unit="job", smoothing=0.05) as bar,
    ):
        futures: dict[str, Future] = {}
        for job in sorted(missing, key=lambda job: job.kind != "embed"):
            futures[job.name] = client.submit(run, job, site, futures.get(job.before.name), key=job.name)
        lost = 0
        for future in as_completed(futures.values()):
            job = by_name[future.key]
            if future.status == "finished":
                results, error = future.result()
            elif future.status == "error":  # run() raises none: the job took its worker with it
                results, error = {}, repr(future.exception())
            else:  # the cluster is gone, which says nothing of the job
                lost += 1
                continue
            store.add(job, results, error)
            bar.update()
            if error:
                bar.write(f"{job.kind} {job.mesh} {job.method} {job.attack}: {error}")
    if lost:
        raise SystemExit(f"The cluster was lost with {lost} jobs to do. Run the same again: it goes on from there.")


@contextmanager
def _client(scheduler: str | None) -> Iterator[Client]:
    if scheduler:
        with Client(scheduler) as client:
            yield client
        return
    quiet = logging.ERROR
    with (
        # A machine that slept, or a run that was paused, is no dead worker.
        dask.config.set({"distributed.scheduler.worker-ttl": None}),
        LocalCluster(threads_per_worker=1, dashboard_address=None, silence_logs=quiet) as cluster,
        Client(cluster) as client,
    ):
        yield client
