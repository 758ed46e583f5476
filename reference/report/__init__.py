"""Rows and studies as tables in the terminal, as a page, as files and as figures."""
