"""Strict access to a scene file: a key that nobody asked for is an error, never dropped."""
import numpy as np


class Unsupported(Exception):
    """What Mitsuba cannot express, or this exporter does not know; says which key."""


_REQUIRED = object()


class Keys:
    """One JSON object, and which of its keys were read."""

    def __init__(self, value, path):
        if not isinstance(value, dict):
            raise Unsupported(f"{path}: expected an object")
        self.value, self.path, self.unread = value, path, set(value)

    def __contains__(self, key):
        return key in self.value

    def get(self, key, default=_REQUIRED):
        self.unread.discard(key)
        if key not in self.value and default is _REQUIRED:
            raise Unsupported(f"{self.path}: the key '{key}' is missing")
        return self.value.get(key, default)

    def vector(self, key, default=_REQUIRED):
        value = self.get(key, default)
        return None if value is None else np.array(value, dtype=float)

    def colour(self, key, default=_REQUIRED):
        """Linear RGB: a grey value or three numbers."""
        value = self.get(key, default)
        return value if value is None else as_colour(value, f"{self.path}/{key}")

    def object(self, key):
        """The object under `key`; empty if there is none."""
        return Keys(self.get(key, {}), f"{self.path}/{key}")

    def objects(self, key):
        """The objects of the array under `key`; none if there is no such key."""
        return [Keys(v, f"{self.path}/{key}/{i}") for i, v in enumerate(self.get(key, []))]

    def refuse(self, key, why):
        raise Unsupported(f"{self.path}/{key}: {why}")

    def finish(self):
        if self.unread:
            keys = ", ".join(f"{self.path}/{key}" for key in sorted(self.unread))
            raise Unsupported(f"not exported: {keys}")


def as_colour(value, path):
    colour = np.array(value, dtype=float)
    if colour.shape not in ((), (3,)):
        raise Unsupported(f"{path}: expected a number or three")
    return np.broadcast_to(colour, (3,)).copy()
