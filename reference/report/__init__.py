"""Rows and studies to terminal, page, files and figures."""
