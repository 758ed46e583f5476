"""A lesson of the detection lab that tests make, and what its notebooks hold."""

from __future__ import annotations

from reference import lecture

HEAD = """---
jupyter:
  jupytext:
    text_representation:
      extension: .md
      format_name: markdown
---

# Detecting

```python lab="setup" lends="kinematic_response"
```

```python given="finite not_negative positive vector"
```
"""
WRITES = "".join(
    f'\n```python write="{entry.name}"\n```\n' for entry in lecture.functions_of("detection") if entry.role == "written"
)


def sources(notebook, kind="code"):
    """The cells of a kind, as text."""
    return ["".join(cell["source"]) for cell in notebook["cells"] if cell["cell_type"] == kind]
