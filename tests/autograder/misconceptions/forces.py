"""Known mistakes of a step, of gravity, of drag and wind, and of a steady fall."""

import numpy as np

from labs.grading.diagnosis.misconceptions import Misconception as M
from labs.grading.diagnosis.misconceptions import col, direction, over, size

G = 6.67430e-11


def step(place, velocity):
    """A step from what it adds to the place and to the velocity, each in terms of (v, a, dt)."""

    def euler(p, v, a, dt):
        v, a, dt = np.asarray(v), np.asarray(a), col(dt)
        return p + place(v, a, dt), v + velocity(v, a, dt)

    return euler


def pull(power=3, towards=1.0, softened=lambda r, e: np.hypot(r, e), factor=G, masses=np.multiply, way=None):
    """Gravity from its parts."""

    def force(m1, m2, x1, x2, softening=0.0):
        d = np.asarray(x2, dtype=float) - x1
        r = softened(size(d), col(softening))
        line = d if way is None else way(d)
        return (
            towards
            * factor
            * col(masses(m1, m2))
            * line
            * np.where(r > 0, over(1.0, np.where(r > 0, r, 1)) ** power, 0)
        )

    return force


def never_apart(m1, m2, x1, x2, softening=0.0):
    """At the same place the quotient is 0/0."""
    d = np.asarray(x2, dtype=float) - x1
    return G * col(np.multiply(m1, m2)) * d / np.hypot(size(d), col(softening)) ** 3


def from_the_origin(m1, m2, x1, x2, softening=0.0):
    return pull()(m1, m2, 0 * np.asarray(x1), x2, softening)


def along_each_axis(d):
    """Each component by itself with the square of its own distance."""
    return np.sign(d) * over(size(d) ** 3, np.asarray(d) ** 2, 0.0)


def drag(relative=lambda v, u: v - u, factor=6 * np.pi, sign=-1.0, power=1, of=lambda r: r):
    """Stokes' drag from its parts."""

    def force(v, u, viscosity, radius):
        w = relative(np.asarray(v, dtype=float), np.asarray(u, dtype=float))
        return sign * factor * col(np.multiply(viscosity, of(np.asarray(radius)))) * w * size(w) ** (power - 1)

    return force


def fall(excess=lambda s, f: s - f, factor=2 / 9, radius=lambda r: r**2, sign=1.0, thick=lambda eta: eta):
    """A steady fall from its parts."""

    def velocity(r, dense, fluid, viscosity, gravity):
        r, dense, fluid = (np.asarray(each, dtype=float) for each in (r, dense, fluid))
        speed = factor * excess(dense, fluid) * radius(r) / thick(np.asarray(viscosity, dtype=float))
        return sign * col(speed) * gravity

    return velocity


def wind(relative=lambda v, w: v - w, factor=-0.5, length=size, way=lambda w: w, share=lambda a, c, d: a * c * d):
    """The force of a wind from its parts."""

    def force(v, w, area, coefficient, density):
        speed = relative(np.asarray(v, dtype=float), np.asarray(w, dtype=float))
        parts = (np.asarray(each, dtype=float) for each in (area, coefficient, density))
        return factor * col(share(*parts)) * length(speed) * way(speed)

    return force


# fmt: off
BANK = (
    M("explicit_euler", "semi-implicit", step(lambda v, a, dt: (v + a * dt) * dt, lambda v, a, dt: a * dt),
      "The velocity at the end of the step moves the body. That is semi-implicit Euler; the explicit one takes"
      " everything from the start.",
      "Which of your two lines comes first, and which velocity does the second one use?"),
    M("explicit_euler", "parabola", step(lambda v, a, dt: v * dt + a * dt**2 / 2, lambda v, a, dt: a * dt),
      "The place has a term with a dt²/2, as in a throw. Explicit Euler moves the body with the velocity at the start"
      " alone.",
      "Nothing but the velocity at the start may move the body. What else does in your function?"),
    M("explicit_euler", "place with a dt²", step(lambda v, a, dt: v * dt - a * dt**2, lambda v, a, dt: a * dt),
      "The acceleration moves the body against its own direction.",
      "Let go of a stone. Where is it after one step of explicit Euler?"),
    M("explicit_euler", "velocity against a", step(lambda v, a, dt: v * dt, lambda v, a, dt: -a * dt),
      "The acceleration is taken away from the velocity instead of added to it.",
      "Let go of a stone. How fast is it after one step, and in which direction?"),
    M("explicit_euler", "velocity stays", step(lambda v, a, dt: v * dt, lambda v, a, dt: 0 * a * dt),
      "The velocity stays as it was: nothing accelerates the body.",
      "Which argument makes no difference to your answer?"),
    M("explicit_euler", "place stays", step(lambda v, a, dt: 0 * v * dt, lambda v, a, dt: a * dt),
      "The body stays where it was.",
      "Where is a body that flies with 1 m/s after a second?"),
    M("explicit_euler", "mean of both velocities",
      step(lambda v, a, dt: 2 * v * dt + a * dt**2, lambda v, a, dt: a * dt),
      "The two velocities are added up and not averaged; and explicit Euler moves the body with the first one alone.",
      "How far does a body get in a second that flies with 1 m/s?"),
    M("explicit_euler", "without dt in the place", step(lambda v, a, dt: v + 0 * dt, lambda v, a, dt: a * dt),
      "The velocity is added to the place without the time: metres and metres per second do not add up.",
      "Halve the step. By how much does your body move then?"),
    M("explicit_euler", "without dt in the velocity", step(lambda v, a, dt: v * dt, lambda v, a, dt: a + 0 * dt),
      "The acceleration is added to the velocity without the time.",
      "Halve the step. By how much does your velocity change then?"),
    M("explicit_euler", "swapped", lambda p, v, a, dt: (v + a * col(dt), p + v * col(dt)),
      "The two results are in the wrong order: the place comes first.",
      "In which order does the description list the results?"),
    M("explicit_euler", "a dt² in the velocity", step(lambda v, a, dt: v * dt, lambda v, a, dt: a * dt**2 / 2),
      "The velocity gains a dt²/2. That is what a place gains; a velocity gains a dt.",
      "Which unit has a dt²?"),
    M("explicit_euler", "half a step of velocity",
      step(lambda v, a, dt: v * dt + a * dt**2 / 2, lambda v, a, dt: a * dt / 2),
      "The mean of the velocities at the start and at the end is taken for both results. The velocity at the"
      " end has the"
      " whole change, and the one at the start moves the body.",
      "A stone is let go. How fast is it after 1 s, and how fast was it on average?"),
    M("universal_gravity", "pushes away", pull(towards=-1.0),
      "Body 1 is pushed away from body 2.",
      "The Moon is up there. Which way does the Earth's pull on it point, and which way does your vector?"),
    M("universal_gravity", "r³ without direction", pull(power=3, way=direction),
      "The size is divided by r³ where there is a unit vector already: it needs r² then.",
      "Double the distance. By which factor should the force fall, and by which does yours?"),
    M("universal_gravity", "r² with the whole vector", pull(power=2),
      "The size G m1 m2/r² is multiplied with the whole vector from body 1 to body 2. That vector has the length r, so"
      " the force falls with 1/r only.",
      "How long is the vector that you multiply with G m1 m2/r²?"),
    M("universal_gravity", "1/r with the whole vector", pull(power=1),
      "The force does not become weaker with the distance.",
      "Double the distance. By which factor does your force fall?"),
    M("universal_gravity", "squared softening added to r", pull(softened=lambda r, e: r + e),
      "The softening length is added to the distance. The energy in the description has the root of the sum of their"
      " squares.",
      "How large is √(d² + ε²) for d = 3 m and ε = 4 m?"),
    M("universal_gravity", "softening left out", pull(softened=lambda r, e: r + 0 * e),
      "The softening makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("universal_gravity", "softening not squared", pull(softened=lambda r, e: np.sqrt(r**2 + e)),
      "The softening length is added to the square of the distance: metres to square metres.",
      "Which unit has what you take the root of?"),
    M("universal_gravity", "softened direction", pull(power=2, way=direction),
      "The unit vector points from body to body, and the size is G m1 m2/(d² + ε²). The energy in the description gives"
      " another size: its slope has d/(d² + ε²)^(3/2).",
      "Move the bodies closer and closer together. How large is the slope of the energy at d = 0?"),
    M("universal_gravity", "softened direction, away", pull(power=2, way=direction, towards=-1.0),
      "Body 1 is pushed away, and with softening the size is not the slope of the energy.",
      "The Moon is up there. Which way does the Earth's pull on it point, and which way does your vector?"),
    M("universal_gravity", "larger of distance and softening", pull(softened=np.maximum),
      "The larger of distance and softening length is taken. The energy in the description has the root of the sum of"
      " their squares.",
      "How large is √(d² + ε²) for d = 3 m and ε = 4 m?"),
    M("universal_gravity", "softened direction by the root", pull(power=3, way=lambda d: direction(d) * size(d) ** 2),
      "The direction has the length r² and not 1.",
      "Double the distance. By which factor should the force fall, and by which does yours?"),
    M("universal_gravity", "without G", pull(factor=1.0),
      "The constant of gravity is missing.",
      "How heavy is somebody of 70 kg on the Earth, by your function?"),
    M("universal_gravity", "acceleration", pull(masses=lambda m1, m2: m2 + 0 * np.asarray(m1)),
      "It is the acceleration of body 1 and not the force on it: its mass is missing.",
      "Which argument makes no difference to your answer?"),
    M("universal_gravity", "sum of the masses", pull(masses=np.add),
      "The masses are added up; the force has their product.",
      "Double one of the masses. By which factor does the force grow?"),
    M("universal_gravity", "NaN at the same place", never_apart,
      "At the same place the function returns NaN, because it divides zero by zero. The description says what it should"
      " return.",
      "What does your function divide by where both bodies are at the same place?"),
    M("universal_gravity", "from the origin", from_the_origin,
      "The position of body 1 is left out, as if it were in the origin.",
      "Move both bodies by the same vector. Does the force change?"),
    M("universal_gravity", "each axis by itself", pull(way=along_each_axis),
      "Each component is computed from its own distance. The square is that of the whole distance.",
      "How far apart are two bodies with (3, 4, 0) m between them?"),
    M("stokes_drag", "absolute velocity", drag(relative=lambda v, u: v + 0 * u),
      "The body's own velocity is taken, as slide 26 prints it. A leaf that drifts along with a river would be braked.",
      "A leaf drifts along with a river. What does your function say that it feels?"),
    M("stokes_drag", "along the motion", drag(sign=1.0),
      "The drag points along the motion through the fluid and makes the ball faster.",
      "Which way does honey drag a spoon that you pull to the right?"),
    M("stokes_drag", "velocities added", drag(relative=lambda v, u: v + u),
      "The velocities of ball and fluid are added up. What counts is their difference.",
      "A leaf drifts along with a river. How fast is it as seen from the water?"),
    M("stokes_drag", "diameter for radius", drag(factor=12 * np.pi),
      "The drag is twice too large: the diameter is taken for the radius.",
      "Slide 26 has K = 6πr. What is its r?"),
    M("stokes_drag", "half the radius", drag(factor=3 * np.pi),
      "The drag is half of what it should be. With the diameter the factor is 3π; here you are given the radius.",
      "Is your factor that of the radius or of the diameter?"),
    M("stokes_drag", "6 without π", drag(factor=6.0),
      "A factor π is missing.",
      "Slide 26 has K = 6πr. Which of these factors does your function have?"),
    M("stokes_drag", "square of the speed", drag(power=2),
      "The drag grows with the square of the speed. In a thick, slow flow it is proportional to the speed.",
      "Double the speed. By which factor does your force grow?"),
    M("stokes_drag", "area for radius", drag(factor=6 * np.pi, of=lambda r: r**2),
      "The drag has the square of the radius. It has the radius itself.",
      "Which unit has η r² v?"),
    M("stokes_drag", "area of the disc", drag(factor=np.pi, of=lambda r: r**2),
      "The drag is taken in proportion to the area of the ball as seen along the stream. In a thick fluid it is"
      " proportional to the radius.",
      "Which unit has η times an area times a speed?"),
    M("stokes_drag", "radius left out", drag(of=lambda r: 1 + 0 * r),
      "The radius makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("stokes_drag", "viscosity left out", lambda v, u, eta, r: drag()(v, u, 1 + 0 * np.asarray(eta), r),
      "The viscosity makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("stokes_drag", "speed for velocity", drag(relative=lambda v, u: 1 + 0 * (v - u), sign=-1.0),
      "The drag does not depend on the velocity.",
      "Which arguments make no difference to your answer?"),
    M("stokes_drag", "each component's size", drag(relative=lambda v, u: np.abs(v - u)),
      "The size of each component is taken, so that the drag points the same way whichever way the ball moves.",
      "Let the ball move the other way. Which way does your drag point then?"),
    M("terminal_velocity", "without buoyancy", fall(excess=lambda s, f: s + 0 * f),
      "The fluid that the ball displaces is left out, as on slide 26. A bubble would sink.",
      "A ball has the density of the fluid around it. Does it sink?"),
    M("terminal_velocity", "densities added", fall(excess=lambda s, f: s + f),
      "The two densities are added up, so that the fluid makes the ball heavier.",
      "Does a ball sink faster in water or in mercury?"),
    M("terminal_velocity", "against gravity", fall(sign=-1.0),
      "The sign is wrong: a heavy ball rises, and a bubble sinks.",
      "Which way does a stone move in water?"),
    M("terminal_velocity", "relative to the fluid's density", fall(excess=lambda s, f: (s - f) / np.where(f > 0, f, 1)),
      "The excess is divided by the density of the fluid. The weight of the ball less that of the displaced fluid is"
      " what the drag has to balance.",
      "What is left of your formula if the ball falls in a vacuum?"),
    M("terminal_velocity", "buoyant share of gravity",
      fall(excess=lambda s, f: np.where(s > 0, (s - f) / np.where(s > 0, s, 1), 0)),
      "The density of the ball cancels: what you computed is the share of gravity that is left, not the force.",
      "Make ball and fluid twice as dense. Does the ball fall as fast as before?"),
    M("terminal_velocity", "only sinks", fall(excess=lambda s, f: np.maximum(s - f, 0)),
      "A ball that is lighter than the fluid stays where it is. It rises.",
      "What does a bubble do?"),
    M("terminal_velocity", "size of the difference", fall(excess=lambda s, f: np.abs(s - f)),
      "The size of the difference is taken, so that a bubble sinks.",
      "What does a bubble do?"),
    M("terminal_velocity", "diameter for radius", fall(factor=8 / 9),
      "It is four times too fast: the diameter is taken for the radius.",
      "Is the argument the radius or the diameter?"),
    M("terminal_velocity", "radius not squared", fall(radius=lambda r: r),
      "The speed is taken in proportion to the radius. The weight grows with r³ and the drag with r.",
      "Double the radius. By which factor does the weight grow, and by which the drag?"),
    M("terminal_velocity", "radius cubed", fall(radius=lambda r: r**3),
      "The speed is taken in proportion to r³, as the weight is. The drag grows with r.",
      "Double the radius. By which factor does the weight grow, and by which the drag?"),
    M("terminal_velocity", "volume of a cube", fall(factor=4 / (3 * np.pi), radius=lambda r: r**2),
      "The volume is that of a cube with the ball's diameter.",
      "What is the volume of a ball?"),
    M("terminal_velocity", "4/3 forgotten", fall(factor=1 / 6),
      "The 4/3 of the volume of a ball is missing.",
      "What is the volume of a ball?"),
    M("terminal_velocity", "inverted factor", fall(factor=9 / 2),
      "The factor is upside down.",
      "Solve weight less buoyancy = drag for the velocity once more. Where do 4/3 and 6 end up?"),
    M("terminal_velocity", "radius for diameter", fall(factor=1 / 18),
      "It is four times too slow. With the diameter the factor would be 1/18; here you are given the radius.",
      "Is your factor that of the radius or of the diameter?"),
    M("terminal_velocity", "down is −z", lambda r, s, f, eta, g: fall()(r, s, f, eta, size(np.asarray(g)) * [0, 0, -1]),
      "The ball always falls along −z. It falls along gravity, wherever that points.",
      "Tilt the whole tank. Which way does your ball fall?"),
    M("terminal_velocity", "viscosity on top", fall(thick=lambda eta: 1 / eta),
      "The thicker the fluid, the faster the fall.",
      "Does a ball sink faster in water or in honey?"),
    M("wind_force", "absolute velocity", wind(relative=lambda v, w: v + 0 * w),
      "The wind is left out: only the body's own velocity counts.",
      "A balloon drifts with the wind. What does it feel?"),
    M("wind_force", "wind alone", wind(relative=lambda v, w: 0 * v - w),
      "The body's own velocity is left out, as if wind depended on the position alone, which is where slide 30"
      " lists it.",
      "You cycle as fast as the wind blows, in its direction. What do you feel?"),
    M("wind_force", "against the wind", wind(factor=0.5),
      "The force points against the wind.",
      "Which way does a leaf fly in the wind?"),
    M("wind_force", "velocities added", wind(relative=lambda v, w: v + w),
      "The velocities of body and wind are added up. What counts is their difference.",
      "You cycle as fast as the wind blows, in its direction. What do you feel?"),
    M("wind_force", "without the half", wind(factor=-1.0),
      "The ½ of the pressure ½ ρ v² is missing.",
      "How large is the pressure of air that is brought to rest?"),
    M("wind_force", "square of each component", wind(length=lambda w: np.abs(w)),
      "Each component is squared by itself. The size of the force is that of the whole relative velocity.",
      "The wind blows with 3 m/s along x and 4 m/s along y. In which direction is your force?"),
    M("wind_force", "square without sign", wind(length=lambda w: w),
      "Each component is squared, so that the force points the same way whichever way the wind blows.",
      "Let the wind blow from the other side. Which way does your force point?"),
    M("wind_force", "square without sign, along", wind(factor=0.5, length=lambda w: w),
      "Each component is squared, so that the force points the same way whichever way the wind blows.",
      "Let the wind blow from the other side. Which way does your force point?"),
    M("wind_force", "relative speed, along the wind", lambda v, w, a, c, d: 0.5 * col(np.multiply(a, c) * d) * size(
        np.asarray(v, dtype=float) - w) ** 2 * direction(np.asarray(w, dtype=float)),
      "The size is right, but the force points along the wind as felt by somebody at rest. It points along the"
      " wind that"
      " the body feels.",
      "You run through still air. Along which line does the air push you?"),
    M("wind_force", "speed times unit vector", wind(length=lambda w: 1.0),
      "The force is proportional to the speed. It grows with its square.",
      "Double the wind. By which factor does your force grow?"),
    M("wind_force", "cube of the speed", wind(length=lambda w: size(w) ** 2),
      "The force has the square of the speed times the whole relative velocity, which is a third factor of the speed.",
      "Double the wind. By which factor does your force grow?"),
    M("wind_force", "direction alone", wind(length=lambda w: 1.0, way=direction),
      "The force does not depend on how fast the wind blows.",
      "Double the wind. By which factor does your force grow?"),
    M("wind_force", "difference of squares", lambda v, w, a, c, d: -0.5 * col(np.multiply(a, c) * d) * (
        size(v) * np.asarray(v) - size(w) * np.asarray(w)),
      "The drag of the body in still air and the push of the wind on a body at rest are added up. The square is that of"
      " the relative velocity.",
      "A body flies at 2 m/s against a wind of 2 m/s. How fast does the air meet it?"),
    M("wind_force", "area left out", wind(share=lambda a, c, d: 0 * a + c * d),
      "The area makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("wind_force", "coefficient left out", wind(share=lambda a, c, d: a * d + 0 * c),
      "The drag coefficient makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("wind_force", "density left out", wind(share=lambda a, c, d: a * c + 0 * d),
      "The density of the air makes no difference.",
      "Which argument makes no difference to your answer?"),
    M("wind_force", "size for direction", lambda v, w, a, c, d: -0.5 * col(np.multiply(a, c) * d) * size(
        np.asarray(v, dtype=float) - w) ** 2 * np.ones(3),
      "The force has the same number along every axis: the direction of the relative velocity is missing.",
      "Along which line does the wind push?"),
)
# fmt: on
