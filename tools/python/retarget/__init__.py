"""Two motions, each captured alone, become one scene of two people tangled with each other.

    import retarget
    result = retarget.run("attacker.bvh", "opponent.bvh", "rear_choke.yaml")
    result.solved["a"].positions    # [T, 21, 3], metres, Y up
    result.save("out")

docs/python.md says more.
"""

from ._bvh import clip_from_arrays
from ._retarget import (
    Clip,
    InputError,
    Motion,
    Result,
    Template,
    __version__,
    default_settings,
    gli,
    run,
    tangles,
)

__all__ = [
    "Clip",
    "InputError",
    "Motion",
    "Result",
    "Template",
    "__version__",
    "clip_from_arrays",
    "default_settings",
    "gli",
    "run",
    "tangles",
]
