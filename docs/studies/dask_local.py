# python dask_local.py STUDY DIR
import sys

import stickslip as ss
from dask.distributed import Client, LocalCluster

if __name__ == "__main__":
    study, out = sys.argv[1:]
    with LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster, Client(cluster) as client:
        ss.Study.load(study).run(client=client, out=out)
