"""Right answers spring by spring and node by node, in loops and plain numbers, with the parts of a mesh by place."""

import math

import numpy as np


def difference(p, i, j):
    return [float(a) - float(b) for a, b in zip(p[i], p[j], strict=True)]


def mesh_forces(mesh, position, velocity):
    edges, rest, stiffness, damping, mass, _ = mesh
    total = [[0.0, 0.0, 0.0] for _ in mass]
    for number, (i, j) in enumerate(edges):
        way, rate = difference(position, j, i), difference(velocity, j, i)
        long = math.sqrt(sum(x * x for x in way))
        if long == 0:
            continue
        closing = sum(x * v for x, v in zip(way, rate, strict=True)) / long
        tension = float(stiffness[number]) * (long - float(rest[number])) + float(damping[number]) * closing
        for axis in range(3):
            total[i][axis] += tension * way[axis] / long
            total[j][axis] -= tension * way[axis] / long
    return total


def mesh_step(mesh, position, velocity, acceleration, dt):
    mass, pinned = mesh[4], mesh[5]
    start = [[0.0] * 3 if held else list(map(float, v)) for held, v in zip(pinned, velocity, strict=True)]
    force = mesh_forces(mesh, position, start)
    each = acceleration if np.ndim(acceleration) == 2 else [acceleration] * len(mass)
    places, speeds = [], []
    for node in range(len(mass)):
        if pinned[node]:
            places.append(list(map(float, position[node])))
            speeds.append([0.0, 0.0, 0.0])
            continue
        a = [f / mass[node] + g for f, g in zip(force[node], each[node], strict=True)]
        v = [s + float(dt) * x for s, x in zip(start[node], a, strict=True)]
        places.append([p + float(dt) * s for p, s in zip(position[node], v, strict=True)])
        speeds.append(v)
    return places, speeds


def zeros_of(rows, columns):
    """Rank by elimination, with the largest pivot."""
    rows, rank = [list(map(float, row)) for row in rows], 0
    for _ in range(min(len(rows), columns)):
        size, r, c = max((abs(rows[r][c]), r, c) for r in range(rank, len(rows)) for c in range(columns))
        if size < 1e-9:
            break
        rows[rank], rows[r] = rows[r], rows[rank]
        for other in range(rank + 1, len(rows)):
            share = rows[other][c] / rows[rank][c]
            rows[other] = [a - share * b for a, b in zip(rows[other], rows[rank], strict=True)]
            rows[other][c] = 0.0
        rank += 1
    return rank


def row_of(position, i, j):
    way = difference(position, i, j)
    long = math.sqrt(sum(x * x for x in way)) or 1.0
    row = [0.0] * (3 * len(position))
    for axis in range(3):
        row[3 * i + axis], row[3 * j + axis] = way[axis] / long, -way[axis] / long
    return row


def diagonals(position, edges, candidates):
    rows = [row_of(position, int(i), int(j)) for i, j in edges]
    found, columns = [], 3 * len(position)
    for i, j in candidates:
        more = [*rows, row_of(position, int(i), int(j))]
        found.append(zeros_of(more, columns) > zeros_of(rows, columns))
        rows = more if found[-1] else rows
    return found


def timestep_bound(mesh):
    edges, _, stiffness, damping, mass, pinned = mesh
    least = math.inf
    for node in range(len(mass)):
        k = sum(float(each) for each, pair in zip(stiffness, edges, strict=True) if node in pair)
        c = sum(float(each) for each, pair in zip(damping, edges, strict=True) if node in pair)
        if not pinned[node] and k + c > 0:
            least = min(least, 2 * mass[node] / (c + math.sqrt(c * c + 2 * k * mass[node])))
    return float(least)


def mesh_sphere_contact(mesh, position, velocity, centre, radius, restitution=0.0, friction=0.0):
    places, speeds = [], []
    for p, v, held in zip(position, velocity, mesh[5], strict=True):
        away = [float(a) - float(b) for a, b in zip(p, centre, strict=True)]
        far = math.hypot(*away)
        if held or far >= radius:
            places.append(list(p))
            speeds.append(list(v))
            continue
        n = [x / far for x in away] if far > 0 else [0.0, 0.0, 1.0]
        places.append([c + float(radius) * x for c, x in zip(centre, n, strict=True)])
        across = sum(a * b for a, b in zip(v, n, strict=True))
        if across >= 0:
            speeds.append(list(v))
            continue
        along = [a - across * b for a, b in zip(v, n, strict=True)]
        slides = math.hypot(*along)
        left = max(0.0, slides - friction * (1 + restitution) * -across)
        kept = left / slides if slides > 0 else 0.0
        speeds.append([kept * a - restitution * across * b for a, b in zip(along, n, strict=True)])
    return places, speeds


def limit_strain(mesh, position, limit=0.1, iterations=1000):
    edges, rest, _, _, mass, pinned = mesh
    places = [[float(x) for x in each] for each in position]
    light = [0.0 if held else 1 / float(m) for held, m in zip(pinned, mass, strict=True)]
    for _ in range(int(iterations)):
        for (i, j), at_rest in zip(edges, rest, strict=True):
            way = difference(places, i, j)
            long, most = math.hypot(*way), float(at_rest) * (1 + limit)
            if at_rest > 0 and long > most and light[i] + light[j] > 0:
                for axis in range(3):
                    move = way[axis] * (1 - most / long) / (light[i] + light[j])
                    places[i][axis] -= light[i] * move
                    places[j][axis] += light[j] * move
    return places
