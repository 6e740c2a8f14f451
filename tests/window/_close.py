"""Asks a window to close, as the button in its title bar does. Argument: the window's number."""
import ctypes
import sys


class Message(ctypes.Structure):
    """XClientMessageEvent, padded to the size of XEvent."""

    _fields_ = [
        ("type", ctypes.c_int),
        ("serial", ctypes.c_ulong),
        ("send_event", ctypes.c_int),
        ("display", ctypes.c_void_p),
        ("window", ctypes.c_ulong),
        ("message_type", ctypes.c_ulong),
        ("format", ctypes.c_int),
        ("data", ctypes.c_long * 5),
        ("padding", ctypes.c_long * 24),
    ]


CLIENT_MESSAGE = 33
x11 = ctypes.CDLL("libX11.so.6")
x11.XOpenDisplay.restype = ctypes.c_void_p
x11.XInternAtom.restype = ctypes.c_ulong
display = ctypes.c_void_p(x11.XOpenDisplay(None))
window = ctypes.c_ulong(int(sys.argv[1]))
protocols = x11.XInternAtom(display, b"WM_PROTOCOLS", False)
message = Message(type=CLIENT_MESSAGE, window=window, message_type=protocols, format=32)
message.data[0] = x11.XInternAtom(display, b"WM_DELETE_WINDOW", False)
x11.XSendEvent(display, window, False, ctypes.c_long(0), ctypes.byref(message))
x11.XFlush(display)
x11.XCloseDisplay(display)
