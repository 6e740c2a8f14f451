"""Asks a window to close, as the button in its title bar does. Argument: the window's number."""
import ctypes
import sys

CLIENT_MESSAGE, FORMAT = 33, 32
x11 = ctypes.CDLL("libX11.so.6")
x11.XOpenDisplay.restype = ctypes.c_void_p
x11.XInternAtom.restype = ctypes.c_ulong
display, window = ctypes.c_void_p(x11.XOpenDisplay(None)), int(sys.argv[1])
protocols, delete = (x11.XInternAtom(display, name, False) for name in (b"WM_PROTOCOLS", b"WM_DELETE_WINDOW"))
# XClientMessageEvent, each of whose members takes a whole long, padded to the size of XEvent.
message = (ctypes.c_long * 24)(CLIENT_MESSAGE, 0, 0, 0, window, protocols, FORMAT, delete)
x11.XSendEvent(display, ctypes.c_ulong(window), False, ctypes.c_long(0), message)
x11.XFlush(display)
x11.XCloseDisplay(display)
