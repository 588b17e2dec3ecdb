"""HTTP routes of the lecturer's page: show a slide, open and close polls, and end the lecture."""

from tornado.web import HTTPError

from slamlab.live.web_server.http_server import ProtectedHandler


class LecturerHandler(ProtectedHandler):
    """Request from the lecturer's page; each request keeps the lecture alive."""

    def initialize(self, lecture, sessions):
        self._lecture, self._sessions = lecture, sessions

    def prepare(self):
        super().prepare()
        if self.client is not None:
            self._lecture.keep_alive()

    def fields(self, **types):
        """Return the values of a JSON object; raise HTTPError 400 if a value has the wrong type."""
        body = self.json_body()
        values = [body.get(name) for name in types]
        for value, type_ in zip(values, types.values(), strict=True):
            if not isinstance(value, type_) or isinstance(value, bool):
                raise HTTPError(400)
        return values

    async def perform(self, action, *arguments):
        """Call an action; respond with the number of phones, or status 409 and the ValueError."""
        try:
            action(*arguments)
        except ValueError as error:
            self.set_status(409)
            await self.respond({"error": str(error)})
        else:
            await self.respond({"phones": self._sessions.client_count})

    def require_poll(self):
        if self._lecture.poll is None:
            raise HTTPError(409)
        return self._lecture.poll


class Alive(LecturerHandler):
    async def get(self):
        await self.respond({"phones": self._sessions.client_count})


class CurrentSlide(LecturerHandler):
    async def put(self):
        number, place, html = self.fields(slide=int, place=int, html=str)
        if not (0 <= number <= 999 and 0 <= place <= 999):
            raise HTTPError(400)
        await self.perform(self._lecture.show, number, place, html)


class CurrentPoll(LecturerHandler):
    async def get(self):
        poll, phones = self.require_poll(), self._sessions.client_count
        state = {"phones": phones, "question": poll.question, "open": poll.is_open}
        await self.respond(state | poll.counts())

    async def put(self):
        question, text, choices, unit = self.fields(
            question=str, text=str, choices=list | None, unit=str
        )
        if not all(isinstance(choice, str) for choice in choices or ()):
            raise HTTPError(400)
        await self.perform(self._lecture.ask, question, text, choices, unit[:40])

    async def delete(self):
        await self.perform(self._lecture.drop_poll)


class Close(LecturerHandler):
    async def post(self):
        self.require_poll()
        await self.perform(self._lecture.close_poll)


class Hands(LecturerHandler):
    async def put(self):
        self.require_poll()
        (hands,) = self.fields(hands=list)
        await self.perform(self._lecture.raise_hands, hands)


class End(LecturerHandler):
    async def post(self):
        await self.perform(self._lecture.end)


def routes(lecture, sessions):
    """Return the table of routes; sessions : the phones' sessions."""
    table = {"/alive": Alive, "/slide": CurrentSlide, "/poll": CurrentPoll, "/poll/close": Close}
    table |= {"/hands": Hands, "/end": End}
    arguments = {"lecture": lecture, "sessions": sessions}
    return [(path, handler, arguments) for path, handler in table.items()]
