"""``fpt denoise``: tables, arrays and recordings in, one more column out."""

import json

import numpy as np
import pytest
import zstandard
from command import forked_fpt as fpt
from command import forked_fpt_json as fpt_json


@pytest.fixture
def noisy():
    t = np.arange(256)
    clean = np.sin(2 * np.pi * t / 64)
    return clean, clean + 0.1 * np.random.default_rng(3).standard_normal(256)


def test_last_column_is_the_estimate_and_missing_samples_are_marked(tmp_path, noisy):
    clean, y = noisy
    rows = ["t,y", *(f"{i},{x}" for i, x in enumerate(y))]
    rows[101] = "100,"
    (tmp_path / "s.csv").write_text("\n".join(rows))
    out, plot = tmp_path / "out.csv", tmp_path / "out.png"
    result = fpt_json("denoise", tmp_path / "s.csv", "--column", "y", "--out", out, "--plot", plot)
    assert result["healed"] == 1
    table = np.genfromtxt(out, delimiter=",", names=True)
    assert table.dtype.names[-1] == "estimate"
    assert np.flatnonzero(table["healed"]).tolist() == [100]
    error = np.sqrt(np.mean((table["estimate"] - clean) ** 2))
    assert error < 0.5 * np.sqrt(np.mean((y - clean) ** 2))
    assert plot.read_bytes().startswith(b"\x89PNG")


def test_arrays(tmp_path, noisy):
    np.save(tmp_path / "s.npy", noisy[1])
    result = fpt_json("denoise", tmp_path / "s.npy", "--method", "savgol")
    assert result["samples"] == 256
    assert (tmp_path / "s-denoised.csv").is_file()


def test_a_field_of_a_recording(tmp_path):
    bag, out = tmp_path / "bag", tmp_path / "q3.csv"
    fpt_json("simulate", "tora", "--duration", 1, "--record", bag)
    topic = ("--topic", "joint_states", "--field", "position[2]")
    result = fpt_json("denoise", bag, *topic, "--method", "savgol", "--out", out)
    assert result["samples"] == 1000
    by_name = ("--topic", "joint_states", "--field", "position", "--joint", "q3")
    fpt_json("denoise", bag, *by_name, "--method", "savgol", "--out", tmp_path / "named.csv")
    rows, named = (path.read_text().splitlines() for path in (out, tmp_path / "named.csv"))
    assert named[0] == "time,joint_states.position.q3,healed,estimate"
    assert named[1:] == rows[1:]
    file = bag.with_name("bag_0.mcap.zstd")
    file.write_bytes(zstandard.compress((bag / "bag_0.mcap").read_bytes()))
    for way in (file, bag / "metadata.yaml"):
        again = fpt_json("denoise", way, *by_name, "--time", "header.stamp", "--out", out)
        assert again["samples"] == 1000
    absent = fpt("denoise", bag, *by_name[:-1], "q9", "--out", out)
    assert absent.returncode == 2
    assert "q1, q2, q3" in absent.stderr
    missing = fpt("denoise", bag, "--topic", "nothing", "--field", "position[2]", "--out", out)
    assert missing.returncode == 2
    assert "/joint_states" in missing.stderr


def test_compare_runs_all_methods(tmp_path, noisy):
    np.save(tmp_path / "s.npy", noisy[1])
    methods = json.loads(fpt("denoise", tmp_path / "s.npy", "--compare", "--json").stdout)[
        "methods"
    ]
    assert {"auto", "heursure", "savgol", "improved", "fuzzy"} <= {m["method"] for m in methods}


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (["--column", "z"], "columns of numbers are t, y"),
        (["--method", "foo"], "none of the denoisers"),
        (["--method", "savgol", "--set", "window=10"], "odd"),
        (["--method", "savgol", "--set", "window=5", "--set", "degree=7"], "degree"),
        (["--plot", "s.gif"], ".png"),
    ],
)
def test_bad_input_is_one_line_and_writes_nothing(tmp_path, arguments, complaint):
    (tmp_path / "s.csv").write_text("t,y\n" + "\n".join(f"{i},{i % 7}" for i in range(50)))
    done = fpt("denoise", "s.csv", *arguments, cwd=tmp_path)
    assert done.returncode == 2
    assert len(done.stderr.strip().splitlines()) == 1
    assert complaint in done.stderr
    assert [path.name for path in tmp_path.iterdir()] == ["s.csv"]


@pytest.mark.parametrize("content", ["", "y\n", "y\n\n\n", "y\ninf\n1\n2\n3\n4\n", "y\n1\n2\n"])
def test_signals_that_cannot_be_used(tmp_path, content):
    (tmp_path / "s.csv").write_text(content)
    done = fpt("denoise", "s.csv", cwd=tmp_path)
    assert done.returncode == 2
    assert len(done.stderr.strip().splitlines()) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["s.csv"]


# --- test signals


def test_a_test_signal_tells_the_success(tmp_path):
    out = tmp_path / "sines.csv"
    word = "test:sines,rho=0.5,seed=10"
    found = fpt_json("denoise", word, "--method", "heursure", "--out", out)
    assert found["snr_before"] == pytest.approx(2.2294, abs=1e-6)
    assert 10.0 < found["snr_after"] < 16.0
    table = np.genfromtxt(out, delimiter=",", names=True)
    assert table.dtype.names == ("t", "clean", "y", "healed", "estimate")
    error = np.sqrt(np.mean((table["estimate"] - table["clean"]) ** 2))
    assert found["rmse"] == pytest.approx(error)


def test_methods_are_compared_by_their_success_where_it_is_known():
    found = fpt_json("denoise", "test:heavisine,rho=0.9,seed=12", "--compare")
    snr = {row["method"]: row["snr_after"] for row in found["methods"]}
    assert snr["auto"] == max(snr.values())
    assert snr["sureshrink"] < snr["improved"] < snr["auto"]
    shown = fpt("denoise", "test:heavisine,rho=0.9,seed=12", "--compare").stdout
    assert "SNR [dB]" in shown


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["test:sinus"], "test signals are sines"),
        (["test:sines", "--column", "y"], "it takes no --column"),
        (["test:sines", "--method", "visushrink", "--set", "wavelet=x"], "PyWavelets' discrete"),
    ],
)
def test_bad_words_for_test_signals(tmp_path, words, message):
    done = fpt("denoise", *words, "--out", tmp_path / "x.csv")
    assert done.returncode == 2
    assert message in done.stderr
    assert not (tmp_path / "x.csv").exists()


# --- filters of the loop over a record


def encoder(path):
    t = np.arange(1500) * 1e-3
    q = np.round(np.sin(7 * t) / 5e-5) * 5e-5
    rows = [f"{a:.3f},{b:.6f}" for a, b in zip(t, q, strict=True)]
    path.write_text("\n".join(["t [s],q [rad]", *rows]))
    return t


def test_a_filter_of_the_loop_over_a_record(tmp_path):
    t = encoder(tmp_path / "q.csv")
    out = tmp_path / "out.csv"
    words = ("--streaming", "kalman_bank", "--derivative", "1", "--out", out)
    found = fpt_json("denoise", tmp_path / "q.csv", *words)
    assert found["method"] == "kalman_bank"
    assert found["info"]["delay"] == "0 s"
    table = np.genfromtxt(out, delimiter=",", skip_header=1)
    late = t > 0.5
    assert np.sqrt(np.mean((table[late, -1] - 7 * np.cos(7 * t[late])) ** 2)) < 0.05


def test_filters_are_ranked_with_their_delay(tmp_path):
    encoder(tmp_path / "q.csv")
    words = ("--streaming", "all", "--compare")
    rows = fpt_json("denoise", tmp_path / "q.csv", *words)["filters"]
    score = {row["method"]: row["score"] for row in rows}
    assert list(score.values()) == sorted(score.values())
    assert score["kalman_bank"] < score["savgol"] < score["butterworth"]
    delay = {row["method"]: row["delay"] for row in rows}
    assert delay["butterworth"] == pytest.approx(np.sqrt(2) / (2 * np.pi * 20.0), abs=2e-3)


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["--streaming", "foo"], "none of the filters"),
        (["--streaming", "all"], "add --compare, or name one"),
        (["--streaming", "savgol", "--compare"], "--streaming all"),
        (["--streaming", "savgol", "--method", "fuzzy"], "give one of them"),
        (["--streaming", "savgol", "--set", "window=10"], "odd"),
        (["--streaming", "savgol", "--set", "seconds=100"], "at most 10001"),
    ],
)
def test_filters_that_cannot_be_run(tmp_path, words, message):
    encoder(tmp_path / "q.csv")
    done = fpt("denoise", tmp_path / "q.csv", *words)
    assert done.returncode == 2
    assert message in done.stderr
    assert len(done.stderr.strip().splitlines()) == 1
