"""Runs jobs on all cores, or on a user's cluster, by dask.distributed."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager

from dask.distributed import Client, Future, LocalCluster, as_completed
from tqdm import tqdm

from .jobs import Job, Site
from .store import Store
from .work import run


def run_missing(jobs: list[Job], site: Site, store: Store, scheduler: str | None) -> None:
    """Runs the jobs that the store has no result of, each after the one that makes its marked mesh."""
    by_name = {job.name: job for job in jobs}
    done = store.get(jobs)
    missing = [job for name, job in by_name.items() if name not in done]
    if not missing:
        return
    with _client(scheduler) as client, tqdm(total=len(by_name), initial=len(done), unit="job", smoothing=0.05) as bar:
        futures: dict[str, Future] = {}
        for job in sorted(missing, key=lambda job: job.kind != "embed"):
            futures[job.name] = client.submit(run, job, site, futures.get(job.mark.name), key=job.name)
        completed = as_completed(futures.values())
        for future in completed:
            job = by_name[future.key]
            # An exception is a worker that died with the job; run() itself raises none.
            results, error = future.result() if future.status == "finished" else ({}, repr(future.exception()))
            store.add(job, results, error)
            bar.update()
            if error:
                bar.write(f"{job.kind} {job.mesh} {job.method} {job.attack}: {error}")


@contextmanager
def _client(scheduler: str | None) -> Iterator[Client]:
    if scheduler:
        with Client(scheduler) as client:
            yield client
        return
    quiet = logging.ERROR
    with (
        LocalCluster(threads_per_worker=1, dashboard_address=None, silence_logs=quiet) as cluster,
        Client(cluster) as client,
    ):
        yield client
