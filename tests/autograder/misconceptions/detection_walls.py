"""Known mistakes of the puck between two walls: time that is lost, impacts that are counted twice or not at all."""

import math

from labs.grading.diagnosis.misconceptions import Misconception as M


def stepped(step, rounds=lambda dt, duration: round(duration / dt)):
    """A run whose every step gives the impacts in it, and the new place and velocity."""

    def run(position, velocity, length, dt, duration):
        x, v, count = position, velocity, 0
        for _ in range(rounds(dt, duration)):
            found, x, v = step(x, v, length, dt)
            count += found
        return count, x

    return run


def arrival(x, v, length):
    """The wall ahead, and the time until it; infinity at rest."""
    wall = length if v > 0 else 0.0
    return wall, (wall - x) / v if v else math.inf


def right(x, v, length, dt):
    count, left = 0, dt
    while (found := arrival(x, v, length))[1] <= left:
        x, v, count, left = found[0], -v, count + 1, left - found[1]
    return count, x + v * left, v


def once(after):
    """At most one impact in a step. after: where the puck is at the step's end, from wall, velocity and times."""

    def step(x, v, length, dt):
        wall, arrives = arrival(x, v, length)
        return (1, after(wall, v, arrives, dt), -v) if arrives <= dt else (0, x + v * dt, v)

    return step


def old_velocity(x, v, length, dt):
    """It turns round once, at the end of the step."""
    _, arrives = arrival(x, v, length)
    return (1, x + v * dt, -v) if arrives <= dt else (0, x + v * dt, v)


def at_the_step(x, v, length, dt):
    x += v * dt
    return (1, x, -v) if x <= 0 or x >= length else (0, x, v)


def touching(x, v, length, dt):
    """Right, and one more for a step that starts on a wall."""
    count, x_after, v_after = right(x, v, length, dt)
    leaves = (x == 0 and v > 0) or (x == length and v < 0)
    return count + leaves, x_after, v_after


def strict(x, v, length, dt):
    count, left = 0, dt
    while (found := arrival(x, v, length))[1] < left:
        x, v, count, left = found[0], -v, count + 1, left - found[1]
    return count, x + v * left, v


def one_wall(x, v, length, dt):
    arrives = (length - x) / v if v > 0 else math.inf
    return (1, length - v * (dt - arrives), -v) if arrives <= dt else (0, x + v * dt, v)


def steps_with_impact(x, v, length, dt):
    count, x, v = right(x, v, length, dt)
    return min(count, 1), x, v


def counted(count):
    """Another count of the right motion."""
    run = stepped(right)
    return lambda x, v, length, dt, duration: (
        count(x, v, length, duration, run(x, v, length, dt, duration)[0]), run(x, v, length, dt, duration)[1],
    )  # fmt: skip


def of_the_start(x, v, length, duration, count):
    return count + (x in (0, length) and not (x == 0 and v < 0) and not (x == length and v > 0))


def added_up(dt, duration):
    """How many steps fit before the clock, added up from dt, has reached the end."""
    time, count = 0.0, 0
    while time < duration:
        time, count = time + dt, count + 1
    return count


def with_speed(x, v, length, dt, duration):
    return stepped(right)(x, abs(v), length, dt, duration)


# fmt: off
BANK = (
    M("count_impacts", "rest of the step lost", stepped(once(lambda wall, v, arrives, dt: wall)),
      "A step in which the puck hits a wall ends at the wall: the clock runs on by Δt, and the puck does not. "
      "Half a step is lost at each impact, on average.",
      "Slide 3 backs up time. How much of the step is left when the puck is at the wall, and what does it do then?"),
    M("count_impacts", "one impact a step", stepped(once(lambda wall, v, arrives, dt: wall - v * (dt - arrives))),
      "The rest of the step is gone without a look at the other wall: only one impact in a step is seen, "
      "and a fast puck flies through the wall behind it.",
      "A puck needs 0.1 s from wall to wall. How many impacts does a step of 1 s hold?"),
    M("count_impacts", "old velocity for the rest", stepped(old_velocity),
      "The rest of the step is gone with the velocity of before the impact, through the wall.",
      "Which velocity does the puck have between the impact and the end of the step?"),
    M("count_impacts", "whole step after the impact", stepped(once(lambda wall, v, arrives, dt: wall - v * dt)),
      "After the impact the puck moves for a whole step, although a part of the step was over when it hit.",
      "The puck hits the wall after 3 ms of a step of 10 ms. How long does it move away from it in this step?"),
    M("count_impacts", "at the step", stepped(at_the_step),
      "The puck turns round at the end of the step in which it has left the strip, beyond the wall. "
      "Here every impact is to happen at its own instant.",
      "When exactly does the puck reach the wall? And where is it when it turns round in your run?"),
    M("count_impacts", "touching counts", stepped(touching),
      "A puck that stands on a wall at the start of a step and moves away from it is counted. "
      "Where a step ends on a wall, the same impact is counted twice.",
      "Which way must a puck on a wall move to hit it?"),
    M("count_impacts", "the start counts", counted(of_the_start),
      "A puck that starts on a wall is counted, even if it moves away from the wall or not at all.",
      "Which way must a puck on a wall move to hit it?"),
    M("count_impacts", "end of the step left out", stepped(strict),
      "An impact exactly at the end of a step is left to the next step, and after the last step there is none.",
      "A step ends exactly when the puck arrives. Has it hit the wall by then?"),
    M("count_impacts", "speed for velocity", with_speed,
      "The velocity loses its sign at the start: every puck sets off to the right.",
      "Which wall does a puck with a negative velocity reach first?"),
    M("count_impacts", "one wall", stepped(one_wall),
      "The puck turns round at x = length alone: the wall at x = 0 is not there.",
      "Where is the puck in the end if it starts to the left?"),
    M("count_impacts", "length left out", lambda x, v, length, dt, duration: stepped(right)(x, v, 1.0, dt, duration),
      "The walls are taken to be 1 m apart, whatever the length is.",
      "Which argument makes no difference to your answer?"),
    M("count_impacts", "one count a step", stepped(steps_with_impact),
      "It counts the steps in which something is hit, not the impacts: a step may hold several.",
      "Where in your loop is the count raised, and how often in one step?"),
    M("count_impacts", "start left out", counted(lambda x, v, length, duration, count: int(abs(v) * duration / length)),
      "The whole way is divided by the length. From the start to the first wall it is less than a length, "
      "unless the puck starts on a wall.",
      "A puck stands just before the wall it moves to. How far must it go for one impact, and how far for two?"),
    M("count_impacts", "there and back", counted(lambda x, v, length, duration, count: count // 2),
      "An impact is counted for each way there and back. There are two walls, and each of them is hit on that way.",
      "How often does a puck hit a wall until it is back where it started, with the same velocity?"),
    M("count_impacts", "steps cut down", stepped(right, lambda dt, duration: int(duration / dt)),
      "The number of steps is cut down to a whole number. Where rounding leaves the quotient just below one, "
      "as in 0.3/0.1, a step is lost.",
      "What does Python say to 0.3/0.1? And to int of it?"),
    M("count_impacts", "time added up", stepped(right, added_up),
      "The time is added up from steps and compared with the duration. Rounding leaves ten times 0.1 just below 1, "
      "and so one step too many is made.",
      "Add 0.1 ten times in Python. Is the sum less than 1?"),
    M("count_impacts", "one step too many", stepped(right, lambda dt, duration: round(duration / dt) + 1),
      "One step too many is made.",
      "How many steps does a run of no duration have?"),
)
# fmt: on
