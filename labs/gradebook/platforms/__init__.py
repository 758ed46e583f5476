"""What other platforms take: each has a module here that turns a grade into its format and checks the result.

The modules are copied to the platform together with the project, and run there. `bundles.py` writes what is uploaded.
"""
