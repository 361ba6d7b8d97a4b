"""One mass on a spring and a Jenkins element under a sine, by harmonic balance of pyharm-os 1.2.2 (Python 3.11):

python -m pip install pyharm-os==1.2.2
python jenkins.py > jenkins.json
"""

import json, sys, logging
import numpy as np
from pyHarm.Maestro import Maestro
MASS, SPRING, DAMPING, PUSH, PERIOD = 1.0, 1.9e6, 60.0, 6.0, 4.5e-3
FRICTION, NORMAL = 0.5, 10.0
SHEAR = 210e9 / (2 * (1 + 0.3))
ELEMENT = 2 * 10e-6 * 2 * SHEAR / (2 - 0.3)
OMEGA = 2 * np.pi / PERIOD
def balance(harmonics):
    matrix = {name: np.array([[value]]) for name, value in dict(M=MASS, C=DAMPING, K=SPRING, G=0.0).items()}
    data = {
        "analysis": {"a": {"study": "frf", "puls_inf": OMEGA, "puls_sup": 1.001 * OMEGA, "verbose": False, "solver": "NewtonRaphson",
                           "solver_options": {"tol_residual": 1e-10, "tol_delta_x": 1e-15}}},
        "system": {"type": "Base", "nh": harmonics, "nti": 4096},
        "substructures": {"mass": {"matrix": matrix, "ndofs": 1}},
        "connectors": {
            "push": {"type": "SinusForcing", "connect": {"mass": [0]}, "dirs": [0], "amp": PUSH},
            "element": {"type": "Jenkins", "connect": {"mass": [0]}, "dirs": [0], "mu": FRICTION, "N0": NORMAL, "k": ELEMENT},
        },
        "kinematics": {},
    }
    logging.disable(logging.CRITICAL)
    analysis = Maestro(data).nls["a"]
    analysis.initialise(None)
    solution = analysis.SolList[0]
    assert solution.flag_accepted
    return [float(x) for x in solution.x[:-1]]
what = "one mass on a spring and a Jenkins element under a sine: harmonics of its place, m: mean, cos ωt, sin ωt, cos 2ωt …"
source = "pyharm-os 1.2.2 (SAFRAN), jenkins.py beside this file"
harmonics = {str(h): balance(h) for h in (3, 9, 27, 51)}
json.dump({"what": what, "source": source, "harmonics": harmonics}, sys.stdout, ensure_ascii=False)
