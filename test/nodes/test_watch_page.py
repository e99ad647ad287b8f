"""``fpt watch`` in a real browser, beside real graphs."""

import json
import signal
import urllib.error
import urllib.request
from collections import deque
from contextlib import contextmanager

import pytest
import samples
from browser import PATIENCE, browser
from command import forked_fpt, start_fpt
from rcl_interfaces.msg import ParameterEvent
from watcher import watcher
from websockets.exceptions import ConnectionClosed
from websockets.sync.client import connect

from fpt_ros.bags.changes import value_of

NAMESPACE = "robot1"


@contextmanager
def watching(folder):
    """The page, and the process that serves it; which then ends quietly at Ctrl-C."""
    process = start_fpt("watch", "--no-browser")
    url = process.stdout.readline().split()[0]
    with browser(folder / "browser") as page:
        page.call("Page.navigate", url=url)
        try:
            yield page, url
        except BaseException as error:
            error.add_note(seen(page))
            raise
        page.call("Page.navigate", url="about:blank")  # it would complain that the server has gone
        process.send_signal(signal.SIGINT)
        stdout, stderr = process.communicate(timeout=60)
        assert (process.returncode, stdout, stderr) == (0, "", "")
        assert page.problems == []
        assert all(each.startswith(("http://127.0.0.1:", "data:")) for each in page.requests)


def seen(page):
    """For what to say where a test has waited in vain."""
    fields = ("state", "messages", "diagnostics"), ("fpt_deformer.A", "fpt_deformer.K")
    texts = [page.run(f"{model(name)}?.text") for name in fields[0]]
    values = [page.run(f"{model(name)}?.value") for name in fields[1]]
    return f"the page says {texts}, its fields {values}, its console {page.problems}"


def status(url):
    try:
        with urllib.request.urlopen(url) as answer:
            return answer.status
    except urllib.error.HTTPError as error:
        return error.code


def refuses_strangers(address):
    for each in ("", "?token=a", "metadata", "autoload.js?bokeh-autoload-element=a"):
        assert status(address + each) == 403
    options = {"subprotocols": ["bokeh", "a.b"], "open_timeout": PATIENCE}
    with connect(f"ws{address[4:]}ws", **options) as socket, pytest.raises(ConnectionClosed):
        socket.recv()


def model(name):
    """The newest of this name: a page keeps those that it does not show any more."""
    return (
        "[...Bokeh.documents[0]._all_models.values()]"
        f".filter((each) => each.name === {json.dumps(name)}).at(-1)"
    )


def view(name):
    return f"Bokeh.index.find_one_by_id({model(name)}.id)"


def wait_for_text(page, name, text):
    page.wait_for(
        f"window.Bokeh && Bokeh.documents.length && {model(name)} && "
        f"{model(name)}.text.includes({json.dumps(text)})"
    )


def place(page, element):
    """The middle of an element, scrolled to."""
    x, y = page.run(
        f"(() => {{ const each = {element}; each.scrollIntoView({{ block: 'center' }}); "
        "const box = each.getBoundingClientRect(); "
        "return [box.x + box.width / 2, box.y + box.height / 2]; })()"
    )
    return x, y


def press(page, label):
    page.click(place(page, f"{view('button ' + label)}.button_el"))


def write(page, name, text):
    """What a user types into a field, with Enter."""
    page.click(place(page, f"{view(name)}.input_el"))
    page.run(f"{view(name)}.input_el.select()")
    page.call("Input.insertText", text=text)
    for kind in ("keyDown", "keyUp"):
        page.call("Input.dispatchKeyEvent", type=kind, key="Enter", code="Enter", text="\r",
                  windowsVirtualKeyCode=13)  # fmt: skip


@contextmanager
def changes(graph):
    """Changes of the deformer as they take effect: (name, value), the oldest first."""
    found = deque()

    def on_event(event):
        if event.node.endswith("fpt_deformer"):
            found.extend((each.name, value_of(each.value)) for each in event.changed_parameters)

    graph.node.create_subscription(ParameterEvent, f"/{NAMESPACE}/parameter_changes", on_event, 100)
    yield found


def next_change(graph, found, process):
    while not found:
        assert process.poll() is None, process.communicate()
        graph.executor.spin_once(timeout_sec=1)
    return found.popleft()


@pytest.mark.timeout(2000)  # six minutes at a load of 14
def test_the_page_joins_a_graph_steers_it_and_waits_for_the_next(tmp_path):
    # 10 cycles a second: the page goes behind the loop, and a busy machine has no time for both;
    # and late commands could lose the plant
    run = ("run", "tora", "--composed", "--speed", 0.01, "--namespace", NAMESPACE)
    first = start_fpt(*run)
    with watching(tmp_path) as (page, url), watcher() as graph, changes(graph) as found:
        refuses_strangers(url.partition("?")[0])

        slider, field = "slider fpt_deformer.A 0", "fpt_deformer.A"
        wait_for_text(page, "state", "running")
        page.wait_for(f"{model(slider)} && {view(slider)}")
        page.wait_for(f"{model('motion')}.renderers.length && {model('error')}.renderers.length")
        wait_for_text(page, "diagnostics", f"/{NAMESPACE}/plant_simulator")
        assert not found  # a page that loads changes nothing
        assert page.run(f"{model(field)}.value") == "-0.1"

        handle = f"{view(slider)}.shadow_el.querySelector('.noUi-handle')"
        x, y = place(page, handle)
        page.drag((x, y), (x + 15, y))
        name, value = next_change(graph, found, first)
        assert name == "A"
        assert -0.3 < value < -0.11
        page.wait_for(f"Math.abs(Number({model(field)}.value) - {value}) < 1e-9")
        figure = f"{model('gain')}.renderers[0].data_source.data.A"
        page.wait_for(f"Math.abs({figure}.at(-1) - {value}) < 1e-9")

        press(page, "pause")  # some of what follows would lose the plant
        wait_for_text(page, "state", "paused")
        write(page, field, "-2e-10")  # beyond the slider, which follows
        wait_for_text(page, "messages", "fpt_deformer.A = -2e-10")
        page.wait_for(f"{model(slider)}.end < -7")
        write(page, "fpt_deformer.K", "1.99")
        wait_for_text(page, "messages", "no fixed point")  # the node's own reason
        page.wait_for(f"{model('fpt_deformer.K')}.value === '0.5'")
        page.wait_for(f"{view('fpt_deformer.K')}.input_el.value === '0.5'")
        write(page, field, "-0.125")
        wait_for_text(page, "messages", "fpt_deformer.A = -0.125")
        press(page, "step")
        wait_for_text(page, "messages", "cycles more")
        assert next_change(graph, found, first) == ("A", -0.125)
        press(page, "E-STOP")
        wait_for_text(page, "messages", "the safe effort is commanded")
        press(page, "step")
        assert next_change(graph, found, first) == ("stopped", True)
        press(page, "release")
        wait_for_text(page, "messages", "released")
        press(page, "resume")
        assert next_change(graph, found, first) == ("stopped", False)

        press(page, "stop")
        first.communicate(timeout=60)
        wait_for_text(page, "state", "not running")
        if not samples.whole:
            return
        second = start_fpt(*run)
        wait_for_text(page, "state", "running")
        page.wait_for(f"{model(field)}.value === '-0.1'")  # those of the new one
        assert forked_fpt("stop", "--namespace", NAMESPACE).returncode == 0
        second.communicate(timeout=60)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (("--host", "192.0.2.1"), "--host 192.0.2.1 --port 5006: "),
        (("--port", "70000"), "less than or equal to 65535"),
    ],
)
def test_what_cannot_be_listened_on_is_one_line(words, said):
    done = forked_fpt("watch", "--no-browser", *words)
    assert done.returncode == 2
    assert said in done.stderr
    assert len(done.stderr.splitlines()) == 1
