import os
from typing import Any, Callable, Dict, List, Mapping, Optional, Sequence, Tuple, Union, overload

import numpy as np
import numpy.typing as npt

__version__: str
__all__: List[str]

Path = Union[str, "os.PathLike[str]"]
Points = npt.ArrayLike
Array = npt.NDArray[np.float64]

class InputError(ValueError): ...

class Clip:
    def __init__(
        self,
        source: Union[Path, bytes],
        *,
        name: Optional[str] = None,
        start: Optional[float] = None,
        stature: Optional[float] = None,
        units: Union[str, float, None] = None,
        up: Optional[str] = None,
        map: Optional[Path] = None,
        repair: Optional[bool] = None,
        keep_in_place: Optional[bool] = None,
        skip_frames: Optional[int] = None,
        ik_targets: Optional[str] = None,
        amc_fps: Optional[float] = None,
        character: Optional[Path] = None,
        character_map: Optional[Path] = None,
        skeleton_bytes: Optional[bytes] = None,
    ) -> None: ...
    @property
    def path(self) -> str: ...
    def arrays(self) -> Dict[str, Any]: ...

class Template:
    def __init__(self, source: Path) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def description(self) -> str: ...
    @property
    def keywords(self) -> List[str]: ...
    @property
    def text(self) -> str: ...
    @property
    def positions(self) -> Dict[str, Array]: ...

class Motion:
    @property
    def fps(self) -> float: ...
    @property
    def nodes(self) -> List[str]: ...
    @property
    def links(self) -> List[str]: ...
    @property
    def positions(self) -> Array: ...
    @property
    def rotations(self) -> Array: ...
    @property
    def root(self) -> Array: ...
    def __len__(self) -> int: ...

class Result:
    @property
    def status(self) -> str: ...
    @property
    def exit_code(self) -> int: ...
    @property
    def solved(self) -> Dict[str, Motion]: ...
    @property
    def source(self) -> Dict[str, Motion]: ...
    @property
    def baseline(self) -> Dict[str, Motion]: ...
    @property
    def report(self) -> Dict[str, Any]: ...
    @property
    def metrics(self) -> Dict[str, Any]: ...
    @property
    def notes(self) -> List[str]: ...
    @property
    def files(self) -> Dict[str, bytes]: ...
    def save(self, folder: Path, force: bool = False) -> None: ...

def run(
    clip_a: Union[Path, bytes, Clip],
    clip_b: Union[Path, bytes, Clip],
    template: Union[Path, Template],
    settings: Mapping[str, Any] = {},
    *,
    fps: float = 30.0,
    frames: Optional[Tuple[int, int]] = None,
    template_at: float = 0.0,
    show: str = "figures",
    rest: str = "keep",
    page: bool = True,
    also: Sequence[str] = (),
    progress: Optional[Callable[[Dict[str, Any]], Optional[bool]]] = None,
) -> Result: ...
def tangles(
    template: Union[Path, Template, Points],
    other: Optional[Points] = None,
    settings: Mapping[str, Any] = {},
) -> Dict[str, Any]: ...
@overload
def gli(p: Points, q: Points) -> float: ...
@overload
def gli(p: Points, q: Points, *, gradient: bool) -> Any: ...
def default_settings() -> Dict[str, Dict[str, Any]]: ...
def clip_from_arrays(
    names: Sequence[str],
    parents: Sequence[int],
    offsets: npt.ArrayLike,
    rotations: npt.ArrayLike,
    root: npt.ArrayLike,
    fps: float,
    *,
    end_sites: Optional[Mapping[str, npt.ArrayLike]] = None,
    units: str = "m",
    name: str = "arrays",
    **options: Any,
) -> Clip: ...
