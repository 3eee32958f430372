"""A GLB file as the tests in Python read it: its JSON, and its accessors as arrays."""

import json

import numpy


class Glb:
    def __init__(self, data):
        length = int.from_bytes(data[12:16], "little")
        self.json, self._blob = json.loads(data[20 : 20 + length]), data[28 + length :]

    def accessor(self, index):
        """float32 [count, components]"""
        info = self.json["accessors"][index]
        view = self.json["bufferViews"][info["bufferView"]]
        width = {"SCALAR": 1, "VEC3": 3, "VEC4": 4}[info["type"]]
        start = view.get("byteOffset", 0) + info.get("byteOffset", 0)
        values = numpy.frombuffer(self._blob, numpy.float32, info["count"] * width, start)
        return values.reshape(-1, width)
