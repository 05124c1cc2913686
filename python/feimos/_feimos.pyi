"""What `feimos` is made of. Its functions take arrays of one type, which the package prepares."""

from typing import Any, Dict, List, Optional, Sequence, Tuple, final

import numpy as np
from numpy.typing import NDArray

__all__ = ["Camera", "Scene", "__version__", "run"]

__version__: str

def run(arguments: Sequence[str]) -> int: ...
@final
class Camera:
    def __new__(
        cls,
        k: Sequence[Sequence[float]],
        r: Sequence[Sequence[float]],
        t: Sequence[float],
        size: Tuple[int, int],
    ) -> Camera: ...
    @property
    def size(self) -> Tuple[int, int]: ...
    @property
    def name(self) -> Optional[str]: ...
    def rays(self) -> Tuple[NDArray[np.float64], NDArray[np.float64]]: ...

@final
class Scene:
    @staticmethod
    def load(
        path: str,
        *,
        resolution: Optional[Tuple[int, int]],
        time: Optional[float],
        alpha_cutoff: Optional[float],
        input_budget: Optional[int],
        threads: Optional[int],
    ) -> Scene: ...
    @staticmethod
    def mesh(
        points: NDArray[np.float32], triangles: NDArray[np.uint32], *, threads: Optional[int]
    ) -> Scene: ...
    @property
    def camera(self) -> Camera: ...
    def cameras(self, path: str) -> List[Camera]: ...
    @property
    def bounds(self) -> Optional[List[List[float]]]: ...
    @property
    def primitive_count(self) -> int: ...
    @property
    def warnings(self) -> List[str]: ...
    def render(
        self,
        camera: Camera,
        channels: Sequence[str],
        *,
        accel: Optional[str],
        precision: str,
        threads: Optional[int],
    ) -> Dict[str, NDArray[Any]]: ...
    def cast(
        self,
        origins: NDArray[np.float64],
        directions: NDArray[np.float64],
        *,
        threads: Optional[int],
    ) -> Dict[str, NDArray[Any]]: ...
