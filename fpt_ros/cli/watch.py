"""``fpt watch``."""

from typing import Annotated

import typer

Host = Annotated[
    str,
    typer.Option(
        metavar="ADDRESS", help="To listen on; by default nobody else's machine is let in."
    ),
]
Port = Annotated[
    int, typer.Option(metavar="N", min=0, max=65535, help="By default 5006, or the next free one.")
]
Open = Annotated[bool, typer.Option("--open/--no-browser", help="Whether to start a browser.")]


def watch(host: Host = "127.0.0.1", port: Port = 0, open_: Open = True) -> None:
    """A page to watch running graphs on, and to change their parameters; until Ctrl-C.

    It shows all graphs of the ROS_DOMAIN_ID, however they were started and whenever; the page wants
    the token that is in the URL.

    Example: fpt watch
    """
    from fpt_ros.watch.server import serve

    def tell(url: str) -> None:
        print(f"{url}   (Ctrl-C ends it)", flush=True)
        if host not in ("127.0.0.1", "localhost", "::1"):
            print(
                "whoever has this URL may change the parameters of your robots; "
                "it is not encrypted",
                flush=True,
            )

    serve(host, port, open_, tell)
