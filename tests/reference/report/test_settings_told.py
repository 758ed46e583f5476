"""What each implementation is told: a sentence for each setting, said once where all scenarios share it."""

from __future__ import annotations

from dataclasses import replace

from pages import REST, result

from reference.catalogue.scenarios import catalogue
from reference.comparison.results import JobResult
from reference.engines import engine_names, load_engine
from reference.engines.settings_in_words import sentence_and_value
from reference.report.sections import sections
from reference.report.settings_told import by_scenario, code_typed, everywhere, sentences

DROPPED = catalogue()["dropped-ball"]


def told(name: str, profile: str, *settings: str) -> JobResult:
    """The result of a family whose cases ran with these settings in turn."""
    given = result(REST, name, profile)
    cases = {case.name: settings[place % len(settings)] for place, case in enumerate(REST.cases)}
    return replace(given, rows=tuple(replace(row, settings=cases[row.case]) for row in given.rows))


def said(*settings: str, name: str = "pybullet") -> tuple[str, ...]:
    (section,) = sections([told(name, "stock", *settings)])
    return sentences(section.lines[0])


def test_each_setting_of_the_catalogue_has_a_sentence():
    for name in engine_names():
        engine = load_engine(name)
        settings = {
            engine.settings(case.scenarios[0], profile).describe()
            for family in catalogue().values()
            for case in family.cases
            for profile in engine.profiles(case.scenarios[0])
        }
        for setting in {setting for each in settings for setting in each.split(", ")}:
            sentence, value = sentence_and_value(name, setting)
            assert sentence.endswith("."), setting
            assert value == "" or "{" in sentence, setting


def test_a_value_is_told_in_its_unit_and_where_the_cases_differ():
    assert said("timestep 0.001 s") == ("A timestep is 1 ms long (`setTimeStep`).",)
    assert said("margin 1e-09") == ("The ground is 10⁻⁹ m higher, so that rounding cannot part a body from it.",)
    assert said("contact erp 0.5", "contact erp 0.2") == (
        "Of an overlap, each step takes back the share 0.5 or 0.2 (`contactERP`), depending on the case.",
    )
    assert said("ground box", "ground plane", "ground plane")[1] == (
        "The ground is a plane (`GEOM_PLANE`), in 2 of 3 cases."
    )


def test_a_setting_without_a_sentence_is_shown_as_it_is():
    assert said("warp {factor} 9, timestep 0.001 s")[0] == "warp {factor} 9"
    assert said("contact erp 0.5", name="mujoco") == ("contact erp 0.5",)


def test_what_all_scenarios_share_is_said_once_and_the_same_again_is_a_link():
    shared, own = "split impulse True", ("contact erp 0.5", "contact erp 0.2")
    families = [DROPPED, REST, catalogue()["stack"]]
    found = sections(
        replace(
            (given := result(family, "pybullet", "tuned")),
            rows=tuple(replace(row, settings=f"{shared}, {told}") for row in given.rows),
        )
        for family, told in zip(families, (own[0], own[0], own[1]), strict=True)
    )
    (common,) = everywhere(found)
    assert [sentence[:21] for sentence in common.sentences] == ["Taking back an overla"]
    here = by_scenario(found, [common])
    assert [told.as_in and told.as_in.family.name for (told,) in here.values()] == [None, "dropped-ball", None]
    assert {told.sentences for (told,) in here.values()} == {said(setting) for setting in own}
    assert everywhere(found[:1]) == []


def test_code_is_typed_and_everything_is_escaped():
    assert code_typed("<b> (`a<b` = 1).") == "&lt;b&gt; (<code>a&lt;b</code> = 1)."
