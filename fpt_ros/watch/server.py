"""Who may see the page: a server on this machine, and a token without which it says nothing."""

import asyncio
import errno
import hmac
import logging
import os
import secrets
import signal
import webbrowser
from collections.abc import Callable
from typing import Any

from bokeh.application import Application
from bokeh.application.handlers.function import FunctionHandler
from bokeh.document import Document
from bokeh.server.auth_provider import AuthProvider
from bokeh.server.server import Server
from bokeh.settings import settings
from tornado.ioloop import IOLoop, PeriodicCallback
from tornado.web import HTTPError, RequestHandler

from fpt_ros.errors import BadInput
from fpt_ros.watch.page import Page
from fpt_ros.watch.robots import Robots

PORT = 5006
"""Where nobody asks for another; it, or one of the next :data:`TRIED`, is taken."""

TRIED = 20

POLL = 100
"""Milliseconds between two looks at what has been heard."""

LASTS = 7 * 24 * 3600
"""Seconds for which a page that has lost its server for a while may come back."""

NICE = 5
"""The loop goes first; but on a busy machine, too, a press of E-STOP must come through soon."""

LAST_PICTURE = 0.1
"""Seconds for what has begun when the end comes."""

EVERYWHERE = ("0.0.0.0", "::")


class Token(AuthProvider):
    """Lets those in whose URL has the token; from then on their browser has it as a cookie."""

    def __init__(self) -> None:
        self.word = secrets.token_urlsafe(24)
        self._cookie = f"fpt_watch_{secrets.token_hex(4)}"  # cookies are shared by all ports
        super().__init__()

    @property
    def get_user(self) -> Callable[[Any], Any]:
        """Asked at each request, that of the web socket among them."""
        return self._user

    @property
    def get_login_url(self) -> Callable[[Any], str]:
        """There is no other way in."""
        return _refuse

    def _user(self, handler: RequestHandler) -> str | None:
        if self._is(handler.get_query_argument("token", "")):
            if handler.request.headers.get("Upgrade", "").lower() != "websocket":
                handler.set_cookie(self._cookie, self.word, httponly=True, samesite="Strict")
            return "user"
        return "user" if self._is(handler.get_cookie(self._cookie, "") or "") else None

    def _is(self, word: str) -> bool:
        return hmac.compare_digest(word.encode(), self.word.encode())


def _refuse(handler: object) -> str:
    raise HTTPError(403, reason="this page wants the token of the URL that fpt watch has printed")


def serve(host: str, port: int, opens: bool, tell: Callable[[str], None]) -> None:
    """Serve the page until Ctrl-C or SIGTERM.

    Args:
        host: address to listen on.
        port: 0: :data:`PORT` or one of the next.
        opens: whether a browser is started.
        tell: is told the URL.

    Raises:
        BadInput: nobody can listen there.
    """
    os.nice(NICE)
    settings.perform_document_validation = False  # the tests look at the page itself
    logging.getLogger("tornado.access").setLevel(logging.ERROR)
    logging.getLogger("bokeh").setLevel(logging.ERROR)
    asyncio.run(_serve(host, port, opens, tell))


async def _serve(host: str, port: int, opens: bool, tell: Callable[[str], None]) -> None:
    ended = asyncio.Event()
    for number in (signal.SIGINT, signal.SIGTERM):
        asyncio.get_running_loop().add_signal_handler(number, ended.set)
    token = Token()
    robots: list[Robots] = []
    pages: set[Page] = set()

    def open_page(document: Document) -> None:
        page = Page(document, robots[0])
        pages.add(page)
        document.on_session_destroyed(lambda context: pages.discard(page))

    server = _server(Application(FunctionHandler(open_page)), host, port, token)
    robots.append(Robots())
    try:
        server.start()
        poll = PeriodicCallback(robots[0].poll, POLL)
        poll.start()
        shown = "127.0.0.1" if host in EVERYWHERE else host
        url = f"http://{f'[{shown}]' if ':' in shown else shown}:{server.port}/?token={token.word}"
        tell(url)
        if opens:
            await asyncio.get_running_loop().run_in_executor(None, webbrowser.open, url)
        await ended.wait()
        poll.stop()
    finally:
        server.unlisten()
        for page in pages:
            page.ended = True
        await asyncio.sleep(LAST_PICTURE)  # one that is being sent
        for name in ("bokeh", "tornado", "asyncio"):  # of browsers that are cut off
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
        server.stop(wait=False)
        robots[0].close()


def _server(application: Application, host: str, port: int, token: Token) -> Server:
    ports = [port] if port else list(range(PORT, PORT + TRIED))
    for at in ports:
        origins = [f"{name}:{at}" for name in (host, "localhost", "127.0.0.1")]
        try:
            return Server(
                application,
                io_loop=IOLoop.current(),
                address=host,
                port=at,
                allow_websocket_origin=["*"] if host in EVERYWHERE else origins,
                auth_provider=token,
                secret_key=secrets.token_hex(32),
                sign_sessions=True,
                session_token_expiration=LASTS,
                check_unused_sessions_milliseconds=1000,
                unused_session_lifetime_milliseconds=5000,
            )
        except OSError as error:
            if error.errno != errno.EADDRINUSE:
                raise BadInput(f"--host {host} --port {at}: {error.strerror or error}") from error
    where = f"{ports[0]}" if port else f"{ports[0]} to {ports[-1]}"
    raise BadInput(f"--port {where}: another program listens there; name another, or end it")
