"""When a submission came: time stamps with zones as platforms write them, and words of how late it was.

A zone may be an offset (`+01:00`, `+0100`, `UTC+1`), a name (`America/Los_Angeles`) or an abbreviation (`PST`). An
abbreviation may mean several zones: `CST` is used in Chicago and in Shanghai. The zone of the deadline then decides,
and where it does not, nobody guesses.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime, timedelta, timezone, tzinfo
from functools import cache
from zoneinfo import ZoneInfo, available_timezones

from labs.gradebook.sheets import plain

_STAMP = re.compile(r"(\d{4}-\d\d-\d\d[T ]\d\d:\d\d(?::\d\d(?:[.,]\d+)?)?) *(.*)")
_OFFSET = re.compile(r"(?:UTC|GMT)? ?([+-])(\d{1,2})(?::?([0-5]\d))?", re.IGNORECASE)
_UNIVERSAL = ("Z", "UTC", "UT", "GMT")
_CLOCK = re.compile(r"\b(\d{1,2})\s?[:h]\s?(\d\d)\b(?::\d\d)?(?:\s*([ap])\.?\s?m\b)?", re.IGNORECASE)
_AMOUNT = re.compile(r"\b(\d{1,6})\s*([^\W\d]+)")


@dataclass(frozen=True)
class Received:
    """When a submission came, as far as its platform says.

    stamp: the time as the platform wrote it. at: the same, read; without a zone it is on the clock of the deadline.
    late_by: how long after the platform's own deadline. called_late: whether the platform calls it late. says_lateness:
    whether it would do so.
    """

    stamp: str = ""
    at: datetime | None = None
    late_by: timedelta | None = None
    called_late: bool = False
    says_lateness: bool = False

    def after(self, due: datetime, everybodys: datetime | None = None) -> timedelta | None:
        """How long after a deadline it came; negative if before it, None if nobody knows.

        everybodys: the deadline that the platform has, if it differs from that of this student.
        """
        at = self.at or moment(self.stamp, due)
        if at is not None:
            return (at if at.tzinfo else at.replace(tzinfo=due.tzinfo)) - due
        return None if self.late_by is None else self.late_by + ((everybodys or due) - due)


def moment(value: object, due: datetime | None = None) -> datetime | None:
    """A time with its zone, from what a platform writes; None if it is none.

    due: a deadline, whose zone decides between those that an abbreviation may mean.
    """
    if isinstance(value, datetime):
        return value if value.tzinfo else None
    found = _STAMP.fullmatch(" ".join(str(value).split()))
    try:
        clock = datetime.fromisoformat(found[1]) if found else datetime.fromisoformat(str(value).strip())
    except ValueError:
        return None
    zone = clock.tzinfo or (_zone(found[2], clock, due) if found else None)
    return clock.replace(tzinfo=zone) if zone else None


def _zone(name: str, clock: datetime, due: datetime | None) -> tzinfo | None:
    """The zone of a name at a time of its clock; None if there is no such zone, or more than one."""
    if name.upper() in _UNIVERSAL:
        return UTC
    if found := _OFFSET.fullmatch(name):
        offset = timedelta(hours=int(found[2]), minutes=int(found[3] or 0))
        return timezone(-offset if found[1] == "-" else offset) if offset < timedelta(days=1) else None
    fit = [each for each in _zones().values() if each.tzname(clock) == name]
    offsets = {each.utcoffset(clock) for each in fit}
    if len(offsets) > 1 and due is not None:
        offsets = {each.utcoffset(clock) for each in fit if due.astimezone(each).utcoffset() == due.utcoffset()}
    if not fit:
        return _zones().get(name)
    return next((timezone(each) for each in offsets if each is not None), None) if len(offsets) == 1 else None


@cache
def _zones() -> Mapping[str, ZoneInfo]:
    """Every zone that this machine knows. None of them is looked up by a name that came from outside."""
    return {name: ZoneInfo(name) for name in sorted(available_timezones())}


def moment_in_words(text: str, months: Sequence[str]) -> datetime | None:
    """A time that is written out, such as `Friday, 4 December 2026, 2:14 PM`, without a zone; None if it is none."""
    clock = _CLOCK.search(text)
    if clock is None:
        return None
    words = re.findall(r"[^\W\d]+|\d+", plain(text[: clock.start()] + " " + text[clock.end() :]))
    names = [plain(each) for each in months]
    month = [names.index(each) + 1 for each in words if each in names]
    years = [int(each) for each in words if len(each) == 4 and each.isdecimal()]
    days = [int(each) for each in words if len(each) < 3 and each.isdecimal()]
    if not (len(month) == len(years) == len(days) == 1):
        return None
    hour, half = int(clock[1]), (clock[3] or "").lower()
    try:
        return datetime(years[0], month[0], days[0], hour % 12 + 12 * (half == "p") if half else hour, int(clock[2]))
    except ValueError:
        return None


def duration_in_words(text: str, minutes: Mapping[str, int]) -> timedelta | None:
    """A duration that is written out, such as `1 day 2 hours`; None if it is none. minutes: of each unit."""
    known = {plain(unit): each for unit, each in minutes.items()}
    found = [(int(amount), plain(unit)) for amount, unit in _AMOUNT.findall(text)]
    parts = [amount * known[unit] for amount, unit in found if unit in known]
    return timedelta(minutes=sum(parts)) if parts else None
