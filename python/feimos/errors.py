"""What feimos raises."""


class Error(Exception):
    """Base class of all errors of feimos.

    ``str(error)`` is the message of the command line: what is wrong, in which file, line and
    column, and what to do about it.
    """


class ArgumentError(Error, ValueError):
    """An argument is out of range, has a wrong shape, or does not fit the others."""


class InputError(Error, ValueError):
    """A scene, a mesh or a list of cameras is wrong."""


class MissingInputError(Error, FileNotFoundError):
    """A scene, or a file that it names, does not exist or is a folder."""


class FileError(Error, OSError):
    """Reading or writing a file failed."""


class ResourceError(Error, MemoryError):
    """Memory or another resource does not suffice now; trying again later may help."""


class InternalError(Error, RuntimeError):
    """A bug in feimos."""
