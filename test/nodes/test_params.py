"""``fpt params`` on a running graph."""

import signal

from command import forked_fpt, start_fpt
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from rcl_interfaces.msg import Log, Parameter, ParameterEvent, ParameterType, ParameterValue
from rcl_interfaces.srv import SetParameters, SetParametersAtomically
from rclpy.parameter import Parameter as RosParameter
from watcher import watcher

from fpt_ros.experiments.parameter_file import read
from fpt_ros.nodes.qos import loop_qos


def ask(*words):
    return forked_fpt("params", *words)


def test_parameters_of_a_running_graph(tmp_path):
    process = start_fpt("run", "tora", "--duration", 1000)
    with watcher() as graph:
        graph.wait_for_stamp(0.1)
        forked_fpt("pause")  # some of what follows would lose the plant
        assert ask("get", "fpt_deformer", "A").stdout == "fpt_deformer.A = -0.1\n"
        assert "fpt_deformer.A\n" in ask("list").stdout
        assert "live" in ask("describe", "fpt_deformer", "A").stdout
        assert "recorder.directory = " in ask("get", "recorder").stdout  # it died of this question

        before = tmp_path / "before.yaml"
        assert ask("dump", "--out", before).returncode == 0
        assert read(before).nodes["fpt_deformer"]["approximate.m"] == 10.0

        # a pair that is valid only together is taken as one
        done = ask("set", "fpt_deformer", "A=-2e-10", "K=0.9", "D=2")
        assert done.returncode == 0, done.stderr
        assert graph.get_parameter("fpt_deformer", "A") == -2e-10
        done = ask("set", "fpt_deformer", "A=-0.3", "K=1.99")
        assert done.returncode == 2
        assert "fixed point" in done.stderr
        assert graph.get_parameter("fpt_deformer", "A") == -2e-10

        done = ask("load", before)
        assert done.returncode == 0, done.stderr
        assert done.stdout.splitlines() == [
            "fpt_deformer.A = -0.1", "fpt_deformer.D = 0.6", "fpt_deformer.K = 0.5"
        ]  # fmt: skip
        assert ask("load", before).stdout == ""
        assert ask("dump", "fpt_deformer").stdout == ask("dump", "fpt_deformer").stdout

        before.write_text(before.read_text().replace("dt: 0.001", "dt: 0.002"))
        done = ask("load", before)
        assert done.returncode == 2
        assert "plant_simulator.dt cannot change while the loop runs" in done.stderr
        for words, reason in (
            (("set", "fpt_deformer", "B=1"), "no parameter 'B'"),
            (("set", "fpt_deformer", "A"), "PARAM=VALUE"),
            (("get", "fpt_deformer", "nonsense"), "no parameter 'nonsense'"),
            (
                ("get", "deformer", "A"),
                "no node /deformer offers describe_parameters; there are",
            ),
            (("load", before, "fpt_deforme"), "has no node fpt_deforme: it has plant_simulator"),
        ):
            done = ask(*words)
            assert done.returncode == 2
            assert reason in done.stderr
        a_gain_that_does_not_contract(graph)
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)


def a_gain_that_does_not_contract(graph):
    """Set in flight: accepted with a warning to all, or refused; of a model changed: not known."""
    outside = "fpt_deformer.A = -5 is outside the range (-4.658, 0)"
    said, health = [], {}
    graph.node.create_subscription(Log, "/rosout", lambda m: said.append(m.msg), loop_qos(100))
    graph.node.create_subscription(
        DiagnosticArray, "/diagnostics", lambda m: health.update((s.name, s) for s in m.status), 10
    )
    unknown = SetParameters.Request(parameters=[Parameter(name="A", value=ParameterValue(type=77))])
    (result,) = graph.call(SetParameters, "/fpt_deformer/set_parameters", unknown).results
    assert not result.successful
    assert result.reason.startswith("A: a value that cannot be read: ")
    several = SetParametersAtomically.Request(
        parameters=[RosParameter("A", value=-0.3).to_parameter_msg(), *unknown.parameters]
    )
    service = "/fpt_deformer/set_parameters_atomically"
    assert not graph.call(SetParametersAtomically, service, several).result.successful
    assert graph.get_parameter("fpt_deformer", "A") != -0.3
    a_list_that_is_emptied(graph)
    done = ask("set", "fpt_deformer", "A=-5")
    assert done.returncode == 0
    assert done.stderr.startswith(f"fpt: warning: {outside}")
    (result, reason) = graph.set_parameter("fpt_deformer", "A", -5.0)
    assert result is True
    assert outside in reason
    while not (any(outside in text for text in said) and "fpt_deformer" in health):
        graph.executor.spin_once(timeout_sec=1.0)
    while not any(outside in pair.value for pair in health["fpt_deformer"].values):
        graph.executor.spin_once(timeout_sec=1.0)
    assert health["fpt_deformer"].level == DiagnosticStatus.WARN
    assert ask("set", "fpt_deformer", "strict_gain=true", "A=-0.1").stderr == ""
    done = ask("set", "fpt_deformer", "A=-5")
    assert done.returncode == 2
    assert f"strict_gain: {outside}" in done.stderr
    assert graph.get_parameter("fpt_deformer", "A") == -0.1
    ask("set", "fpt_deformer", "approximate.m=11", "strict_gain=false")
    assert (
        "not known here, fpt_deformer.approximate.m has"
        in ask("set", "fpt_deformer", "A=-0.2").stderr
    )


def a_list_that_is_emptied(graph):
    """ROS sends it as a list of bytes, and it is told as what it is."""
    told = {}
    graph.node.create_subscription(
        ParameterEvent,
        "/parameter_changes",
        lambda m: told.update((each.name, each.value) for each in m.changed_parameters),
        loop_qos(),
    )
    for text, numbers in (("[1.0, 1.0, 1.0]", [1.0] * 3), ("[]", [])):
        done = ask("set", "fpt_deformer", f"safe_effort={text}")
        assert (done.returncode, done.stderr) == (0, "")
        assert list(graph.get_parameter("fpt_deformer", "safe_effort")) == numbers
    forked_fpt("step")
    while "safe_effort" not in told:
        graph.executor.spin_once(timeout_sec=1.0)
    assert told["safe_effort"].type == ParameterType.PARAMETER_DOUBLE_ARRAY


def test_changes_are_watched(tmp_path):
    process = start_fpt("run", "tora", "--duration", 1000)
    with watcher() as graph:
        graph.wait_for_stamp(0.1)
        watching = start_fpt("params", "watch", "--count", 1)
        heard = graph.node.count_subscribers
        while heard("/parameter_changes") < 1:
            graph.executor.spin_once(timeout_sec=0.1)
        while watching.poll() is None:
            graph.set_parameter("fpt_deformer", "A", -0.2)
        assert "fpt_deformer.A = -0.2" in watching.stdout.read()
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=60)
