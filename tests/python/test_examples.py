import os
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
    text = picture.read_text()
    # Five curves, each with an entry of the legend.
    assert text.count("ANCF, ") == 4 or text.count("<path") > 20
