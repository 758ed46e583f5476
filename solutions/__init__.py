"""The lecture by hand, one package per topic, in NumPy alone.

Every function takes arrays with any leading axes and broadcasts over them, so that one
contact or a million is the same code. No function modifies its arguments.
"""
