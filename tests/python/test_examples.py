import os
import runpy
import subprocess
import sys

import pytest

pytest.importorskip("matplotlib")


def test_figure_5_in_thirty_lines(examples, tmp_path):
    script = examples / "python" / "figure5.py"
    assert len(script.read_text().splitlines()) <= 30
    picture = tmp_path / "figure5.svg"
    subprocess.run(
        [sys.executable, script, picture], check=True,
        env={**os.environ, "MPLCONFIGDIR": str(tmp_path)},
    )
    assert picture.read_text().count("<path") > 20


def test_figure_5_shows_what_the_paper_does(examples, tmp_path, monkeypatch):
    """Oscillations about the conventional curve shrink with the penalty."""
    monkeypatch.setattr(sys, "argv", ["figure5", str(tmp_path / "5.svg")])
    plt = pytest.importorskip("matplotlib.pyplot")
    plt.close("all")
    runpy.run_path(str(examples / "python" / "figure5.py"))
    *ancf, conventional = plt.gca().get_lines()
    labels = [line.get_label() for line in (*ancf, conventional)]
    assert labels == [f"ANCF, 1e+0{n} Pa" for n in (4, 5, 6, 8)] + ["conventional"]
    times = conventional.get_xdata()
    assert times[0] == 0 and abs(times[-1] - 10) < 1e-12 and len(times) == 1001
    distances = [abs(line.get_ydata() - conventional.get_ydata()).max()
                 for line in ancf]
    # Strains vibrate by some M omega^2 / b with the frequency sqrt(b / M), their
    # rates by 1 / sqrt(b).
    for softer, stiffer, ratio in zip(distances, distances[1:], (10, 10, 100)):
        assert stiffer < softer / ratio**0.5
    assert conventional.get_ydata().std() > 10 * distances[-1]
