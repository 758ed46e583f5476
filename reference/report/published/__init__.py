"""The report on other people's cases: tables, page, terminal and figure."""
