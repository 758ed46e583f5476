"""An exception put into its own thread, to be raised between two lines of the code that answers."""
# says: gave 0.0|raised|code that answers|PermissionError

import ctypes
import threading


def rebound_velocity(velocity, restitution):
    thread = ctypes.c_ulong(threading.get_ident())
    ctypes.pythonapi.PyThreadState_SetAsyncExc(thread, ctypes.py_object(GeneratorExit))
    return 0.0
