"""Errors and warnings: the texts of the program."""

import pickle
import warnings

import pytest

import feimos
from conftest import SCENES

WRONG = {
    "open.pbrt": 'WorldBegin\nShape "sphere" "float radius" [ 1\n',
    "type.pbrt": 'WorldBegin\nShape "sphere" "string radius" "one"\n',
    "camera.pbrt": 'Camera "telescope"\nWorldBegin\n',
    "world.pbrt": 'WorldBegin\nWorldBegin\nShape "sphere" "float radius" -1 \n[',
    "mesh.pbrt": 'WorldBegin\nShape "plymesh" "string filename" "absent.ply"\n',
    "short.ply": "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nend_header\n1\n",
    "index.obj": "v 0 0 0\nv 1 0 0\nf 1 2 9\n",
}
WARNED = 'WorldBegin\nShape "blob"\nShape "sphere"\nFrobnicate "x"\n'


def message(stderr: str, kind: str) -> str:
    """The text after the first `kind: `, to the end."""
    return stderr[stderr.index(f"{kind}: ") + len(kind) + 2 :].rstrip("\n")


@pytest.mark.parametrize("name", WRONG)
def test_the_text_is_that_of_the_program(program, tmp_path, monkeypatch, name):
    monkeypatch.chdir(tmp_path)
    (tmp_path / name).write_text(WRONG[name])
    ran = program("render", name, "-o", "x.exr")
    assert ran.returncode in (65, 66), ran.stderr
    with pytest.raises(feimos.Error) as caught:
        feimos.load(name)
    assert str(caught.value) == message(ran.stderr, "error")
    wanted = feimos.InputError if ran.returncode == 65 else feimos.MissingInputError
    assert type(caught.value) is wanted


def test_a_missing_file_is_a_missing_file(program, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    ran = program("render", "nowhere.pbrt", "-o", "x.exr")
    with pytest.raises(FileNotFoundError) as caught:
        feimos.load("nowhere.pbrt")
    assert isinstance(caught.value, feimos.Error)
    assert str(caught.value) == message(ran.stderr, "error")
    with pytest.raises(feimos.MissingInputError):
        feimos.load(SCENES / "sphere.pbrt").cameras("nowhere.json")


def test_classes_are_those_of_python_too():
    assert issubclass(feimos.InputError, ValueError)
    assert issubclass(feimos.ArgumentError, ValueError)
    assert issubclass(feimos.ResourceError, MemoryError)
    assert issubclass(feimos.FileError, OSError)
    for name in ("Argument", "File", "Input", "Internal", "MissingInput", "Resource"):
        assert issubclass(getattr(feimos, f"{name}Error"), feimos.Error)


def test_errors_travel_between_processes():
    with pytest.raises(feimos.Error) as caught:
        feimos.load("nowhere.pbrt")
    copy = pickle.loads(pickle.dumps(caught.value))
    assert type(copy) is type(caught.value) and str(copy) == str(caught.value)


def test_warnings_are_issued_once_and_kept(program, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "warned.pbrt").write_text(WARNED)
    ran = program("render", "warned.pbrt", "-o", "x.exr", "--resolution", "20x15")
    with warnings.catch_warnings(record=True) as issued:
        warnings.simplefilter("always")
        scene = feimos.load("warned.pbrt", resolution=(20, 15))
        assert [str(warning.message) for warning in issued] == list(scene.warnings)
        assert all(warning.filename == __file__ for warning in issued)
        scene.render()
        assert len(issued) == len(scene.warnings)
    assert scene.warnings
    for warning in scene.warnings:
        assert f"warning: {warning}" in ran.stderr


def test_warnings_may_be_errors(tmp_path):
    path = tmp_path / "warned.pbrt"
    path.write_text(WARNED)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(UserWarning, match="blob"):
            feimos.load(path)
