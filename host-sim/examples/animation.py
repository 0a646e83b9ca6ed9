#!/usr/bin/env python3
"""Writes the moving picture of the README: a run of the solver as an SVG that plays by itself, in a browser and on a web page.

    cargo build --release
    python3 host-sim/examples/animation.py [SCENE.toml] [--out FILE.svg] [--program FILE]

The pictures are frames of the run, 40 a second: body, hand, spring and the reactions of the contacts, to scale. It needs Python 3.11 alone.
"""

import argparse
import json
import math
import pathlib
import subprocess
import tempfile
import tomllib

HERE = pathlib.Path(__file__).resolve().parent
RATE = 40  # pictures a second: a slip, which takes no time, takes one of them
REST = 1.0  # s, the last picture before it begins again
WIDTH = 760  # pixels
MARGIN = 0.025  # m around all that moves
FORCE = 0.004  # m for each N of an arrow
GROUND = 0.035  # m of ground that is drawn below a surface
# The colours of the plots.
COLOURS = {"normal": "#009e73", "friction": "#d55e00", "hand": "#e69f00", "body": "#0072b2"}
CONTACTS = 2  # so many have arrows


def run(program, scene):
    """The records of the run, one for each picture."""
    with tempfile.TemporaryDirectory() as folder:
        trace = pathlib.Path(folder) / "trace.jsonl"
        subprocess.run([program, "run", scene, "--quiet", "--out", trace], check=True)
        records = [json.loads(line) for line in trace.read_text(encoding="utf-8").splitlines()]
    every = round(1 / (RATE * (records[1]["t"] - records[0]["t"])))
    return records[::every] + [records[-1]]


def corners(body):
    """The corners of a body, in its frame."""
    if "vertices" in body:
        return body["vertices"]
    x, y = (side / 2 for side in body["rectangle"])
    return [[-x, -y], [x, -y], [x, y], [-x, y]]


def placed(pose, point):
    """A point of the body in the world."""
    x, y, theta = pose
    c, s = math.cos(theta), math.sin(theta)
    return x + c * point[0] - s * point[1], y + s * point[0] + c * point[1]


class Window:
    """From the world to pixels: what is there over the whole run fits."""

    def __init__(self, points):
        xs, ys = zip(*points)
        self.left, self.top = min(xs) - MARGIN, max(ys) + MARGIN
        self.scale = WIDTH / (max(xs) + MARGIN - self.left)
        self.height = round((self.top - min(ys) + MARGIN) * self.scale)

    def __call__(self, point):
        return (point[0] - self.left) * self.scale, (self.top - point[1]) * self.scale

    def text(self, points):
        """Points as SVG has them."""
        return " ".join(f"{x:.1f},{y:.1f}" for x, y in map(self, points))


class Film:
    """What has the same times in every moving part."""

    def __init__(self, times):
        self.seconds = times[-1] + REST
        self.times = ";".join(f"{t / self.seconds:.4f}" for t in [*times, self.seconds])

    def of(self, attribute, values, tag="animate", more=""):
        """One attribute over time."""
        values = [*values, values[-1]]
        if len(set(values)) == 1:
            return ""
        return (
            f'<{tag} attributeName="{attribute}" {more}dur="{self.seconds:.3f}s" repeatCount="indefinite" '
            f'keyTimes="{self.times}" values="{";".join(values)}"/>'
        )

    def line(self, lines, style):
        """A line whose ends move: pairs of points in pixels."""
        ends = {
            name: [f"{end[i][k]:.1f}" for end in lines] for name, i, k in [("x1", 0, 0), ("y1", 0, 1), ("x2", 1, 0), ("y2", 1, 1)]
        }
        begin = " ".join(f'{name}="{values[0]}"' for name, values in ends.items())
        return f'<line {begin} {style}>{"".join(self.of(name, values) for name, values in ends.items())}</line>'

    def shown(self, present, element):
        """An element that is there in some pictures."""
        values = ["1" if here else "0" for here in present]
        return f'<g opacity="{values[0]}">{self.of("opacity", values, more=DISCRETE)}{element}</g>'


DISCRETE = 'calcMode="discrete" '


def normals(scene):
    """The unit normal of each surface, by its name in traces."""
    named = {}
    for k, surface in enumerate(scene.get("surface", [])):
        x, y = surface["normal"]
        named[surface.get("name", str(k))] = (x / math.hypot(x, y), y / math.hypot(x, y))
    return named


def ground(scene, window, span):
    """Surfaces, as far as they are seen, and obstacles."""
    shapes = [obstacle["vertices"] for obstacle in scene.get("obstacle", [])]
    for (nx, ny), surface in zip(normals(scene).values(), scene.get("surface", []), strict=True):
        foot = [nx * surface["offset"], ny * surface["offset"]]
        ends = [[foot[0] + side * span * ny, foot[1] - side * span * nx] for side in (-1, 1)]
        shapes.append([*ends, *[[x - GROUND * nx, y - GROUND * ny] for x, y in reversed(ends)]])
    return "".join(f'<polygon class="ground" points="{window.text(shape)}"/>' for shape in shapes)


def arrows(records, named, window, film):
    """The reactions of the contacts: N along the normal and T along the surface, at the foot."""
    drawn = ""
    for k in range(CONTACTS):
        for kind in ("normal", "friction"):
            lines = []
            for record in records:
                contact = record["contacts"][k] if k < len(record["contacts"]) else None
                if contact is None:
                    # Where the body is, without a length.
                    lines.append((window(record["pose"][:2]),) * 2)
                    continue
                nx, ny = contact.get("direction") or named[contact["surface"]]
                along = (nx, ny) if kind == "normal" else (ny, -nx)
                foot = contact["point"]
                tip = [foot[i] + FORCE * contact[kind] * along[i] for i in (0, 1)]
                lines.append((window(foot), window(tip)))
            present = [k < len(record["contacts"]) for record in records]
            style = f'stroke="{COLOURS[kind]}" stroke-width="6" stroke-linecap="round"'
            drawn += film.shown(present, film.line(lines, style))
    return drawn


def legend():
    """What the colours are."""
    parts, x = "", WIDTH - 16
    for name, colour in [("friction", "friction"), ("normal force", "normal"), ("hand and spring", "hand")]:
        x -= 9 * len(name)
        parts += f'<text x="{x}" y="30">{name}</text><path d="M{x - 26} 24h18" stroke="{COLOURS[colour]}" stroke-width="5"/>'
        x -= 46
    return parts


def drawn(scene, records, title):
    """The picture."""
    body, grip = corners(scene["body"]), scene.get("grasp", {}).get("point")
    if grip is None:
        raise SystemExit("the scene has no grasp.point, allowed: one that has, for the spring")
    moving = [placed(record["pose"], corner) for record in records for corner in body]
    hands = [record["hand"][:2] for record in records]
    window = Window(moving + hands)
    film = Film([record["t"] for record in records])
    moves = [window(record["pose"][:2]) for record in records]
    turns = [f"{-math.degrees(record['pose'][2]):.2f}" for record in records]
    # The body in its own frame, upwards as the picture has it.
    outline = " ".join(f"{x * window.scale:.1f},{-y * window.scale:.1f}" for x, y in body)
    springs = [(window(placed(record["pose"], grip)), window(record["hand"][:2])) for record in records]
    states = sorted({record["state"] for record in records})
    labels = "".join(
        film.shown([record["state"] == state for record in records], f'<text x="16" y="30">{state}</text>') for state in states
    )
    hand = [window(point) for point in hands]
    return f"""<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {window.height}" width="{WIDTH}" height="{window.height}" role="img">
<title>{title}</title>
<style>text{{font:18px sans-serif;fill:#333}}.ground{{fill:#ecebe7;stroke:#333;stroke-width:1.5}}</style>
<rect width="{WIDTH}" height="{window.height}" rx="8" fill="#fff"/>
{ground(scene, window, WIDTH / window.scale)}
<g transform="translate({moves[0][0]:.1f} {moves[0][1]:.1f})">{film.of("transform", [f"{x:.1f} {y:.1f}" for x, y in moves], "animateTransform", 'type="translate" ')}
<g transform="rotate({turns[0]})">{film.of("transform", turns, "animateTransform", 'type="rotate" ')}
<polygon points="{outline}" fill="{COLOURS["body"]}" fill-opacity="0.18" stroke="{COLOURS["body"]}" stroke-width="2.5"/>
<circle r="4" fill="{COLOURS["body"]}" cx="{grip[0] * window.scale:.1f}" cy="{-grip[1] * window.scale:.1f}"/></g></g>
{arrows(records, normals(scene), window, film)}
{film.line(springs, f'stroke="{COLOURS["hand"]}" stroke-width="4"')}
<circle r="7" fill="#fff" stroke="{COLOURS["hand"]}" stroke-width="3.5" cx="{hand[0][0]:.1f}" cy="{hand[0][1]:.1f}">{film.of("cx", [f"{x:.1f}" for x, _ in hand])}{film.of("cy", [f"{y:.1f}" for _, y in hand])}</circle>
{labels}
{legend()}
</svg>
"""


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("scene", nargs="?", type=pathlib.Path, default=HERE.parent / "scenes/table-edge.toml")
    parser.add_argument("--out", type=pathlib.Path, default=HERE.parent / "animation.svg")
    parser.add_argument("--program", type=pathlib.Path, default=HERE.parents[1] / "target/release/stiction")
    args = parser.parse_args()
    scene = tomllib.loads(args.scene.read_text(encoding="utf-8"))
    title = "A box is pushed over the edge of a table by a hand and its spring: it sticks, slips, tips about the corner"
    text = drawn(scene, run(args.program, args.scene), title if "table-edge" in args.scene.name else args.scene.stem)
    args.out.write_text(text, encoding="utf-8", newline="\n")
    print(f"{args.out}: {len(text)} bytes")


if __name__ == "__main__":
    main()
