"""The lecture by hand, one module per topic, in NumPy alone.

Every function takes arrays with any leading axes and broadcasts over them: one contact or a million is the same code.
Inputs are never modified.
"""
