"""Closed forms, each with its derivation: what theory says, and by how much a known method must differ from it.

Symbols: h drop height of the gap, e restitution, g gravity, v speed, μ friction, θ slope, dt timestep; SI throughout.
"""

from __future__ import annotations

import math

import numpy as np

from reference.arrays import Array


def fall_time(drop_height: float, gravity: float) -> float:
    """Time to fall from rest, s: h = g t²/2."""
    return math.sqrt(2 * drop_height / gravity)


def impact_speed(drop_height: float, gravity: float) -> float:
    """Speed after falling from rest, m/s: m v²/2 = m g h."""
    return math.sqrt(2 * gravity * drop_height)


def rebound_ratio(restitution: float, bounces: int = 1) -> float:
    """Height of the n-th rebound over the drop height: each impact scales the speed by e, so the height by e²."""
    return restitution ** (2 * bounces)


def bounce_times(drop_height: float, restitution: float, gravity: float, count: int) -> Array:
    """Instants of the first impacts, (count,), s: t1 (1 + 2e + 2e² + …), as the flight after impact n lasts 2 eⁿ t1."""
    flights = 2 * restitution ** np.arange(count, dtype=float)
    flights[0] = 1.0
    return np.asarray(fall_time(drop_height, gravity) * np.cumsum(flights))


def bounce_end(drop_height: float, restitution: float, gravity: float) -> float:
    """When a bouncing ball comes to rest, s: the geometric series t1 (1 + 2e/(1 − e)) = t1 (1 + e)/(1 − e).

    An elastic ball, e = 1, never stops: infinity.
    """
    if restitution >= 1:
        return math.inf
    return fall_time(drop_height, gravity) * (1 + restitution) / (1 - restitution)


def rebound_shift_at_step(
    drop_height: float, restitution: float, gravity: float, timestep: float, recovery: float = 0.0
) -> float:
    """Mean shift of the first apex, m, when a step method responds at the first step that begins in overlap.

    Semi-implicit Euler falls by v²/(2g) + v dt/2, so the speed at depth d obeys v²/(2g) = h + d − v dt/2. Over evenly
    spread drops the mean depth is v dt/2 and the mean speed is the true one. The rebound starts at −d, so v dt/2 too
    low, with e v, and its steps rise by (e v)²/(2g) + e v dt/2. A method that also takes back a share c of the overlap,
    without adding speed, starts c v dt/2 higher. Together: −(1 − e − c) v dt/2.
    """
    return -(1 - restitution - recovery) * impact_speed(drop_height, gravity) * timestep / 2


def stopping_distance(speed: float, friction: float, gravity: float) -> float:
    """Way that a block slides on the level until it stops, m: m v²/2 = μ m g d."""
    return speed**2 / (2 * friction * gravity)


def stopping_time(speed: float, friction: float, gravity: float) -> float:
    """Time that a sliding block takes to stop on the level, s: v = μ g t."""
    return speed / (friction * gravity)


def semi_implicit_stopping_shift(speed: float, timestep: float) -> float:
    """Shift of the stopping distance in a step method that moves with the already slowed velocity, m.

    The way is Σ v_i dt over i = 1 … N with v_i = v0 (1 − i/N): v0 dt (N − 1)/2 = v0²/(2μg) − v0 dt/2.
    """
    return -speed * timestep / 2


def incline_holds(friction: float, slope: float) -> bool:
    """Whether a block at rest stays at rest on a slope (rad): m g sin θ ≤ μ m g cos θ, so tan θ ≤ μ."""
    return math.tan(slope) <= friction


def incline_acceleration(friction: float, slope: float, gravity: float) -> float:
    """Acceleration down the slope, m/s²: g (sin θ − μ cos θ) where the block slides, 0 where it holds."""
    if incline_holds(friction, slope):
        return 0.0
    return gravity * (math.sin(slope) - friction * math.cos(slope))


def semi_implicit_sliding_shift(acceleration: float, timestep: float, duration: float) -> float:
    """Shift of the way that starts from rest in a step method, m: Σ a i dt² = a t²/2 + a t dt/2."""
    return acceleration * duration * timestep / 2


def spring_dashpot_restitution(damping_ratio: float) -> float:
    """Restitution of a contact made of a spring and a dashpot that never pulls; ζ = c/(2√(k m)), gravity left out.

    m x″ + c x′ + k x = 0 from x = 0, x′ = −v; contact ends when the force −k x − c x′ reaches zero, before x does. With
    s = √|1 − ζ²| that happens at ω s t = π − atan2(2ζs, 1 − 2ζ²), or artanh(2ζs/(2ζ² − 1)) in the overdamped case, and
    in every case the speed ratio there is exp(−ζ ω t). That artanh is 2 arcosh ζ, which keeps its digits at a large ζ.
    """
    zeta = damping_ratio
    s = math.sqrt(abs((1 - zeta) * (1 + zeta)))  # 1 − ζ² would lose digits near 1
    if s < 1e-9:
        return math.exp(-2.0)
    if zeta < 1:
        return math.exp(-(zeta / s) * (math.pi - math.atan2(2 * zeta * s, 1 - 2 * zeta * zeta)))
    return math.exp(-(zeta / s) * 2 * math.acosh(zeta))


def damping_ratio(restitution: float) -> float:
    """The ζ whose spring–dashpot contact has the given restitution, by bisection; infinite for e = 0, 0 for e = 1."""
    if restitution <= 0:
        return math.inf
    if restitution >= 1:
        return 0.0
    low, high = 0.0, 1.0
    while spring_dashpot_restitution(high) > restitution:
        high *= 2
    for _ in range(200):
        middle = (low + high) / 2
        low, high = (middle, high) if spring_dashpot_restitution(middle) > restitution else (low, middle)
    return (low + high) / 2


def spring_dashpot_exit_depth(damping_ratio: float, speed: float, stiffness: float) -> float:
    """Depth, m, at which a spring–dashpot contact that cannot pull lets go; stiffness per unit mass, 1/s².

    The depth is v/(s ω) exp(−ζ ω t) sin(s ω t) at the instant of `spring_dashpot_restitution`, with ω = √k; sinh in the
    overdamped case. There the force k x + c x′ is zero, so with the rebound speed e v the depth is 2 ζ e v/ω.
    """
    return 2 * damping_ratio * spring_dashpot_restitution(damping_ratio) * speed / math.sqrt(stiffness)


def coarse_contact(restitution: float, stiffness: float, timestep: float) -> float:
    """Share of the closing speed v by which a spring–dashpot contact that is stepped through may miss e.

    A method notices up to a step late that the bodies touch. The dashpot's deceleration leaps there from 0 to 2 ζ √k v:
    2 ζ √k dt of v. The spring's grows with the depth v t: ∫ k v t dt, (√k dt)²/2 of v. stiffness: k, per unit mass,
    1/s²; infinite for a contact of one step, to which this does not apply.
    """
    if math.isinf(stiffness):
        return 0.0
    steps = math.sqrt(stiffness) * timestep
    dashpot = 2 * damping_ratio(restitution) * steps if restitution > 0 else 0.0  # e = 0: dead in any case
    return dashpot + steps**2 / 2


def rolling_speed(speed: float) -> float:
    """Speed at which a solid sphere that set out sliding without spin rolls in the end, m/s: 5/7 of the first.

    Friction acts at the contact, so the angular momentum m v r + 2/5 m r² ω about a point of the floor stays: m v0 r =
    (1 + 2/5) m v r once ω r = v. A step method's friction impulses keep it just as well: no timestep shifts this.
    """
    return 5 / 7 * speed


def rolling_start(speed: float, friction: float, gravity: float) -> float:
    """When that sphere begins to roll, s: v0 − μ g t = 5/7 v0."""
    return 2 * speed / (7 * friction * gravity)


def rolling_way(speed: float, friction: float, gravity: float, time: float) -> float:
    """Way of that sphere, m, at a time after it began to roll: 12 v0²/(49 μ g) sliding, then at 5/7 v0."""
    start = rolling_start(speed, friction, gravity)
    return 6 / 7 * speed * start + rolling_speed(speed) * (time - start)


def semi_implicit_rolling_shift(speed: float, timestep: float) -> float:
    """Shift of that way in a step method, m: Σ v_i dt moves with the slowed velocity, −(v0 − 5/7 v0) dt/2."""
    return -(speed - rolling_speed(speed)) * timestep / 2


def incline_rolls(friction: float, slope: float) -> bool:
    """Whether a solid sphere let go on a slope (rad) rolls without slip: its friction 2/7 m g sin θ ≤ μ m g cos θ."""
    return math.tan(slope) <= 3.5 * friction


def rolling_acceleration(friction: float, slope: float, gravity: float) -> float:
    """Acceleration of a solid sphere down a slope, m/s²: 5/7 g sin θ rolling, g (sin θ − μ cos θ) slipping."""
    if incline_rolls(friction, slope):
        return 5 / 7 * gravity * math.sin(slope)
    return gravity * (math.sin(slope) - friction * math.cos(slope))


def rolling_ratio(friction: float, slope: float, gravity: float) -> float:
    """ω r/v of a solid sphere down a slope: 1 rolling; slipping, its spin grows with 5/2 μ g cos θ/r."""
    if incline_rolls(friction, slope):
        return 1.0
    return 2.5 * friction * gravity * math.cos(slope) / rolling_acceleration(friction, slope, gravity)


def spinning_impact(
    speed: float, surface_speed: float, restitution: float, friction: float, arm: float = 1.0
) -> tuple[float, float]:
    """Speed along the floor, m/s, and surface speed r ω left, m/s, after a spinning solid sphere has struck it.

    speed: of the impact, m/s. surface_speed: r ω before. arm: lever arm of friction as a share of r, below 1 where an
    engine lets it act inside the ball. The impulse along the floor is at most μ times the normal one,
    m (1 + e) v. It ends the slip u = r ω − v_x if it can: it changes u by −7/2 J/m, so J = 2/7 m r ω grips and leaves
    v_x = 2/7 r ω = r ω′. A smaller one slips through: v_x = J/m and r ω′ = r ω − 5/2 J/m. With a lever arm a r the
    slip is a r ω − v_x, J changes it by −(1 + 5/2 a²) J/m, and r ω by −5/2 a J/m.
    """
    grip = arm / (1 + 2.5 * arm**2) * abs(surface_speed)  # per unit mass
    impulse = math.copysign(min(friction * (1 + restitution) * speed, grip), surface_speed)
    return impulse, surface_speed - 2.5 * arm * impulse


def wall_impacts(distance: float, speed: float, restitution: float, count: int) -> Array:
    """Instants at which a ball meets two parallel walls in turn, (count,), s: each crossing takes 1/e of the last one.

    distance: free way between the walls, m, which it also has before the first impact.
    """
    return np.asarray(distance / speed * np.cumsum(restitution ** -np.arange(count, dtype=float)))


def tips(half_width: float, half_height: float, friction: float, slope: float) -> bool:
    """Whether a box at rest on a slope (rad) turns over its lower edge: tan θ > b/h, and friction holds, μ ≥ b/h.

    With μ < b/h the normal force under a sliding box still finds its place within the face, so that it slides upright.
    """
    return math.tan(slope) > half_width / half_height and friction > half_width / half_height


def impact_impulse(closing_speed: float, restitution: float, softness: float) -> float:
    """Impulse of an impact without friction, N s: it turns the closing speed v into e v, so j = (1 + e) v/k.

    softness: k, the speed that a unit impulse gives the two points of contact apart from each other, 1/kg: 1/m_A +
    1/m_B for balls, and for what turns as well `rod_softness`.
    """
    return (1 + restitution) * closing_speed / softness


def rod_softness(mass: float, arm: float, half_length: float, half_thickness: float) -> float:
    """A rod's part of k where it is struck across its length, an arm x from its centre, 1/kg.

    It is 1/m + x²/I with I = m (a² + c²)/3 of a box with half lengths a and c. At the end of a thin rod, x = a, that is
    4/m: there a rod is four times as easy to move as at its centre.
    """
    return (1 + 3 * arm**2 / (half_length**2 + half_thickness**2)) / mass


def balls_after(speed: float, offset: float, restitution: float, mass: float, other_mass: float) -> tuple[Array, Array]:
    """Velocities, (2,) each, m/s, of a smooth ball that flew along +x and of the ball at rest that it has struck.

    offset: distance of the second centre from the first one's line of flight, as a share of the sum of the radii, which
    is the sine of the angle α between that line and the line of centres. Velocities change along the line of centres
    alone: there the closing speed is v cos α, and the normal from the struck ball to the striker is (−cos α, sin α).
    """
    cosine = math.sqrt((1 - offset) * (1 + offset))
    impulse = impact_impulse(speed * cosine, restitution, 1 / mass + 1 / other_mass) * np.array([-cosine, offset])
    return np.array([speed, 0.0]) + impulse / mass, -impulse / other_mass


def cradle_in_turn(velocities: Array) -> Array:
    """Velocities, (n,), of a row of equal elastic balls after impacts of two at a time, from left to right.

    Two equal elastic balls swap their velocities, again and again, until no ball is faster than the next. So the
    velocities end up in increasing order.
    """
    return np.sort(velocities)


def cradle_at_once(velocities: Array, struck: int) -> Array:
    """Velocities, (n,), of a row of equal elastic balls that touch, after an impact between ball `struck` and the next.

    All that touch take part: the balls on the left move on as one, those on the right as well, b − a is the closing
    speed of the two that collide (Newton's rule), and momentum stays. Ball numbers from 0.
    """
    count, left = len(velocities), struck + 1
    closing = float(velocities[struck] - velocities[left])
    a = (float(np.sum(velocities)) - (count - left) * closing) / count
    return np.repeat([a, a + closing], [left, count - left])


def cradle_turned_back(velocities: Array) -> Array:
    """Velocities, (3,), of equal elastic balls that touch, if a rule reverses every contact, also one that separates.

    The first two close at c, the other two part at p. After u⁺ = −u⁻ at both contacts, b − a = c and z − b = −p, the
    last two approach, and swap their velocities in an impact of their own. Energy stays, as in every such reversal.
    """
    closing, parting = velocities[0] - velocities[1], velocities[2] - velocities[1]
    a = (float(np.sum(velocities)) - 2 * closing + parting) / 3
    return np.array([a, a + closing - parting, a + closing])
