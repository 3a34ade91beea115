# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs jobs on all cores, or on a user's cluster, by dask.distributed."""

from dask.distributed import Future
from meshmark.cluster import client, ended
from tqdm import tqdm

from .jobs import Job, Site
from .store import Store
from .work import run


def run_missing(jobs: list[Job], site: Site, store: Store, scheduler: str | None, title: str = "") -> None:
    """Runs the jobs that the store has no result of, each after the one that it needs.

    :raises MeshmarkError: where the cluster was lost
    """
    by_name = {job.name: job for job in jobs}
    done = store.get(jobs)
    missing = [job for name, job in by_name.items() if name not in done]
    if not missing:
        return
    with (
        client(scheduler) as dask,
        tqdm(desc=title, total=len(by_name), initial=len(done), unit="job", smoothing=0.05) as bar,
    ):
        futures: dict[str, Future] = {}
        for job in sorted(missing, key=lambda job: job.kind != "embed"):
            futures[job.name] = dask.submit(run, job, site, futures.get(job.before.name), key=job.name)
        for name, result, death in ended(futures.values()):
            job = by_name[name]
            results, error = ({}, repr(death)) if death else result
            store.add(job, results, error)
            bar.update()
            if error:
                bar.write(f"{job.kind} {job.mesh} {job.method} {job.attack}: {error}")
