"""Figures: they show the numbers of the report, in the colours of the program."""

from __future__ import annotations

import json
from collections.abc import Iterator
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pytest

import sawflutter as sf
from sawflutter import _native
from sawflutter.plot import Heat, Line, Points, Shade, Upright, colours
from sawflutter.plot.chart import end_labels, root_ticks
from sawflutter.plot.motion import deflections, grid


@pytest.fixture(autouse=True)
def closed() -> Iterator[None]:
    yield
    plt.close("all")


def test_colours_are_those_of_the_program() -> None:
    palette = json.loads(_native.palette())
    for name, rgb in palette.items():
        assert colours()[name] == "#{:02x}{:02x}{:02x}".format(*rgb)
    assert {"forward", "backward", "divergence_shade", "flutter_streak"} <= set(palette)


def test_every_point_of_the_chart_is_one_of_the_report(report: sf.CampbellResults) -> None:
    chart = report.chart()
    points = {
        (rpm, hz)
        for b in report.branches
        for rpm, hz in zip(b.rpm.tolist(), b.frequency_hz.tolist())
    }
    upper = chart.panels[0]
    drawn: set[tuple[float, float]] = set()
    names = {b.name for b in report.branches}
    for line in (i for i in upper.items if isinstance(i, Line) and i.name in names):
        kept = ~np.isnan(line.x)
        assert len(line.hover) == len(line.x)
        drawn |= set(zip(line.x[kept].tolist(), line.y[kept].tolist()))
    assert drawn == {point for point in points if point in drawn} == points
    shades = [item for item in upper.items if isinstance(item, Shade)]
    assert sorted((s.start, s.end) for s in shades) == sorted(
        (b.from_rpm, b.to_rpm) for b in report.bands
    )
    assert report.operating is not None and report.operating.safe_window_rpm is not None
    (window,) = (i for i in upper.items if isinstance(i, Line) and i.name.startswith("window without"))
    assert window.x.tolist() == list(report.operating.safe_window_rpm) and not window.y.any()
    uprights = [item.x for item in upper.items if isinstance(item, Upright)]
    assert set(report.critical_rpm.tolist()) <= set(uprights)


def test_signs_and_colours_of_the_branches(report: sf.CampbellResults) -> None:
    upper = report.chart().panels[0]
    for branch in report.branches:
        lines = [i for i in upper.items if isinstance(i, Line) and i.name == branch.name]
        at = {
            float(rpm): colours()["backward" if way == "reflected" else way]
            for b in report.branches
            if b.name == branch.name
            for rpm, way in zip(b.rpm, b.direction)
        }
        assert lines and {line.colour for line in lines} <= set(at.values())
    dashed = [i for i in upper.items if isinstance(i, Line) and i.dashed]
    reflected = {
        (rpm, hz)
        for b in report.branches
        for rpm, hz, sign in zip(b.rpm.tolist(), b.frequency_hz.tolist(), b.krein_sign)
        if sign < 0
    }
    shown = {(x, y) for line in dashed for x, y in zip(line.x.tolist(), line.y.tolist())}
    unstable = [i for i in upper.items if isinstance(i, Line) and i.width > 3.0]
    shown |= {(x, y) for line in unstable for x, y in zip(line.x.tolist(), line.y.tolist())}
    assert reflected <= shown


def test_no_curve_of_growth_exceeds_the_peaks(report: sf.CampbellResults) -> None:
    lower = report.chart().panels[1]
    peaks = max(band.peak_growth_per_s for band in report.bands)
    for line in (item for item in lower.items if isinstance(item, Line)):
        assert np.nanmax(line.y) <= peaks * (1.0 + 1e-9)
    dots = [item for item in lower.items if isinstance(item, Points)]
    assert len(dots) == len(report.bands)


def test_plotly_says_speed_frequency_growth_and_name(report: sf.CampbellResults) -> None:
    figure = report.plot()
    text = figure.to_json()
    hovers = [
        said
        for trace in figure.data
        for said in (trace.hovertext if trace.hovertext is not None else trace.text) or ()
        if said
    ]
    some = next(said for said in hovers if "reflected" in said)
    assert all(part in some for part in ("rpm", "Hz", "growth", "Krein sign −1"))
    assert any(some.startswith(branch.name) for branch in report.branches)
    assert colours()["flutter_shade"] in text or colours()["flutter_streak"] in text
    assert figure.layout.yaxis.title.text == "Im λ / 2π [Hz]"
    assert figure.layout.xaxis2.title.text == "rotation speed Ω [rpm]"


def test_matplotlib_draws_a_figure_or_into_axes(report: sf.CampbellResults) -> None:
    axes = report.plot_matplotlib()
    assert axes.get_ylabel() == "Im λ / 2π [Hz]"
    assert len(axes.figure.axes) == 2
    axes.figure.canvas.draw()
    _, own = plt.subplots()
    assert report.plot_matplotlib(ax=own) is own
    assert own.get_xlabel() == "rotation speed Ω [rpm]"
    drawn = {line.get_color() for line in own.lines}
    assert colours()["backward"] in drawn


def test_every_result_is_drawn_by_both(
    draft: sf.Scene, resaw: sf.Scene, report: sf.CampbellResults
) -> None:
    cut, up = draft.run_cut([1800.0, 2800.0]), draft.run_up()
    charts = [
        report.chart(),
        report.chart("root-loci"),
        draft.check().chart(),
        cut.chart(),
        cut.chart("cut-map"),
        up.chart(),
        up.chart("response-map"),
        resaw.run_washboard().chart(),
        resaw.replace({"cut.washboarding.overlap": 0.0}).run_washboard().chart(),
        draft.fit(to_rpm=1250, starts=1).chart(),
        draft.replace({"guides": []}).run_campbell().chart(),
        draft.replace({"guides": []}).run_campbell().chart("root-loci"),
        draft.replace({"guides[0].damping_n_s_per_m": 20.0}).run_campbell().chart(),
    ]
    from sawflutter.plot import with_matplotlib, with_plotly

    for chart in charts:
        assert chart.title
        figure = with_plotly.draw(chart)
        json.loads(figure.to_json(), parse_constant=pytest.fail)
        axes = with_matplotlib.draw(chart)
        axes.figure.canvas.draw()
    heat = next(item for item in up.chart("response-map").panels[0].items if isinstance(item, Heat))
    assert heat.z.shape == (len(heat.y), len(heat.x))
    drawn = (cut.chart("cut-map"), up.chart("response-map"), report.chart("root-loci"))
    assert all(chart.plot().data for chart in drawn)


def test_a_logarithmic_axis_of_plotly_ends_where_that_of_matplotlib_does(resaw: sf.Scene) -> None:
    found = resaw.run_washboard()
    figure, axes = found.plot(), found.plot_matplotlib()
    assert figure.layout.yaxis.type == "log"
    assert [10.0**end for end in figure.layout.yaxis.range] == pytest.approx(axes.get_ylim())


def test_excitation_lines_are_those_of_the_report(draft: sf.Scene) -> None:
    saw = draft.replace({"excitation": {"orders": 2, "tooth_passing": 1}})
    r = saw.run_campbell()
    assert r.excitation is not None
    upper = r.chart().panels[0]
    assert upper.y_range is not None
    for line in r.excitation.lines:
        (drawn,) = (i for i in upper.items if isinstance(i, Line) and i.name == line.name)
        assert drawn.dashed and drawn.y == pytest.approx(line.order * drawn.x / 60.0)
        assert max(drawn.y) <= upper.y_range[1] * (1.0 + 1e-12) and line.name in r.chart().facts
    (rings,) = (i for i in upper.items if isinstance(i, Points) and i.name == "crossing")
    found = {(c.rpm, c.frequency_hz) for c in r.excitation.crossings}
    assert set(zip(rings.x.tolist(), rings.y.tolist())) == found and found
    without = draft.run_campbell().chart().panels[0].items
    assert not any(getattr(item, "name", "") == "crossing" for item in without)


def test_place_and_tradeoff_are_drawn(draft: sf.Scene) -> None:
    placed = draft.place(
        free={"guides[0].radius_m": (0.18, 0.28), "guides[0].angle_deg": (-60.0, -50.0)},
        samples=3,
        refine=2,
        map=2,
    )
    found = draft.replace({"sweep.to_rpm": 1600}).tradeoff()
    assert placed.plot().layout.title.text and found.plot().data
    placed.plot_matplotlib().figure.canvas.draw()
    found.plot_matplotlib().figure.canvas.draw()


def test_a_reflected_wave_is_seen_to_turn(draft: sf.Scene) -> None:
    mode = draft.modes(rpm=1800.0)[0]
    assert mode.direction == "reflected"
    radius, theta = grid(mode)
    pictures = deflections(mode, radius, theta, 48)
    assert pictures.shape == (48, *radius.shape)
    assert np.max(np.abs(pictures)) == pytest.approx(1.0)
    # Over the period its nodal lines advance by one wave length, with the rotation.
    n = mode.harmonics[0].nodal_diameters
    phase = np.unwrap(
        np.angle(np.mean(pictures[:, -1, :-1] * np.exp(-1j * n * theta[-1, :-1]), axis=1))
    )
    assert phase[-1] - phase[0] == pytest.approx(-2.0 * np.pi * 47 / 48, abs=0.6)


def test_a_mode_is_animated_by_both(draft: sf.Scene, tmp_path: Path) -> None:
    mode = draft.modes(rpm=1800.0)[0]
    figure = draft.animate(mode, frames=12)
    assert len(figure.frames) == 12
    assert "1800 rpm" in figure.layout.title.text
    draft.animate(mode, backend="matplotlib", frames=4).save(tmp_path / "mode.gif", "pillow")
    assert (tmp_path / "mode.gif").stat().st_size > 10_000
    with pytest.raises(ValueError, match="backend"):
        draft.animate(mode, backend="paper")  # type: ignore[call-overload]
    with pytest.raises(ValueError, match="frames"):
        draft.animate(mode, frames=1)


def test_labels_at_the_ends_of_lines_do_not_meet(report: sf.CampbellResults) -> None:
    upper = report.chart().panels[0]
    placed = end_labels(upper, apart=0.05)
    assert len(placed) >= 5 and upper.y_range is not None
    least = 0.05 * (upper.y_range[1] - upper.y_range[0])
    heights = [height for _, height in placed]
    assert np.all(np.diff(heights) >= least * (1.0 - 1e-9))
    assert len(placed) <= len(report.plot().layout.annotations)


def test_ticks_of_a_root_scale_are_round() -> None:
    assert root_ticks(0.0, 3.5) == [0.0, 0.1, 0.3, 1.0, 3.0]
    assert root_ticks(-1.0, 1.0)[0] == -1.0


def test_the_saw_is_drawn_with_its_guides_and_signs(draft: sf.Scene) -> None:
    saw = draft.add_guide(angle_deg=90.0)
    (panel,) = saw.chart().panels
    named = {item.name: item for item in panel.items if isinstance(item, Line | Points)}
    assert {"rim", "bore", "cut", "probe", "guides[0]", "guides[1]", "rotation"} <= set(named)
    rim = named["rim"]
    assert np.hypot(rim.x, rim.y) == pytest.approx(draft["blade.outer_diameter_m"] / 2)
    # 90° in the direction of rotation from the x axis is up.
    pad = named["guides[1]"]
    middle = (np.mean(pad.x[:4]), np.mean(pad.y[:4]))
    assert middle == pytest.approx((0.0, draft["guides[0].radius_m"]), abs=1e-12)
    assert saw.plot().layout.yaxis.scaleanchor == "x"
    assert saw.plot_matplotlib().get_aspect() == 1.0


def test_bands_are_drawn_in_full_and_limits_by_name(
    draft: sf.Scene, report: sf.CampbellResults
) -> None:
    shapes = report.plot().layout.shapes
    assert len(shapes) >= len(report.bands) and {shape.opacity for shape in shapes} == {1.0}
    check = draft.check(operating_rpm=1250, min_critical_rpm=1600)
    words = {"yes": "PASS", "at_risk": "RISK", "no": "FAIL"}
    names = [f"{words[of.answer]} {of.name}: {of.finding}" for of in check.verdict.limits]
    rows = [note.text for note in check.plot().layout.annotations if note.text.startswith("<b>")]
    assert rows == [f"<b>{name}</b>" for name in names]
    assert set(names) <= {text.get_text() for text in check.plot_matplotlib().texts}


def test_units_change_numbers_and_names_together(report: sf.CampbellResults) -> None:
    """An angular frequency is 2π times a frequency, and one rotation per second is 60 rpm."""
    plain = report.plot()
    radians = report.plot(speed_units="Hz", frequency_units="rad/s")
    assert radians.layout.yaxis.title.text == "Im λ [rad/s]"
    assert radians.layout.xaxis2.title.text == "rotation speed Ω [Hz]"
    assert len(plain.data) == len(radians.data)
    upper = [(a, b) for a, b in zip(plain.data, radians.data) if a.yaxis == "y"]
    for before, after in upper:
        assert np.allclose(after.x, before.x / 60.0, equal_nan=True)
        assert np.allclose(after.y, 2.0 * np.pi * before.y, equal_nan=True)
    # Growth rates are not frequencies.
    for before, after in zip(plain.data, radians.data):
        if before.yaxis == "y2":
            assert np.array_equal(after.y, before.y, equal_nan=True)
    for before, after in zip(plain.layout.shapes, radians.layout.shapes):
        assert after.x0 == pytest.approx(before.x0 / 60.0)
    axes = report.plot_matplotlib(frequency_units="rad/s")
    assert axes.get_ylim() == pytest.approx(radians.layout.yaxis.range)
    with pytest.raises(ValueError, match="speed_units.*'rpm', 'Hz', 'rad/s'"):
        report.plot(speed_units="rps")  # type: ignore[arg-type]


def test_harmonics_are_multiples_of_the_speed(draft: sf.Scene, report: sf.CampbellResults) -> None:
    scene = draft.replace({"excitation": {"orders": 2}}).run_campbell()
    for figure in (
        report.plot(harmonics=[1, 2.5]),
        draft.run_up().chart("response-map").plot(harmonics=[1]),
    ):
        (line,) = (trace for trace in figure.data if trace.name == "1× speed")
        assert line.y == pytest.approx(line.x / 60.0) and line.line.dash == "dash"
    own = next(line for line in scene.plot(harmonics=[3]).data if line.name == "3× speed")
    top = scene.plot().layout.yaxis.range[1]
    assert own.y == pytest.approx(3.0 * own.x / 60.0) and max(own.y) <= top * (1.0 + 1e-12)
    labels = [line.get_label() for line in report.plot_matplotlib(harmonics=[4]).lines]
    assert "4× speed" in labels
    with pytest.raises(ValueError, match="does not show"):
        draft.check().plot(harmonics=[1])
    with pytest.raises(ValueError, match="positive"):
        report.plot(harmonics=[0])


def test_figures_and_axes_of_ones_own_are_drawn_into(
    draft: sf.Scene, report: sf.CampbellResults
) -> None:
    import plotly.graph_objects as go
    from plotly.subplots import make_subplots

    plain = go.Figure(layout={"title": {"text": "mine"}})
    assert report.plot(plain) is plain and plain.layout.title.text == "mine"
    assert {trace.yaxis for trace in plain.data} <= {None, "y"}
    rows = make_subplots(rows=2, cols=1)
    assert len(report.plot(rows).data) == len(report.plot().data) > len(plain.data)
    before = len(rows.data)
    draft.replace({"guides": []}).run_campbell().plot(rows)
    assert len(rows.data) > before
    figure, own = plt.subplots(2, 1)
    assert report.plot_matplotlib(own) is own[0]
    assert own[1].get_ylabel().startswith("Re λ") and len(plt.get_fignums()) == 1
    assert draft.plot(go.Figure()).data and figure.axes


def test_both_libraries_draw_the_key_of_a_chart() -> None:
    folder = Path(__file__).parents[2] / "tests" / "golden" / "reports"
    chart = sf.load(folder / "response-causes.json").chart()
    names = [item.name for item in chart.key]
    assert {"side force, static", "flatness, 2×"} <= set(names)
    shown = [trace.name for trace in chart.plot().data if trace.showlegend]
    figure = chart.plot_matplotlib().figure
    assert figure is not None and shown == names
    assert [text.get_text() for text in figure.legends[0].get_texts()] == names


def test_charts_are_equal_and_hashed_by_their_contents(report: sf.CampbellResults) -> None:
    chart, same, other = report.chart(), report.chart(), report.chart("root-loci")
    assert chart == same and hash(chart) == hash(same) and {chart, same} == {same}
    assert chart != other and chart.panels[0].items[0] == same.panels[0].items[0]


def test_a_record_is_looked_at() -> None:
    samples = np.sin(np.arange(100_000) / 20.0)
    samples[70_123] = 5.0
    record = sf.Record(samples, 1000, rpm=(0, 1000), unit="mm")
    signal, speed = record.chart().panels
    assert signal.y_name == "signal [mm]" and speed.y_name == "rotation speed [rpm]"
    (line,) = (item for item in signal.items if isinstance(item, Line))
    # A long record keeps its extremes.
    assert len(line.x) < 5000 and line.y.max() == 5.0
    assert len(record.plot_matplotlib().lines) == 1
