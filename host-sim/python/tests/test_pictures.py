"""Pictures as a reader sees them: what is where, how large, and in which color."""

import io
import re
import zlib

import matplotlib
import matplotlib.colors
import numpy as np
import pytest
import stiction
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from stiction import _sheet
from test_scenes import box

SCENES = ["corner-stick-slip", "ladder", "peg-in-hole", "plank-on-posts", "point-stick-slip", "table-edge"]
PICTURES = ["trajectory", "forces", "motion", "strip"]


def dragged():
    """The run of the README: the box is pressed 1 cm into the floor and dragged by 10 cm in a second."""
    hand = np.column_stack([np.linspace(0, 0.1, 1000), np.full(1000, 0.02), np.zeros(1000)])
    return stiction.Solver(box()).run(hand)


@pytest.fixture(scope="module")
def runs():
    made = {}
    for name in SCENES:
        scene = stiction.Scene.bundled(name)
        made[name] = stiction.Solver(scene).run(**scene.recorded(rate=200.0))
    return made


class Seen:
    """The pixels of a figure, found by the data of its axes."""

    def __init__(self, figure):
        figure.set_dpi(200)
        file = io.BytesIO()
        figure.savefig(file, format="rgba", dpi=figure.dpi)
        width, height = (int(side) for side in figure.bbox.size)
        self.pixels = np.frombuffer(file.getvalue(), np.uint8).reshape(height, width, 4)[::-1, :, :3]

    def near(self, axes, x, y, color, reach=2):
        """Whether a color is within some pixels of a place."""
        column, row = (int(at) for at in axes.transData.transform((x, y)))
        part = self.pixels[max(row - reach, 0) : row + reach + 1, max(column - reach, 0) : column + reach + 1].astype(int)
        wanted = 255 * np.array(matplotlib.colors.to_rgb(color))
        return bool((np.abs(part - wanted).max(axis=-1) < 60).any())

    def inside(self, axes, x, y):
        """The color at a place, as the mean of some pixels."""
        column, row = (int(at) for at in axes.transData.transform((x, y)))
        return self.pixels[row - 1 : row + 2, column - 1 : column + 2].reshape(-1, 3).mean(axis=0)


def test_the_first_picture_shows_the_box_on_its_floor():
    run = dragged()
    figure = run.plot()
    seen = Seen(figure)
    axes = next(axes for axes in figure.axes if axes.get_xlabel() == "x (mm)")
    (left, bottom), (right, top) = axes.transData.transform([(-50.0, 0.0), (50.0, 60.0)])
    # The box of 100 mm x 60 mm is to scale, and no sliver.
    assert (right - left) / (top - bottom) == pytest.approx(100.0 / 60.0, rel=0.01)
    assert right - left > 0.35 * axes.bbox.width and top - bottom > 0.35 * axes.bbox.height
    # It has stuck up to 5 mm, then slipped by 2 mm: it ends 3 to 5 mm behind the hand.
    end = 1e3 * run.pose[-1, 0]
    assert 95.0 <= end <= 97.0
    for x, y in [(end + 50, 45), (end - 50, 45), (end + 20, 60)]:
        assert seen.near(axes, x, y, _sheet.BODY)
    assert seen.near(axes, -50, 45, _sheet.BODY_THEN)
    blue, grey, white = (seen.inside(axes, x, y) for x, y in [(end + 44, 52), (30, -4), (30, 66)])
    assert blue[2] > blue[0] + 10 and (white == 255).all()
    assert seen.near(axes, -56, 0, _sheet.INK) and seen.near(axes, 30, -3, _sheet.SOLID) and (grey < 250).all()
    # The hand ends at 100 mm, 1 cm deep.
    assert seen.near(axes, 100, 20, _sheet.HAND) and seen.near(axes, 40, 20, _sheet.HAND)


def test_friction_is_seen_as_a_sawtooth_between_its_limits():
    axes = dragged().figure("forces")
    seen = Seen(axes[0].figure)
    # N = 500 N/m 1 cm = 5 N: it slips at mu_s N = 2.5 N, sticks again at mu_d N = 1.5 N, and that every 2 mm, which are 20 ms.
    assert axes[0].get_ylabel().split() == ["surface", "0", "(N)"]
    for t in (0.3, 0.6, 0.9):
        assert seen.near(axes[0], t, 5.0, _sheet.NORMAL)
        assert seen.near(axes[0], t, 1.5, _sheet.LIMIT, 4) and seen.near(axes[0], t, 2.5, _sheet.LIMIT, 4)
        assert seen.near(axes[0], t, -2.0, _sheet.FRICTION, 3)
        assert not seen.near(axes[0], t, -3.5, _sheet.FRICTION, 3) and not seen.near(axes[0], t, 0.7, _sheet.FRICTION, 3)
    friction = next(line for line in axes[0].lines if line.get_color() == _sheet.FRICTION)
    t, pull = friction.get_data()
    assert pull.min() == pytest.approx(-2.5, abs=0.06) and pull[t > 0.06].max() == pytest.approx(-1.5, abs=0.06)


def texts(figure):
    """The visible texts and where they are."""
    canvas = FigureCanvasAgg(figure)
    canvas.draw()
    renderer = canvas.get_renderer()
    # The labels of ticks beyond the ends of an axis are not drawn.
    axes = [axis for one in figure.axes for axis in (one.xaxis, one.yaxis)]
    ends = {axis: sorted(axis.get_view_interval()) for axis in axes}
    beyond = {tick.label1 for axis in axes for tick in axis.get_major_ticks() if not ends[axis][0] <= tick.get_loc() <= ends[axis][1]}
    for text in figure.findobj(Text):
        if text.get_visible() and text.get_text().strip() and text not in beyond:
            yield text, text.get_window_extent(renderer)


def check_texts(figure, sizes):
    found = list(texts(figure))
    assert len(found) >= 2
    for text, where in found:
        assert sizes[0] <= text.get_size() <= sizes[1], text
        assert figure.bbox.x0 <= where.x0 and where.x1 <= figure.bbox.x1, f"{text} is cut off"
        assert figure.bbox.y0 <= where.y0 and where.y1 <= figure.bbox.y1, f"{text} is cut off"
    for i, (text, where) in enumerate(found):
        for other, there in found[:i]:
            width = min(where.x1, there.x1) - max(where.x0, there.x0)
            height = min(where.y1, there.y1) - max(where.y0, there.y0)
            assert width < 1.0 or height < 1.0, f"{text} and {other} are over each other"


@pytest.mark.parametrize("width", [60.0, 85.0, 170.0])
@pytest.mark.parametrize("picture", PICTURES)
@pytest.mark.parametrize("name", SCENES)
def test_all_text_can_be_read(runs, name, picture, width):
    figure = runs[name].figure(picture, width=width)[0].figure
    figure.set_dpi(200)
    check_texts(figure, (7.0, 9.0))
    assert figure.get_suptitle() == ""


@pytest.mark.parametrize("name", SCENES)
def test_all_text_of_the_overview_can_be_read(runs, name):
    figure = runs[name].plot()
    check_texts(figure, (7.0, 9.0))


@pytest.mark.parametrize("picture", PICTURES)
def test_a_figure_has_its_width_on_paper(tmp_path, picture):
    figure = dragged().figure(picture, width=85.0, title="A box")[0].figure
    assert figure.get_suptitle() == "A box"
    figure.savefig(tmp_path / "figure.pdf")
    pages = (tmp_path / "figure.pdf").read_bytes()
    width = float(re.search(rb"/MediaBox \[ ?0 0 ([\d.]+)", pages).group(1))
    assert width / 72.0 * 25.4 == pytest.approx(85.0, abs=0.1)
    # Letters stay letters: the page has a font.
    assert b"/Font" in pages or any(b"/Font" in zlib.decompress(part) for part in re.findall(rb"stream\n(.*?)\nendstream", pages, re.S))


def named(axes):
    return [text.get_text() for text in axes.get_legend().get_texts()]


@pytest.mark.parametrize("picture", ["forces", "motion"])
def test_only_the_states_that_occur_are_named(picture):
    scene = stiction.Scene.bundled("table-edge")
    run = stiction.Solver(scene).run(**scene.recorded())
    t, states = run.frames["t"], run.frames["state"]
    for between in (None, (0.0, 1.0), (2.5, 5.0)):
        shown = np.ones(len(t), bool) if between is None else (between[0] <= t) & (t <= between[1])
        axes = run.figure(picture, between=between)
        assert named(axes[-1]) == [name for i, name in enumerate(stiction.STATES) if (states[shown] == i).any()]
        limits = axes[0].get_xlim()
        assert limits == (t[shown][0], t[shown][-1])
        seen = Seen(axes[-1].figure)
        for i in np.linspace(0, shown.sum() - 1, 9).astype(int)[1:-1]:
            state = states[shown][i]
            if (states[shown][max(i - 30, 0) : i + 30] == state).all():
                assert seen.near(axes[-1], t[shown][i], 0.5, _sheet.STATE[stiction.STATES[state]], 1)


def test_chosen_instants_are_those_that_are_drawn():
    run = dragged()
    axes = run.figure("strip", at=[0.25, 0.75])
    assert [one.get_title() for one in axes] == ["0.25 s\nedge", "0.75 s\nedge"]
    seen = Seen(axes[0].figure)
    for one, t in zip(axes, (0.25, 0.75)):
        i = np.searchsorted(run.frames["t"], t)
        x, y, _ = 1e3 * run.pose[i]
        assert seen.near(one, x + 50, y + 20, _sheet.BODY) and seen.near(one, x - 50, y + 20, _sheet.BODY)
        # Half of the load is on each of the two vertices, upwards.
        assert seen.near(one, x + 50, 8.0, _sheet.NORMAL) or seen.near(one, x - 50, 8.0, _sheet.NORMAL)
    (axes,) = run.figure("trajectory", at=0.5)
    seen = Seen(axes.figure)
    x = 1e3 * run.pose[500, 0]
    assert seen.near(axes, x + 50, 50, _sheet.BODY) and not seen.near(axes, -50, 45, _sheet.BODY_THEN)


def test_snapshots_differ_from_each_other(runs):
    """Each state that occurs is among them, and no two are of one instant."""
    for name, run in runs.items():
        axes = run.figure("strip")
        titles = [one.get_title() for one in axes]
        assert 2 <= len(titles) == len(set(titles)) <= 6
        states = [title.split("\n")[1] for title in titles]
        occur = {stiction.STATES[state] for state in np.unique(run.frames["state"])}
        assert set(states) == occur, name


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"picture": "force"}, "trajectory, forces, motion, strip"),
        ({"width": 0.0}, "20 to 2000"),
        ({"at": []}, "`at` is empty"),
        ({"at": 2.0}, "`at` is 2, allowed: times from 0 to 0.999 s"),
        ({"between": (2.0, 3.0)}, "`between`.*times from 0 to 0.999 s"),
        ({"between": (0.5, 0.4)}, "`between`"),
        ({"between": (0.5, 0.7), "at": 0.4}, "`at` is 0.4, allowed: times from 0.5 to 0.7 s"),
    ],
)
def test_what_cannot_be_drawn_is_named(changes, part):
    with pytest.raises(ValueError, match=part):
        dragged().figure(**changes)


def test_times_that_decrease_choose_nothing():
    hand = np.zeros((3, 3))
    run = stiction.Solver(box()).run(hand, t=[0.0, 2.0, 1.0])
    with pytest.raises(ValueError, match="decrease"):
        run.figure(at=1.0)
    assert len(run.figure("motion")) == 4


HAND = np.column_stack([np.linspace(0, 0.1, 1000), np.full(1000, 0.02), np.zeros(1000)])
LOST = HAND.copy()
LOST[:20] = LOST[300:500] = np.nan


@pytest.mark.parametrize(
    "arguments",
    [
        {"hand": LOST},
        {"hand": HAND[:1]},
        {"hand": HAND[[0, 0]]},
        {"hand": HAND, "held": np.zeros(1000, bool)},
        {"hand": HAND, "held": np.arange(1000) < 400},
        # In the air, where nothing acts.
        {"hand": HAND + [0.0, 1.0, 0.0]},
    ],
    ids=["lost", "one", "at rest", "never held", "released", "in the air"],
)
@pytest.mark.parametrize("scene", [box(), stiction.Scene.bundled("point-stick-slip"), stiction.Scene.bundled("rod-on-floor")])
def test_every_run_can_be_drawn(scene, arguments):
    run = stiction.Solver(scene).run(**arguments)
    for picture in PICTURES:
        check_texts(run.figure(picture)[0].figure, (7.0, 9.0))
    check_texts(run.plot(), (7.0, 9.0))


def test_a_run_without_frames_cannot_be_drawn():
    run = stiction.Solver(box()).run(np.zeros((0, 3)))
    for draw in (run.plot, run.figure):
        with pytest.raises(ValueError, match="no frames"):
            draw()


def test_a_notebook_gets_the_picture():
    picture, again = (dragged().figure("trajectory")[0].figure._repr_svg_() for _ in range(2))
    assert picture == again and picture.count("<path") > 20
    assert _sheet.BODY in picture


def test_a_long_run_is_drawn_in_seconds_and_in_a_small_file():
    scene = stiction.Scene.bundled("table-edge")
    hand = scene.hand_array()
    run = stiction.Solver(scene).run(np.resize(np.concatenate([hand, hand[::-1]]), (200_000, 3)))
    assert len(run.plot()._repr_svg_()) < 3_000_000
