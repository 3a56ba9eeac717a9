"""State spaces against the solvers of the library, receptances and static stiffness."""

from __future__ import annotations

import numpy as np
import pytest

import sawflutter as sf

RIM = [(0.355, 0.0)]


@pytest.fixture(scope="module")
def damped(draft: sf.Scene) -> sf.Scene:
    return draft.replace({"damping.air_n_s_per_m3": 40.0, "operating_rpm": 1200})


def test_modes_are_those_of_the_library(damped: sf.Scene) -> None:
    found = damped.modes(rpm=1200)
    space = damped.matrices().state_space(1200, inputs=RIM, outputs=RIM, to_hz=60)
    values = np.linalg.eigvals(space.A)
    values = values[values.imag > 0]
    hz = np.sort(values.imag) / (2 * np.pi)
    expected = np.sort([mode.frequency_hz for mode in found if mode.frequency_hz <= 60])
    assert len(hz) == len(expected)
    assert np.allclose(hz, expected, rtol=1e-6)
    growth = np.sort(values.real)
    lowest = [mode.growth_per_s for mode in found if mode.frequency_hz <= 60]
    assert np.allclose(growth, np.sort(lowest), rtol=1e-4)


def test_the_head_of_an_arm_is_a_state(damped: sf.Scene) -> None:
    arm = {"stiffness_n_per_m": 5e5, "mass_kg": 2.0, "damping_n_s_per_m": 20.0}
    saw = damped.replace({"guides[0].arm": arm})
    m = saw.matrices(basis=(12, 6))
    assert len(m.stiffness) == len(damped.matrices(basis=(12, 6)).stiffness) + 1
    # The head does not turn, and no point of the blade moves it.
    assert not m.spin[6].any() and not m.gyroscopic[6].any()
    assert m.at(0.355, 20.0)[6] == 0.0
    found = saw.modes(rpm=1200)
    space = saw.matrices().state_space(1200, inputs=RIM, outputs=RIM, to_hz=60)
    values = np.linalg.eigvals(space.A)
    hz = np.sort(values[values.imag > 0].imag) / (2 * np.pi)
    expected = np.sort([mode.frequency_hz for mode in found if mode.frequency_hz <= 60])
    assert np.allclose(hz, expected, rtol=1e-6)


def test_a_film_and_a_controller_are_states(damped: sf.Scene) -> None:
    controller = {"numerator": [2e9], "denominator": [1, 50, 4e4]}
    film = {"guides[0].damping_n_s_per_m": 100, "guides[0].film": {"lag_s": 1e-3}}
    saw = damped.replace({**film, "guides[0].controller": controller})
    m = saw.matrices(basis=(12, 6))
    # The film has one for the heave and one for each tilt of the pad.
    assert len(m.stiffness) == len(damped.matrices(basis=(12, 6)).stiffness) + 4
    found = saw.modes(rpm=1200)
    space = saw.matrices().state_space(1200, inputs=RIM, outputs=RIM, to_hz=60)
    values = np.linalg.eigvals(space.A)
    # The decays of the film are real and equal nearly to rounding.
    hz = np.sort(values[values.imag > 1e-3 * np.abs(values)].imag) / (2 * np.pi)
    expected = [mode.frequency_hz for mode in found if 0 < mode.frequency_hz <= 60]
    assert np.allclose(hz[hz <= 60], np.sort(expected), rtol=1e-6)


def test_the_static_gain_is_the_stiffness_at_the_rim(damped: sf.Scene) -> None:
    # `check` uses this basis, because a point load excites waves of all lengths.
    space = damped.matrices(basis=(30, 12)).state_space(1200, inputs=RIM, outputs=RIM)
    gain = space.response(0.0)[0, 0]
    checked = damped.check()
    assert checked.rim_stiffness_n_per_m is not None
    # Air that rotates with the blade has a small effect also at rest in space.
    assert gain.real == pytest.approx(1.0 / checked.rim_stiffness_n_per_m, rel=1e-2)


def test_the_response_is_the_receptance(damped: sf.Scene) -> None:
    m = damped.matrices(basis=(12, 6))
    inputs, outputs = [(0.355, 0.0), (0.3, 20.0)], [(0.355, 90.0)]
    whole = m.state_space(1200, inputs=inputs, outputs=outputs)
    speed, hz = 1200 * np.pi / 30, 17.0
    omega = 2 * np.pi * hz
    assert m.damping is not None
    dynamic = m.stiffness + speed**2 * m.spin - omega**2 * m.mass
    if m.circulatory is not None:
        dynamic = dynamic + speed * m.circulatory
    dynamic = dynamic + 1j * omega * (2 * speed * m.gyroscopic + m.damping)
    forces, probe = m.at([0.355, 0.3], [0.0, 20.0]), m.at(0.355, 90.0)
    expected = probe @ np.linalg.solve(dynamic, forces.T)
    assert np.allclose(whole.response(hz)[0], expected, rtol=1e-8)
    low = whole.reduced(to_hz=300)
    assert len(low.A) < len(whole.A) / 2
    assert np.allclose(low.response(hz)[0], expected, rtol=1e-2)
    assert np.allclose(low.response(0.0), whole.response(0.0), rtol=1e-6)
    assert low.D.shape == (1, 2)
    with pytest.raises(ValueError, match="raise to_hz"):
        whole.reduced(to_hz=1e-6)


def test_other_programs_take_it(damped: sf.Scene) -> None:
    signal = pytest.importorskip("scipy.signal")
    space = damped.matrices(basis=(8, 5)).state_space(1200, inputs=RIM, outputs=RIM, to_hz=60)
    system = signal.StateSpace(*space)
    _, response = signal.freqresp(system, w=[2 * np.pi * 5.0])
    assert response[0] == pytest.approx(space.response(5.0)[0, 0], rel=1e-8)


def test_points_take_units(damped: sf.Scene) -> None:
    m = damped.matrices(basis=(8, 5))
    plain = m.state_space(1200, inputs=(0.3, 90), outputs=[(0.2, 0)])
    assert m.state_space(1200, inputs=[("300 mm", "90 deg")], outputs=[("20 cm", 0)]) == plain
    assert (m.at("200 mm", "90 deg") == m.at(0.2, 90)).all()
    with pytest.raises(sf.ArgumentError, match=r"inputs must be points .* \(you gave \[\]\)"):
        m.state_space(1200, inputs=[], outputs=RIM)
    with pytest.raises(sf.ArgumentError, match="radius_m must be from"):
        m.state_space(1200, inputs=[("300 m", 0)], outputs=RIM)


@pytest.mark.parametrize("air", [40.0, None])
def test_many_frequencies_have_the_responses_of_single_ones(draft: sf.Scene, air: float | None) -> None:
    saw = draft.replace({"damping.air_n_s_per_m3": air} if air else {})
    hz = np.linspace(1.0, 150.0, 120)
    for space in (
        saw.matrices(basis=(12, 6)).state_space(1200, inputs=RIM, outputs=[(0.3, 90.0), (0.25, 10.0)]),
        saw.matrices(basis=(12, 6)).state_space(1200, inputs=RIM, outputs=RIM, to_hz=150),
    ):
        single = np.array([space.response(one) for one in hz])
        assert np.allclose(space.response(hz), single, rtol=1e-8, atol=0.0)


def test_coalescing_modes_are_solved_at_each_frequency() -> None:
    # Two equal undamped oscillators, of which one drives the other: no eigenvectors are a basis.
    stiffness = np.array([[4.0, 0.0], [1.0, 4.0]])
    a = np.block([[np.zeros((2, 2)), np.eye(2)], [-stiffness, np.zeros((2, 2))]])
    b, c = np.array([[0.0], [0.0], [1.0], [0.0]]), np.array([[0.0, 1.0, 0.0, 0.0]])
    space = sf.StateSpace(0.0, a, b, c, np.zeros((1, 1)))
    hz = np.linspace(0.0, 1.0, 101)
    square = (2 * np.pi * hz) ** 2
    assert np.allclose(space.response(hz)[:, 0, 0], -1.0 / (4.0 - square) ** 2, rtol=1e-9)
