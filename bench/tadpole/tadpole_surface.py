#!/usr/bin/env python3
"""Write the surface of a tadpole, a round head with a soft tail that flattens, as curved triangles (.msh of gmsh, format 2.2).

    bench/tadpole/tadpole_surface.py FILE.msh [--around N] [--step S]

Lengths are in mm. The body's axis is x, its nose looks along -x. Cross sections are ellipses; the physical surfaces
"head" and "tail" meet in the plane x = 0, where the elastic part begins.
"""
import argparse
import math

NOSE, HEAD, FIN, TIP = -1.6, -0.6, 5.9, 6.4  # x where the body begins, is as thick as it gets, narrows again, ends


def half_height(x):
    """Along y, the way that the fin bends."""
    if x < HEAD:
        return 0.75 * math.sqrt(max(0.0, 1 - ((x - HEAD) / (NOSE - HEAD)) ** 2))
    slim = 0.75 - 0.25 * smooth(x / 3.0)
    return slim * end(x)


def half_width(x):
    """Along z."""
    if x < HEAD:
        return half_height(x)
    return 0.75 * end(x)


def smooth(s):
    s = min(max(s, 0.0), 1.0)
    return s * s * (3 - 2 * s)


def end(x):
    return 1.0 if x < FIN else math.sqrt(max(0.0, 1 - ((x - FIN) / (TIP - FIN)) ** 2))


def rings(step):
    """Places along x, dense where the ends are round; x = 0 is one of them."""
    def curved(center, pole, n):
        return [center + (pole - center) * math.sin(0.5 * math.pi * i / n) for i in range(1, n)]
    n_head, n_fin = max(1, round(-HEAD / step)), max(2, round(FIN / step))
    places = curved(HEAD, NOSE, max(3, round(1.6 * (HEAD - NOSE) / step)))[::-1]
    places += [HEAD * (1 - i / n_head) for i in range(n_head)] + [FIN * i / n_fin for i in range(n_fin + 1)]
    return places + curved(FIN, TIP, max(4, round(1.6 * (TIP - FIN) / step)))


def between(x, y):
    """The place in the middle of an edge along the body: on round ends in the middle of the arc."""
    for center, pole in ((HEAD, NOSE), (FIN, TIP)):
        s, t = (x - center) / (pole - center), (y - center) / (pole - center)
        if min(s, t) >= 0 and max(s, t) > 0:
            return center + (pole - center) * math.sin(0.5 * (math.asin(min(1.0, s)) + math.asin(min(1.0, t))))
    return 0.5 * (x + y)


def triangles(around, step):
    """Nodes, and triangles of six of them with whether they are of the tail."""
    nodes, place, number = [], [], {}

    def add(x, phi):
        nodes.append((x, half_height(x) * math.cos(phi), half_width(x) * math.sin(phi)))
        place.append((x, phi))
        return len(nodes) - 1

    places = rings(step)
    vertex = [[add(x, 2 * math.pi * k / around) for k in range(around)] for x in places]
    poles = [add(NOSE, 0.0), add(TIP, 0.0)]

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in number:
            (x, phi), (y, psi) = place[a], place[b]
            if a in poles or b in poles:
                phi = psi = psi if a in poles else phi
            psi = phi + (psi - phi + math.pi) % (2 * math.pi) - math.pi
            number[key] = add(x if x == y else between(x, y), 0.5 * (phi + psi))
        return number[key]

    faces = []
    for i, (x, y) in enumerate(zip(places, places[1:])):
        for k in range(around):
            a, b = vertex[i][k], vertex[i][(k + 1) % around]
            c, d = vertex[i + 1][k], vertex[i + 1][(k + 1) % around]
            # Diagonals that mirror each other at y = 0 and z = 0.
            up = (4 * k // around) % 2 == 0
            faces += [((a, c, d) if up else (a, c, b), x + y > 0), ((a, d, b) if up else (b, c, d), x + y > 0)]
    for k in range(around):
        faces.append(((poles[0], vertex[0][k], vertex[0][(k + 1) % around]), False))
        faces.append(((poles[1], vertex[-1][(k + 1) % around], vertex[-1][k]), True))
    return nodes, [((a, b, c, middle(a, b), middle(b, c), middle(c, a)), tail) for (a, b, c), tail in faces]


def write(file, nodes, faces):
    with open(file, "w", encoding="ascii") as out:
        out.write("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"head\"\n2 2 \"tail\"\n"
                  "$EndPhysicalNames\n$Nodes\n%d\n" % len(nodes))
        for i, x in enumerate(nodes):
            out.write("%d %.9g %.9g %.9g\n" % (i + 1, *x))
        out.write("$EndNodes\n$Elements\n%d\n" % len(faces))
        for i, (face, tail) in enumerate(faces):
            out.write("%d 9 2 %d 1 %s\n" % (i + 1, 2 if tail else 1, " ".join(str(a + 1) for a in face)))
        out.write("$EndElements\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("file")
    parser.add_argument("--around", type=int, default=16, help="triangles around the body, a multiple of four")
    parser.add_argument("--step", type=float, default=0.3, help="between rings of triangles, mm")
    options = parser.parse_args()
    nodes, faces = triangles(options.around, options.step)
    write(options.file, nodes, faces)
    print("%s: %d triangles, %d of the tail" % (options.file, len(faces), sum(tail for _, tail in faces)))


if __name__ == "__main__":
    main()
