"""Facts of the engines are whole sentences of their own, are said by the texts of the lab, and by nothing else."""

from __future__ import annotations

from pathlib import Path

import pytest

from reference.catalogue.apart import REASONS
from reference.catalogue.scenarios import catalogue
from reference.engines import facts

ROOT = Path(facts.__file__).parents[2]
FACTS = {
    name: value for name, value in vars(facts).items() if name.startswith(("PYBULLET", "MUJOCO", "DART", "NO_ENGINE"))
}
TEXTS = [text for family in catalogue().values() for text in (family.about, family.expected, *family.why)]
TEXTS += [reason for of_engines in REASONS.values() for reason in of_engines.values()]


@pytest.mark.parametrize("name", sorted(FACTS.keys() - {"PYBULLET_DAMPED"}))
def test_a_fact_is_a_whole_sentence_that_several_texts_say(name):
    fact = FACTS[name]
    assert fact.endswith(".")
    assert sum(fact in text for text in TEXTS) > 1


@pytest.mark.parametrize("words", ["no restitution", "damps every velocity", "(1 + v) v per second"])
def test_what_is_a_fact_is_said_in_no_other_words(words):
    for text in TEXTS:
        for fact in FACTS.values():
            text = text.replace(fact, "")
        assert words not in text


def test_facts_were_measured_with_the_versions_of_the_page_on_engines():
    page = " ".join((ROOT / "docs" / "engines.md").read_text(encoding="utf-8").split())
    assert f"The engines are {facts.MEASURED_WITH}," in page
