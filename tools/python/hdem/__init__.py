"""Jointed rock as rigid blocks in two dimensions: the hybrid discrete element method, driven from Python.

    import hdem
    case = hdem.Case("tunnel.toml", set={"generator.seed": 3})
    simulation = hdem.Simulation(case, threads=1)
    simulation.run()
    print(simulation.cycle, simulation.state_hash)

SI units, angles in radians but for keys of the case that end in _deg; all per metre of thickness. Numbers have the same bits as those of the
program `hdem`, on any number of threads and however a run is cut into calls.
"""
from . import _compiled    # noqa: F401, first: it says what to do where the compiled part is missing
from ._case import Case
from ._core import default_threads, version_line
from ._errors import CaseError, Error, RunError
from ._factor import FactorOfSafety, Trial, fos
from ._simulation import REGIMES, Simulation
from ._toml import to_toml

__version__ = version_line().split()[1].rstrip(",")
__all__ = ["Case", "CaseError", "Error", "FactorOfSafety", "REGIMES", "RunError", "Simulation", "Trial", "default_threads", "fos",
           "to_toml", "version_line"]
