"""Rings that become finer outwards, in Tyndall's window: rings.py [OUTPUT.png]. Needs nothing but Python itself."""
import ctypes
import math
import signal
import sys

library = ctypes.CDLL("libtyndall-watch.so.0")
Function = ctypes.CFUNCTYPE(None, ctypes.c_void_p, ctypes.c_double, ctypes.c_double, ctypes.c_uint64,
                            ctypes.POINTER(ctypes.c_double))


class Options(ctypes.Structure):
    """tyndall_watch_options of <tyndall/watch.h>."""
    _fields_ = [("size", ctypes.c_size_t), ("threads", ctypes.c_int), ("spp", ctypes.c_uint32),
                ("seed", ctypes.c_uint32), ("title", ctypes.c_char_p), ("output", ctypes.c_char_p),
                ("reference", ctypes.c_char_p)]


library.tyndall_watch.argtypes = [ctypes.c_int, ctypes.c_int, Function, ctypes.c_void_p, ctypes.POINTER(Options)]


@Function
def rings(user, x, y, sample, rgb):
    """A sample. Where it raises an exception, Python prints it, and the window tells the pixel."""
    grey = 0.5 + 0.5 * math.cos(0.01 * ((x - 80) ** 2 + (y - 60) ** 2))
    rgb[0], rgb[1], rgb[2] = grey, 0.9 * grey, 0.7 * grey


signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C: Python itself would wait until the window is closed
options = Options(size=ctypes.sizeof(Options), title=b"rings", spp=16)
if len(sys.argv) > 1:
    options.output = sys.argv[1].encode()
sys.exit(library.tyndall_watch(160, 120, rings, None, options))
