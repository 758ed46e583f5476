"""Known mistakes about how neighbours push each other, and about the mean of the neighbours."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M


def lengths(ways):
    return np.linalg.norm(ways, axis=-1, keepdims=True)


def one_over(ways):
    """A vector along each way that is one over its length long; zero for a way of no length."""
    squared = lengths(ways) ** 2
    return ways / np.where(squared > 0, squared, 1.0)


def total(shape, i, j, on_i, on_j):
    found = np.zeros(shape)
    np.add.at(found, i, on_i)
    np.add.at(found, j, on_j)
    return found


def last_of_several(shape, i, j, on_i, on_j):
    found = np.zeros(shape)
    found[i] += on_i
    found[j] += on_j
    return found


def replaced(shape, i, j, on_i, on_j):
    found = np.zeros(shape)
    found[i] = on_i
    found[j] = on_j
    return found


def counted(value, i, j):
    return np.bincount(i, minlength=len(value)) + np.bincount(j, minlength=len(value))


def summed(push=one_over, adds=total, first=1, second=-1, over=None):
    """What each neighbour adds, times a sign for the first and for the second of a pair."""

    def found(position, i, j):
        p, i, j = np.asarray(position, dtype=float), np.asarray(i), np.asarray(j)
        own = push(p[i] - p[j])
        answer = adds(p.shape, i, j, first * own, second * own)
        return answer if over is None else answer / over(p, i, j)[:, None]

    return found


def at_least_one(value, i, j):
    return np.maximum(counted(value, i, j), 1)


def everybody(value, i, j):
    return np.full(len(value), max(len(value), 1))


def all_others(value, i, j):
    return np.full(len(value), max(len(value) - 1, 1))


def nobody_left_out(value, i, j):
    return counted(value, i, j) + 1


def of_all(rule):
    """As if everybody were everybody's neighbour."""

    def found(value, i, j):
        first, second = np.triu_indices(len(value), 1)
        return rule(value, first, second)

    return found


def largest(ways):
    size = np.max(np.abs(ways), axis=-1, keepdims=True)
    return ways / np.where(size > 0, size, 1.0) ** 2


def per_axis(ways):
    return np.where(ways != 0, 1 / np.where(ways != 0, ways, 1.0), 0.0)


def over_power(power):
    return lambda ways: ways / np.where(lengths(ways) > 0, lengths(ways), 1.0) ** power


def nearest_alone(position, i, j):
    p = np.asarray(position, dtype=float)
    found = np.zeros(p.shape)
    for at in range(len(p)):
        others = [b for a, b in zip(i, j, strict=True) if a == at] + [a for a, b in zip(i, j, strict=True) if b == at]
        apart = [other for other in others if np.any(p[other] != p[at])]
        if apart:
            near = min(apart, key=lambda other: float(np.linalg.norm(p[other] - p[at])))
            found[at] = one_over(p[at] - p[near])
    return found


def no_guard(ways):
    return ways / lengths(ways) ** 2


def middle(position, i, j):
    """Away from the mean place of the neighbours."""
    p = np.asarray(position, dtype=float)
    return one_over(-mean()(p, i, j))


# Towards the mean


def itself(ways):
    return ways


def mean(adds=total, first=-1, second=1, over=at_least_one):
    return summed(itself, adds, first, second, over)


def mean_alone(value, i, j):
    """The mean of the neighbours, without the own value being subtracted."""
    x = np.asarray(value, dtype=float)
    return (mean()(x, i, j) + x) * (counted(x, np.asarray(i), np.asarray(j)) > 0)[:, None]


def back_to_zero(value, i, j):
    """Without neighbours the mean is taken for zero."""
    x = np.asarray(value, dtype=float)
    return np.where((counted(x, np.asarray(i), np.asarray(j)) > 0)[:, None], mean()(x, i, j), -x)


def own_more_than_once(value, i, j):
    """The sum of the neighbours' values, less the own value once."""
    x = np.asarray(value, dtype=float)
    count = counted(x, np.asarray(i), np.asarray(j))[:, None]
    return np.where(count > 0, mean()(x, i, j) * count + (count - 1) * x, 0.0)


# fmt: off
BANK = (
    M("separation", "attracts", summed(first=-1, second=1),
      "Neighbours are drawn together. The push on i points along p_i − p_j, away from j.",
      "Boid 0 is at 0 and boid 1 at +2. Which sign has the push on boid 0?"),
    M("separation", "first of a pair alone", summed(second=0),
      "Only the first boid of each pair is pushed. The second one is as much a neighbour of the first.",
      "Boids 0 and 1 are a pair. Who is pushed?"),
    M("separation", "second of a pair alone", summed(first=0),
      "Only the second boid of each pair is pushed. The first one is as much a neighbour of the second.",
      "Boids 0 and 1 are a pair. Who is pushed?"),
    M("separation", "same push on both", summed(second=1),
      "Both boids of a pair are pushed in the same direction. They should be pushed in opposite ones.",
      "What is the sum of both pushes of a pair?"),
    M("separation", "size one", summed(over_power(1)),
      "Each neighbour pushes with the size 1, whatever its distance. A near one should push more.",
      "How large is your push at a distance of 10 m, and at 10 cm?"),
    M("separation", "one over the square", summed(over_power(3)),
      "The push is one over the square of the distance. A vector over the square of its length is one over its length"
      " long already.",
      "How long is a vector of 4 m over 4², and how long over 4³?"),
    M("separation", "the way itself", summed(itself),
      "The push is as long as the distance: those far away push the most.",
      "How large is your push at a distance of 10 m, and at 10 cm?"),
    M("separation", "last of several", summed(adds=last_of_several),
      "`found[first] += push` adds once for each index, even if the index occurs several times: only the last push of"
      " each boid is kept. `np.add.at(found, first, push)` adds them all.",
      "What does a boid feel that has two neighbours in your function?"),
    M("separation", "last one replaces the others", summed(adds=replaced),
      "Each push replaces the ones before it. The pushes of all neighbours add up.",
      "What does a boid feel that has two neighbours in your function?"),
    M("separation", "mean of the pushes", summed(over=at_least_one),
      "The sum is divided by the number of neighbours. More neighbours should push more.",
      "Two neighbours on the same side push. Is this more than one of them does?"),
    M("separation", "everybody is a neighbour", of_all(summed()),
      "All others push. Only those in a pair with a boid are its neighbours.",
      "Which arguments make no difference to your answer?"),
    M("separation", "nearest neighbour alone", nearest_alone,
      "Only the nearest neighbour pushes. The pushes of all neighbours add up.",
      "A boid has neighbours on its left and in front of it. Which way is it pushed?"),
    M("separation", "away from their middle", middle,
      "The boid is pushed away from the mean place of its neighbours. Each of them should push by itself: two on"
      " opposite sides do not cancel unless they are equally near.",
      "One neighbour is 1 m to the left, another 3 m to the right. Which way is the boid pushed?"),
    M("separation", "largest component for the length", summed(largest),
      "The distance is taken for its largest component.",
      "How long is (3, 4)?"),
    M("separation", "one over each component", summed(per_axis),
      "One over each component is taken. The vector as a whole is divided by the square of its length.",
      "How large is your push on a boid whose neighbour is nearly straight above it?"),
    M("separation", "no number at the same place", summed(no_guard),
      "For two boids at the same place 0/0 is not a number, and every boid beside them loses its push.",
      "What does the description say of neighbours at the same place?"),
    M("separation", "over everybody", summed(over=everybody),
      "The sum is divided by the size of the flock.",
      "Somebody joins the flock far away. Should this change your push?"),

    M("towards_mean", "away from the mean", mean(first=1, second=-1),
      "The sign is wrong: the result is the own value less the mean.",
      "Your neighbour is at +2 and you are at 0. Which sign should the result have?"),
    M("towards_mean", "first of a pair alone", summed(itself, first=-1, second=0, over=lambda x, i, j: np.maximum(
        np.bincount(i, minlength=len(x)), 1)),
      "Only the second boids of the pairs are taken for neighbours. The first one of a pair is a neighbour of the"
      " second as well.",
      "Boids 0 and 1 are a pair. Who has a neighbour?"),
    M("towards_mean", "second of a pair alone", summed(itself, first=0, second=1, over=lambda x, i, j: np.maximum(
        np.bincount(j, minlength=len(x)), 1)),
      "Only the first boids of the pairs are taken for neighbours. The second one of a pair is a neighbour of the first"
      " as well.",
      "Boids 0 and 1 are a pair. Who has a neighbour?"),
    M("towards_mean", "oneself in the mean", mean(over=nobody_left_out),
      "The own value is part of the mean. A boid is no neighbour of itself.",
      "You have one neighbour. What is the mean over your neighbours?"),
    M("towards_mean", "sum for mean", mean(over=None),
      "The differences are added up and not divided by the number of neighbours.",
      "Ten neighbours are all at +2, and you are at 0. How far is their mean?"),
    M("towards_mean", "over everybody", mean(over=everybody),
      "The sum is divided by the size of the flock, and not by the number of neighbours.",
      "Somebody joins the flock far away. Should this change your mean?"),
    M("towards_mean", "over all others", mean(over=all_others),
      "The sum is divided by the number of all others, and not by the number of neighbours.",
      "Somebody joins the flock far away. Should this change your mean?"),
    M("towards_mean", "mean of everybody", of_all(mean()),
      "The mean is that of all others. Only those in a pair with a boid are its neighbours.",
      "Which arguments make no difference to your answer?"),
    M("towards_mean", "mean alone", mean_alone,
      "The result is the mean of the neighbours. The own value is to be subtracted from it.",
      "All boids have the same value. What should the result be?"),
    M("towards_mean", "back to zero without neighbours", back_to_zero,
      "For a boid without neighbours the mean is taken for zero, so that minus its own value is left.",
      "What does the description say of a boid without neighbours?"),
    M("towards_mean", "own value once", own_more_than_once,
      "The own value is subtracted once from the sum of the neighbours' values, and not from their mean.",
      "Ten neighbours are all at +2, and so are you. What should the result be?"),
    M("towards_mean", "last of several", mean(last_of_several),
      "`found[first] += value` adds once for each index, even if the index occurs several times: only the last"
      " neighbour of each boid is kept. `np.add.at(found, first, value)` adds them all.",
      "What is the mean for a boid that has two neighbours in your function?"),
    M("towards_mean", "last one replaces the others", mean(replaced, over=None),
      "Each neighbour replaces the ones before it.",
      "What is the mean for a boid that has two neighbours in your function?"),
    M("towards_mean", "same on both", mean(second=-1),
      "Both boids of a pair get the same difference. They should get opposite ones.",
      "You are at 0 and your neighbour is at +2. Which way is it to you from there?"),
    M("towards_mean", "no number without neighbours", mean(over=counted),
      "For a boid without neighbours 0/0 is not a number.",
      "What does the description say of a boid without neighbours?"),
)
# fmt: on
